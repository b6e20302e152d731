#include "stiffness/strains/hexahedron_strains.h"

#include <algorithm>
#include <cmath>

#include "common/matrix3.h"
#include "elements/gauss_rule.h"
#include "stiffness/strains/batch_product.h"

namespace pounding::stiffness {
namespace {

constexpr std::size_t node_count = 8;
constexpr std::size_t mode_count = 4;
constexpr std::size_t strain_count = 3 * mode_count;
constexpr std::size_t xi_eta = 2;  // the mode without zeta
using Field = std::array<double, 3 * node_count>;

/// Signs at the corners: 1, xi, eta, zeta, eta zeta, zeta xi, xi eta, xi eta zeta.
constexpr std::array<std::array<double, 8>, 8> signs() {
  std::array<std::array<double, 8>, 8> result{};
  for (std::size_t a = 0; a < 8; ++a) {
    const auto [xi, eta, zeta] = hex_corners[a];
    result[0][a] = 1;
    result[1][a] = xi;
    result[2][a] = eta;
    result[3][a] = zeta;
    result[4][a] = eta * zeta;
    result[5][a] = zeta * xi;
    result[6][a] = xi * eta;
    result[7][a] = xi * eta * zeta;
  }
  return result;
}

/// Sums of one component over the signs but the first: xi, eta, zeta, then the modes.
inline __attribute__((always_inline)) void sums_of(const ElementLanes* v, ElementLanes* sums) {
  const ElementLanes b01 = v[0] + v[3], b23 = v[6] + v[9];      // sums along xi of bottom edges
  const ElementLanes t01 = v[12] + v[15], t23 = v[18] + v[21];  // and of top edges
  const ElementLanes d01 = v[3] - v[0], d23 = v[6] - v[9];      // differences along xi
  const ElementLanes e01 = v[15] - v[12], e23 = v[18] - v[21];
  const ElementLanes d = d01 + d23, dd = d23 - d01, e = e01 + e23, ee = e23 - e01;
  const ElementLanes b = b01 + b23, bb = b23 - b01, t = t01 + t23, tt = t23 - t01;
  sums[0] = d + e;
  sums[1] = bb + tt;
  sums[2] = t - b;
  sums[3] = tt - bb;
  sums[4] = e - d;
  sums[5] = dd + ee;
  sums[6] = ee - dd;
}

/// Forces at the corners of what works on the sums.
inline __attribute__((always_inline)) void corners_of(const ElementLanes* s, ElementLanes* v) {
  const ElementLanes d = s[0] - s[4], e = s[0] + s[4];
  const ElementLanes bb = s[1] - s[3], tt = s[1] + s[3];
  const ElementLanes dd = s[5] - s[6], ee = s[5] + s[6];
  const ElementLanes d01 = d - dd, d23 = d + dd, e01 = e - ee, e23 = e + ee;
  const ElementLanes b01 = -(s[2] + bb), b23 = bb - s[2];
  const ElementLanes t01 = s[2] - tt, t23 = s[2] + tt;
  v[0] = b01 - d01;
  v[3] = b01 + d01;
  v[6] = b23 + d23;
  v[9] = b23 - d23;
  v[12] = t01 - e01;
  v[15] = t01 + e01;
  v[18] = t23 + e23;
  v[21] = t23 - e23;
}

constexpr int none = -1;

/// Where the numbers of X^-1, T and M stand among the element's own.
struct Offsets {
  std::array<std::array<int, 3>, 3> inverse{};
  std::array<std::array<int, 3>, mode_count> skew{}, mean{};
};

template <bool extruded>
constexpr Offsets number_offsets() {
  using Strains = HexahedronStrains<extruded>;
  Offsets offsets;
  int inverse = Strains::inverse, skew = Strains::skew, mean = Strains::mean;
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t k = 0; k < 3; ++k) {
      offsets.inverse[j][k] = extruded && (j == 2) != (k == 2) ? none : inverse++;
    }
  }
  for (std::size_t m = 0; m < mode_count; ++m) {
    for (std::size_t j = 0; j < 3; ++j) {
      offsets.skew[m][j] = extruded && (m != xi_eta || j == 2) ? none : skew++;
      offsets.mean[m][j] = extruded && (m == xi_eta || j != 2) ? none : mean++;
    }
  }
  return offsets;
}

