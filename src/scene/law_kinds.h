#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/region.h"

namespace pounding {

/// Law in one dimension that a motion of an element follows by its elongation and history alone.
struct OwnLaw {
  std::string name;      ///< of the motion: "axial", "rx", "shear_y" say
  Hysteresis law;        ///< of a bar over its strain, of a beam over those of its section
  std::size_t axis = 0;  ///< component of a spring; of a beam 1: local y, 2: local z
  bool shear = false;    ///< of a beam, along that axis; else it bends about it
};

/// Laws of the elements of a region, in the order in which they are numbered.
std::vector<OwnLaw> own_laws(const Region& region);

/// Elements that follow an element law, see InelasticElements: those with laws of their own, and
/// shells that crack.
bool has_element_law(const Region& region);

}  // namespace pounding
