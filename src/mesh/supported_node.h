#pragma once

#include "common/types.h"

namespace pounding {

/// A clamped node on a support that moves on its own.
struct SupportedNode {
  GlobalIndex node = 0;  ///< file order
  int support = 0;       ///< into the scene's supports
  int components = 0;    ///< that are clamped, one bit each: 0-2 translations, 3-5 rotations

  bool holds(int component) const { return (components >> component & 1) != 0; }
};

}  // namespace pounding