/// The c_m, those of the first group first. c of mode m and component i has number 3 m + i.
template <bool extruded>
constexpr std::array<std::size_t, strain_count> grouped_strains() {
  std::array<std::size_t, strain_count> result{};
  std::size_t count = 0;
  for (const bool even : {true, false}) {
    for (std::size_t c = 0; c < strain_count; ++c) {
      const bool first = !extruded || (c / 3 == xi_eta) != (c % 3 == 2);
      if (first == even) result[count++] = c;
    }
  }
  return result;
}

/// value += number * other, unless the number is zero for all such elements.
template <typename Numbers>
inline __attribute__((always_inline)) void add(Numbers n, int offset, const ElementLanes& other,
                                               ElementLanes& value) {
  if (offset != none) value = plus(value, n[offset], other);
}
template <typename Numbers>
inline __attribute__((always_inline)) void take(Numbers n, int offset, const ElementLanes& other,
                                                ElementLanes& value) {
  if (offset != none) value = less(value, n[offset], other);
}

constexpr double tolerance = 1e-13;  // of the element's extent

/// Nodes by the bits of their natural coordinates, as Gmsh counts them.
constexpr std::array<std::size_t, 8> node_of_bits{0, 1, 3, 2, 4, 5, 7, 6};

/// The corners as they are counted when natural direction `third` is the third one.
std::array<std::size_t, 8> corners_along(std::size_t third) {
  std::array<std::size_t, 8> corners{};
  for (std::size_t bits = 0; bits < 8; ++bits) {
    std::size_t turned = 0;
    for (std::size_t d = 0; d < 3; ++d) turned |= (bits >> d & 1) << ((third + 1 + d) % 3);
    corners[node_of_bits[bits]] = node_of_bits[turned];
  }
  return corners;
}

/// Isotropic stress of a gradient of displacement.
[[gnu::always_inline]] inline void mean_stress(const ElementLanes& lame, const ElementLanes& shear,
                                               const ElementLanes (&g)[3][3],
                                               ElementLanes (&stress)[3][3]) {
  const ElementLanes pressure = lame * (g[0][0] + g[1][1] + g[2][2]);
#pragma GCC unroll 4
  for (std::size_t i = 0; i < 3; ++i) stress[i][i] = plus(pressure, shear + shear, g[i][i]);
  stress[0][1] = stress[1][0] = shear * (g[0][1] + g[1][0]);
  stress[1][2] = stress[2][1] = shear * (g[1][2] + g[2][1]);
  stress[2][0] = stress[0][2] = shear * (g[2][0] + g[0][2]);
}

}  // namespace

