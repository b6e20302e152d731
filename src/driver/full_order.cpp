#include "driver/full_order.h"

#include "modal/buckling.h"
#include "modal/definiteness.h"
#include "statics/find_support_shapes.h"
#include "system/finite_element_system.h"
#include "system/links.h"
#include "system/load_shapes.h"

namespace pounding {

LinearSystem assemble_structure(const Model& model, std::size_t s, const Structure& structure,
                                const Mesh& mesh, StiffnessMethod method, bool with_matrix) {
  LinearSystem system = build_system(structure, mesh, method, with_matrix);
  system.loads = shape_loads(model.scene_loads(), static_cast<int>(s), mesh);
  system.start = shape_start(model.starts[s], system, mesh);
  return system;
}

void require_stable(const Structure& structure, const Mesh& mesh, const LinearSystem& system,
                    const std::optional<LargestCompression>& compression) {
  require_passive_matrices(structure, system);
  if (compression) require_no_buckling(structure, mesh, system, *compression);
}

void follow_supports(const Model& model, const Structure& structure, const Mesh& mesh,
                     SolverChoice solver, LinearSystem& system) {
  system.supports = find_support_shapes(structure, mesh, system, model.support_columns(), solver);
  if (system.supports && system.links) system.links->find_trace(system, mesh);
}

}  // namespace pounding
