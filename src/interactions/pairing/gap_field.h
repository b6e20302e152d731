#pragma once

#include <array>
#include <span>
#include <vector>

#include "interactions/pairing/contact_face.h"
#include "interactions/pairing/interface.h"
#include "scene/scene.h"

namespace pounding::interactions {

/// Random part of the width of a joint over its face: a Gaussian field of mean zero whose
/// covariance at a distance r is deviation^2 exp(-r / length), by its spectral representation
/// (Shinozuka and Deodatis, Applied Mechanics Reviews 44, 1991): the sum of 4,096 plane waves of
/// equal size, whose wave vectors follow the spectral density of that covariance in the plane,
/// (1 + length^2 k^2)^(-3/2), and whose phases are uniform. A function of the place alone, so that
/// it does not depend on the mesh. The seed and the name of the contact determine it. Zero without
/// a deviation.
class GapField {
 public:
  explicit GapField(const Contact& contact);

  /// Value at a place in the plane of the face [m].
  double at(const std::array<double, 2>& place) const;

 private:
  struct Wave {
    std::array<double, 2> number{};  ///< [1/m]
    double phase = 0;
  };
  double size_ = 0;  ///< of each wave [m]
  std::vector<Wave> waves_;
};

/// Patch of the gap of a contact in which the place of a row is; -1: in none.
int patch_at(const Contact& contact, const Constraint& row);

/// Notes how many of the rows of a contact each of its patches has. Throws UserError where one has
/// none.
void count_patches(const Contact& contact, std::span<const Constraint> rows,
                   InterfaceReport& report);

/// Initial gaps of the rows of a contact, as its options give them. It borrows the contact.
class GivenGap {
 public:
  explicit GivenGap(const Contact& contact) : contact_(contact), field_(contact) {}

  /// Gap of a row [m]: that of the patch in which its place is, else that of the geometry, of the
  /// survey or the given one at its share of the face, less the static closing at its elevation,
  /// and the random part at its place.
  double of(const Constraint& row) const;

 private:
  const Contact& contact_;
  GapField field_;
};

/// Part of a face that is nearest to each of its nodes: an equal share of the area of every facet
/// around it [m2], of a line of its length [m].
std::vector<double> node_areas(const ContactFace& face);

/// Part of the plane across a normal that belongs to each node of a face: the rectangle along the
/// axes that holds it and the centroids of the facets around it, of edges as wide as their shells
/// are thick. Those of a face of rectangles along the axes tile it.
std::vector<Patch> node_patches(const GlobalMesh& mesh, const ContactFace& face,
                                const Vector3& normal, const std::array<int, 2>& axes);

/// Lays the filler of a contact into the joint between its pairs, whose initial gap is the joint's
/// width until then and that of hard contact afterwards. `common`: area of the filler where none is
/// told [m2], shared out in proportion to what the pairs' fillers have of it so far. `lines`: some
/// face holds lines, which have no area. Throws UserError where that is not given, where faces have
/// none in common, where a joint is closed, and where it is thinner than its filler.
void lay_filler(const Contact& contact, bool lines, double common,
                std::span<Constraint> constraints, InterfaceReport& report);

/// Lays the filler into the joint at one pair, whose part of its area is known, or the spring of a
/// stop that gives way. Throws UserError where a filled joint is closed, or thinner than its
/// filler.
void fill_joint(const Contact& contact, Constraint& constraint);

}  // namespace pounding::interactions