template <bool extruded>
template <typename Numbers>
void HexahedronStrains<extruded>::product(Numbers n, ElementLanes* values) {
  constexpr Offsets offsets = number_offsets<extruded>();
  constexpr auto order = grouped_strains<extruded>();
  ElementLanes c[strain_count];
  ElementLanes g[3][3];  // of component i along j
#pragma GCC unroll 4
  for (std::size_t i = 0; i < 3; ++i) {
    ElementLanes sums[7];
    sums_of(values + i, sums);
#pragma GCC unroll 4
    for (std::size_t m = 0; m < mode_count; ++m) {
#pragma GCC unroll 4
      for (std::size_t k = 0; k < 3; ++k) take(n, offsets.skew[m][k], sums[k], sums[3 + m]);
      c[3 * m + i] = sums[3 + m];
    }
#pragma GCC unroll 4
    for (std::size_t j = 0; j < 3; ++j) {
      g[i][j] = ElementLanes{};
#pragma GCC unroll 4
      for (std::size_t k = 0; k < 3; ++k) add(n, offsets.inverse[j][k], sums[k], g[i][j]);
#pragma GCC unroll 4
      for (std::size_t m = 0; m < mode_count; ++m) {
        add(n, offsets.mean[m][j], sums[3 + m], g[i][j]);
      }
    }
  }
  ElementLanes stress[3][3];
  mean_stress(n[lame], n[lame + 1], g, stress);
  ElementLanes strain[strain_count];
  ElementLanes work[strain_count];
#pragma GCC unroll 16
  for (std::size_t s = 0; s < strain_count; ++s) strain[s] = c[order[s]];
  packed_product<even_count>(n + modes, strain, work);
  packed_product<strain_count - even_count>(n + other_modes, strain + even_count,
                                            work + even_count);
#pragma GCC unroll 16
  for (std::size_t s = 0; s < strain_count; ++s) c[order[s]] = work[s];
#pragma GCC unroll 4
  for (std::size_t i = 0; i < 3; ++i) {
    ElementLanes s[7] = {};
#pragma GCC unroll 4
    for (std::size_t j = 0; j < 3; ++j) {
#pragma GCC unroll 4
      for (std::size_t k = 0; k < 3; ++k) add(n, offsets.inverse[j][k], stress[i][j], s[k]);
    }
#pragma GCC unroll 4
    for (std::size_t m = 0; m < mode_count; ++m) {
      s[3 + m] = c[3 * m + i];
#pragma GCC unroll 4
      for (std::size_t j = 0; j < 3; ++j) add(n, offsets.mean[m][j], stress[i][j], s[3 + m]);
#pragma GCC unroll 4
      for (std::size_t k = 0; k < 3; ++k) take(n, offsets.skew[m][k], s[3 + m], s[k]);
    }
    corners_of(s, values + i);
  }
}

