#include "statics/make_static_stiffness.h"

#include "statics/assembled_statics.h"
#include "statics/reduced_statics.h"

namespace pounding {

std::unique_ptr<StaticStiffness> make_static_stiffness(const LinearSystem& system, const Mesh& mesh,
                                                       double shift, SolverChoice solver) {
  if (system.generalised) return std::make_unique<ReducedStatics>(system, shift);
  return std::make_unique<AssembledStatics>(system, mesh, shift, solver);
}

}  // namespace pounding
