#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/region.h"

namespace pounding {

struct LawKind;

/// A question to the laws of a region: whether one of them has this property, or one of several.
struct LawTrait {
  unsigned bits = 0;

  bool operator()(const Region& region) const { return of(region) != nullptr; }
  /// The first kind of law of a region that has it; null: none.
  const LawKind* of(const Region& region) const;
};

constexpr LawTrait operator|(LawTrait a, LawTrait b) {
  return {a.bits | b.bits};
}

/// Elements whose force is not K u, whether or not K holds their first slope.
inline constexpr LawTrait is_nonlinear{1};
/// Elements whose stiffness, or some of it, is no part of K.
inline constexpr LawTrait follows_law{2};
/// Elements whose force in one direction is none.
inline constexpr LawTrait is_one_way{4};
/// Elements whose force follows from their displacements and history alone, see InelasticElements.
inline constexpr LawTrait has_element_law{8};
/// Elements that cannot be in a reduced structure.
inline constexpr LawTrait is_full_order{16};
/// Dashpots whose force is no matrix times the rates of their ends.
inline constexpr LawTrait has_power{32};
inline constexpr LawTrait has_series{64};
inline constexpr LawTrait any_law{127};

/// A kind of law that elements have beside K u, an option each: a line of a list in law_kinds.cpp.
struct LawKind {
  const char* option;
  bool (*is_of)(const Region&);
  LawTrait traits;
};

/// Law in one dimension that a motion of an element follows by its elongation and history alone.
struct OwnLaw {
  std::string name;      ///< of the motion: "axial", "rx", "shear_y" say
  Hysteresis law;        ///< of a bar over its strain, of a beam over those of its section
  std::size_t axis = 0;  ///< component of a spring; of a beam 1: local y, 2: local z
  bool shear = false;    ///< of a beam, along that axis; else it bends about it
};

/// Laws of the elements of a region, in the order in which they are numbered.
std::vector<OwnLaw> own_laws(const Region& region);

}  // namespace pounding
