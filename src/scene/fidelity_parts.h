#pragma once

#include "scene/option_row.h"

namespace pounding {

/// Parts of the certificate of a run's error that have to be asked for.
struct FidelityParts {
  bool mesh = false;  ///< the error of the mesh, see fidelity/mesh_error.h

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&FidelityParts::mesh, "fidelity_mesh", flag(false), "with fidelity_window: that part is stepped on the mesh split once as well, and a whole reduced run made there, by which the error of the mesh is estimated", free_of_fidelity);
    // clang-format on
  }
};

}  // namespace pounding