namespace {

Field multiplied(std::span<const double> stiffness, const Field& field) {
  Field force{};
  for (std::size_t j = 0; j < field.size(); ++j) {
    for (std::size_t i = 0; i < field.size(); ++i) {
      force[i] += stiffness[j * field.size() + i] * field[j];
    }
  }
  return force;
}

/// Displacements of a unit shear in the plane of i and j.
Field sheared_field(const std::array<Vector3, node_count>& x, std::size_t i, std::size_t j) {
  Field field{};
  for (std::size_t a = 0; a < node_count; ++a) {
    field[3 * a + i] = x[a][j];
    field[3 * a + j] = x[a][i];
  }
  return field;
}

double product_of(const Field& a, const Field& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

template <bool extruded>
std::array<double, HexahedronStrains<extruded>::number_count> HexahedronStrains<extruded>::numbers(
    std::span<const double> coordinates, std::span<const double> stiffness) {
  constexpr auto sign = signs();
  constexpr Offsets offsets = number_offsets<extruded>();
  std::array<Vector3, node_count> x{};  // relative to the first node, to keep digits far away
  Matrix3 natural{};                    // X_kj
  std::array<Vector3, mode_count> of_modes{};
  for (std::size_t a = 0; a < node_count; ++a) {
    for (std::size_t j = 0; j < 3; ++j) {
      x[a][j] = coordinates[3 * a + j] - coordinates[j];
      for (std::size_t k = 0; k < 3; ++k) natural[k][j] += sign[1 + k][a] * x[a][j];
      for (std::size_t m = 0; m < mode_count; ++m) of_modes[m][j] += sign[4 + m][a] * x[a][j];
    }
  }
  std::array<double, number_count> n{};
  const auto put = [&n](int offset, double value) {
    if (offset != none) n[static_cast<std::size_t>(offset)] += value;
  };
  const Matrix3 to_space = pounding::inverse(natural);
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t k = 0; k < 3; ++k) {
      put(offsets.inverse[j][k], to_space[j][k]);
      for (std::size_t m = 0; m < mode_count; ++m) {
        put(offsets.skew[m][k], of_modes[m][j] * to_space[j][k]);
      }
    }
  }
  // Strains of unit shear: their forces are 2 mu V times the mean gradients of the nodes.
  std::array<Vector3, mode_count> mean_of{};
  for (std::size_t j = 0; j < 3; ++j) {
    const std::size_t i = (j + 1) % 3;
    const Field sheared = sheared_field(x, i, j);
    const Field force = multiplied(stiffness, sheared);
    n[lame + 1] = product_of(force, sheared) / 4;
    for (std::size_t m = 0; m < mode_count; ++m) {
      if (offsets.mean[m][j] == none) continue;
      for (std::size_t a = 0; a < node_count; ++a) {
        mean_of[m][j] += sign[4 + m][a] / 8 * force[3 * a + i] / (2 * n[lame + 1]);
      }
      put(offsets.mean[m][j], mean_of[m][j]);
    }
  }
  Field stretched{};
  for (std::size_t a = 0; a < node_count; ++a) stretched[3 * a] = x[a][0];
  n[lame] = product_of(stretched, multiplied(stiffness, stretched)) - 2 * n[lame + 1];
  // Fields of one c, without mean gradient.
  constexpr auto order = grouped_strains<extruded>();
  std::array<Field, strain_count> fields{};
  std::size_t offset = modes;
  for (std::size_t s = 0; s < strain_count; ++s) {
    const std::size_t m = order[s] / 3;
    for (std::size_t a = 0; a < node_count; ++a) {
      fields[s][3 * a + order[s] % 3] = sign[4 + m][a] / 8 - dot(mean_of[m], x[a]);
    }
    const Field force = multiplied(stiffness, fields[s]);
    for (std::size_t other = s < even_count ? 0 : even_count; other <= s; ++other) {
      n[offset++] = product_of(fields[other], force);
    }
  }
  return n;
}

template struct HexahedronStrains<false>;
template struct HexahedronStrains<true>;
template void HexahedronStrains<false>::product(NumbersOfBatch<double>, ElementLanes*);
template void HexahedronStrains<false>::product(OfUnitShear<NumbersOfBatch<float>>, ElementLanes*);
template void HexahedronStrains<false>::product(OfUnitShear<NumbersOfOne<float>>, ElementLanes*);
template void HexahedronStrains<true>::product(NumbersOfBatch<double>, ElementLanes*);
template void BatchElements<HexahedronStrains<false>>::apply(std::size_t, const BatchValue*,
                                                             BatchValue*, StateAhead&) const;
template void BatchElements<HexahedronStrains<true>>::apply(std::size_t, const BatchValue*,
                                                            BatchValue*, StateAhead&) const;

std::optional<Extrusion> Extrusion::find(std::span<const double> coordinates) {
  double extent = 0;
  for (std::size_t i = 3; i < coordinates.size(); ++i) {
    extent = std::max(extent, std::abs(coordinates[i] - coordinates[i % 3]));
  }
  const double allowed = tolerance * extent;
  for (std::size_t third = 0; third < 3; ++third) {
    const auto corners = corners_along(third);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto same = [&](std::size_t a, std::size_t b, std::size_t d) {
        return std::abs(coordinates[3 * corners[a] + d] - coordinates[3 * corners[b] + d]) <=
               allowed;
      };
      bool alike = true;
      for (std::size_t a = 0; a < 4 && alike; ++a) {
        alike = same(a, a + 4, (axis + 1) % 3) && same(a, a + 4, (axis + 2) % 3) &&
                same(a, 0, axis) && same(a + 4, 4, axis);
      }
      if (alike) return Extrusion{axis, corners};
    }
  }
  return std::nullopt;
}

}  // namespace pounding::stiffness
