#include "system/build_system.h"

#include "system/finite_element_system.h"
#include "system/matrix_system.h"

namespace pounding {

LinearSystem build_system(const Structure& structure, const Mesh& mesh, StiffnessMethod method,
                          bool with_matrix) {
  return structure.matrices.empty()
             ? build_finite_element_system(structure, mesh, method, with_matrix)
             : build_matrix_system(structure, mesh);
}

}  // namespace pounding
