#pragma once

#include <array>
#include <span>
#include <vector>

#include "interactions/pairing/interface.h"
#include "scene/scene.h"

namespace pounding::interactions {

/// Values at points of a plane, linear over the triangles between them that no other point is in
/// the circle of (Delaunay). A place inside of their hull lies in one of these, and one beyond has
/// the value of the nearest place of the hull. Of points on one line the hull is the line.
class LinearField {
 public:
  using Place = std::array<double, 2>;

  /// No two of `places` are one; two or more.
  LinearField(std::span<const Place> places, std::span<const double> values);

  struct Value {
    double value = 0;
    double beyond = 0;  ///< distance from the hull
  };
  Value at(const Place& place) const;
  /// Distance of a place from the line on which all points lie; 0 where they lie on none.
  double off_line(const Place& place) const;

 private:
  void join_line();

  std::vector<Place> places_;
  std::vector<double> values_;
  std::vector<std::array<int, 3>> triangles_;  ///< counter-clockwise; none of points on one line
  /// Sides of the triangles or, of points on one line, the pieces of it in their order.
  std::vector<std::array<int, 2>> edges_;
};

/// A place in the mean plane of a face, lengths kept [m]; `axes`: tangent axes of the normal.
std::array<double, 2> in_plane(const Vector3& x, const Vector3& normal,
                               const std::array<int, 2>& axes);

/// Reads the survey of a contact, one of `contacts`, notes the gap that it has at each row and in
/// the report how it lies on the face. Throws UserError: no such table, too few points, points that
/// are not on the face, or of no contact, gaps of another unit. Serial, rank 0.
void lay_survey(std::span<const Contact> contacts, const Contact& contact,
                std::span<Constraint> rows, std::span<Constraint> watched, InterfaceReport& report);

}  // namespace pounding::interactions
