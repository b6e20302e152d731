#include "elements/end_forces.h"

#include <array>
#include <cstddef>

#include "elements/local_frame.h"

namespace pounding {
namespace {

constexpr std::array<std::string_view, 8> beam_names{"N",   "Vy",  "Vz",  "T",
                                                     "My1", "Mz1", "My2", "Mz2"};
constexpr std::array<std::string_view, 1> bar_names{"N"};
constexpr std::array<std::string_view, 6> spring_names{"Fx", "Fy", "Fz", "Mx", "My", "Mz"};

/// Adds `factor` times the part of nodal forces along `axis`, three of them from `first` on.
void add_along(const Vector3& axis, double factor, std::size_t first, std::size_t size,
               std::span<const double> stiffness, double* row) {
  for (std::size_t d = 0; d < 3; ++d) {
    for (std::size_t j = 0; j < size; ++j) {
      row[j] += factor * axis[d] * stiffness[(first + d) * size + j];
    }
  }
}

}  // namespace

std::span<const std::string_view> end_force_names(ElementType type) {
  if (is_beam(type)) return beam_names;
  if (is_bar(type)) return bar_names;
  if (!is_spring(type)) return {};
  return {spring_names.data(), static_cast<std::size_t>(traits_of(type).layout.components)};
}

std::vector<double> end_force_rows(ElementType type, std::span<const double> coordinates,
                                   const ElementProperties& properties,
                                   std::span<const double> stiffness) {
  const ElementLayout layout = traits_of(type).layout;
  const auto size = static_cast<std::size_t>(layout.size());
  const std::size_t last = size - static_cast<std::size_t>(layout.components);  // its last node
  const std::size_t count = end_force_names(type).size();
  std::vector<double> rows(count * size, 0.0);
  if (is_spring(type)) {
    for (std::size_t c = 0; c < count; ++c) {
      for (std::size_t j = 0; j < size; ++j) rows[c * size + j] = stiffness[(last + c) * size + j];
    }
    return rows;
  }
  const Vector3 direction = segment_between(coordinates).direction;
  if (!is_beam(type)) {
    add_along(direction, 1, last, size, stiffness, rows.data());
    return rows;
  }
  const Matrix3 frame = local_frame(direction, properties.z_axis);
  constexpr std::size_t rotations = 3;
  for (std::size_t d = 0; d < 3; ++d) {
    add_along(frame[d], 1, last, size, stiffness, &rows[d * size]);
  }
  add_along(frame[0], 1, last + rotations, size, stiffness, &rows[3 * size]);
  for (std::size_t d = 1; d < 3; ++d) {
    add_along(frame[d], -1, rotations, size, stiffness, &rows[(3 + d) * size]);
    add_along(frame[d], 1, last + rotations, size, stiffness, &rows[(5 + d) * size]);
  }
  return rows;
}

}  // namespace pounding
