#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dense_model.h"
#include "elements/element_traits.h"

namespace pounding {
namespace element_test {

using testing_support::dense_element;
using testing_support::DenseElement;

constexpr ElementType all_types[] = {
    ElementType::hex8, ElementType::hex8_full,  ElementType::wedge6, ElementType::tet4,
    ElementType::beam, ElementType::euler_beam, ElementType::bar};

bool is_brick(ElementType type) {
  return type == ElementType::hex8 || type == ElementType::hex8_full;
}

ElementProperties steel() {
  return {.young = 200e9,
          .poisson = 0.3,
          .density = 7800,
          .area = 34.01e-4,
          .inertia_y = 864.4e-8,
          .inertia_z = 317.5e-8,
          .torsion = 13.84e-8,
          .shear_area_y = 20.2e-4,
          .shear_area_z = 6.6e-4,
          .z_axis = {0.2, -0.3, 1.0}};
}

/// Distorted solids, and an oblique segment, whose coordinates are multiples of 1/64 m.
std::vector<double> coordinates_of(ElementType type) {
  if (is_brick(type))
    return {0,      0.0625, 0, 1,      0,      -0.125, 1.25, 0.875, 0, 0.125, 1,    0,
            -0.125, 0,      1, 1.0625, 0.1875, 0.75,   1,    1.25,  1, 0,     0.75, 1.125};
  if (type == ElementType::wedge6)
    return {0,      0.125, 0, 1,      0,    -0.125, 0.25,  0.875, 0.125,
            -0.125, 0,     1, 1.0625, 0.25, 0.75,   0.125, 1.125, 1.25};
  if (type == ElementType::tet4)
    return {0, 0.125, 0, 1, 0, -0.125, 0.25, 0.875, 0.125, 0.25, 0.25, 1};
  return {0.25, -0.5, 0.125, 1.5, 0.75, 2.0};
}

std::vector<double> moved(std::vector<double> coordinates, const Vector3& offset) {
  for (std::size_t i = 0; i < coordinates.size(); ++i) coordinates[i] += offset[i % 3];
  return coordinates;
}

/// The six rigid motions of an element: three unit translations, and three unit rotations about
/// its first node, in its dofs.
std::vector<std::vector<double>> rigid_motions(ElementType type,
                                               const std::vector<double>& coordinates) {
  const ElementLayout layout = element_layout(type);
  const auto components = static_cast<std::size_t>(layout.components);
  std::vector<std::vector<double>> motions;
  for (std::size_t m = 0; m < 6; ++m) {
    std::vector<double> u(static_cast<std::size_t>(layout.size()), 0.0);
    for (std::size_t a = 0; a < static_cast<std::size_t>(layout.nodes); ++a) {
      double* node = u.data() + a * components;
      if (m < 3) {
        node[m] = 1;
        continue;
      }
      const std::size_t axis = m - 3, next = (axis + 1) % 3, last = (axis + 2) % 3;
      node[last] = coordinates[3 * a + next] - coordinates[next];
      node[next] = -(coordinates[3 * a + last] - coordinates[last]);
      if (components == 6) node[3 + axis] = 1;
    }
    motions.push_back(u);
  }
  return motions;
}

/// Largest force of a motion, relative to the sum of the |K_ij u_j| that should have cancelled.
double relative_force(const std::vector<double>& stiffness, const std::vector<double>& u) {
  const std::size_t n = u.size();
  double worst = 0, scale = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double force = 0, sum = 0;
    for (std::size_t j = 0; j < n; ++j) {
      force += stiffness[i * n + j] * u[j];
      sum += std::abs(stiffness[i * n + j] * u[j]);
    }
    worst = std::max(worst, std::abs(force));
    scale = std::max(scale, sum);
  }
  return worst / scale;
}

TEST(Element, LayoutGivesNodesAndComponents) {
  EXPECT_EQ(element_layout(ElementType::hex8).nodes, 8);
  EXPECT_EQ(element_layout(ElementType::hex8).size(), 24);
  EXPECT_EQ(element_layout(ElementType::hex8_full).components, 3);
  EXPECT_EQ(element_layout(ElementType::beam).components, 6);
  EXPECT_EQ(element_layout(ElementType::beam).size(), 12);
  EXPECT_EQ(element_layout(ElementType::bar).size(), 6);
  for (const ElementType type : all_types) {
    EXPECT_LE(element_layout(type).nodes, max_element_nodes);
    EXPECT_LE(element_layout(type).size(), max_element_size);
  }
}

TEST(Element, StiffnessIsSymmetricToTheBit) {
  for (const ElementType type : all_types) {
    const DenseElement e = dense_element(type, coordinates_of(type), steel());
    const std::size_t n = e.lumped_mass.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_EQ(e.stiffness[i * n + j], e.stiffness[j * n + i])
            << element_name(type) << ' ' << i << ' ' << j;
  }
}

TEST(Element, RigidMotionsMakeNoForceNearAndFar) {
  for (const ElementType type : all_types) {
    for (const double offset : {0.0, 1e6}) {
      // 0.1 and 0.3 are not representable: far away the element is rounded to 1e-10 m, and must be
      // free of force for the motions of what it has become.
      const auto x = moved(coordinates_of(type), {offset + 0.1, -offset - 0.3, offset + 0.7});
      const DenseElement e = dense_element(type, x, steel());
      for (const auto& u : rigid_motions(type, x))
        EXPECT_LE(relative_force(e.stiffness, u), 1e-12) << element_name(type) << " at " << offset;
    }
  }
}

TEST(Element, TranslationBy1e6MetresChangesNoBit) {
  // Multiples of 1/64 m stay exact there.
  for (const ElementType type : all_types) {
    const auto x = coordinates_of(type);
    const DenseElement near = dense_element(type, x, steel());
    const DenseElement far = dense_element(type, moved(x, {1e6, -1e6, 2e6}), steel());
    EXPECT_EQ(near.stiffness, far.stiffness) << element_name(type);
    EXPECT_EQ(near.lumped_mass, far.lumped_mass) << element_name(type);
  }
}

TEST(Element, NullSpaceHoldsRigidMotionsOnly) {
  for (const ElementType type : all_types) {
    const DenseElement e = dense_element(type, coordinates_of(type), steel());
    const std::size_t n = e.lumped_mass.size();
    // Mass-scaled, so that metres and radians compare.
    const auto values = testing_support::squared_circular_frequencies(e.stiffness, e.lumped_mass);
    const std::size_t zeros = type == ElementType::bar ? 5 : 6;
    const double tiny = 1e-11 * values[n - 1];
    for (std::size_t i = 0; i < n; ++i) {
      if (i < zeros)
        EXPECT_LE(std::abs(values[i]), tiny) << element_name(type) << ' ' << i;
      else
        EXPECT_GT(values[i], 1e3 * tiny) << element_name(type) << ' ' << i;
    }
  }
}

TEST(Element, TurnedElementHasTurnedStiffness) {
  const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(-1.1), t = std::sin(-1.1);
  const double turn[3][3] = {{c, -s * d, s * t}, {s, c * d, -c * t}, {0, t, d}};
  const auto turned = [&](const double* v) {
    Vector3 r{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) r[i] += turn[i][j] * v[j];
    return r;
  };
  for (const ElementType type : all_types) {
    const auto x = coordinates_of(type);
    auto y = x;
    for (std::size_t a = 0; a < x.size(); a += 3) {
      const Vector3 r = turned(&x[a]);
      std::copy(r.begin(), r.end(), y.begin() + static_cast<std::ptrdiff_t>(a));
    }
    ElementProperties turned_steel = steel();
    turned_steel.z_axis = turned(steel().z_axis.data());
    const DenseElement e = dense_element(type, x, steel());
    const DenseElement f = dense_element(type, y, turned_steel);
    const std::size_t n = e.lumped_mass.size();
    double largest = 0;
    for (const double k : e.stiffness) largest = std::max(largest, std::abs(k));
    std::vector<double> u(n), v(n);
    for (std::size_t j = 0; j < n; ++j) {
      std::fill(u.begin(), u.end(), 0.0);
      u[j] = 1;
      for (std::size_t a = 0; a < n; a += 3) {
        const Vector3 r = turned(&u[a]);
        std::copy(r.begin(), r.end(), v.begin() + static_cast<std::ptrdiff_t>(a));
      }
      const auto force = testing_support::multiply(e.stiffness, u);
      const auto turned_force = testing_support::multiply(f.stiffness, v);
      for (std::size_t a = 0; a < n; a += 3) {
        const Vector3 expected = turned(&force[a]);
        for (std::size_t i = 0; i < 3; ++i)
          EXPECT_NEAR(turned_force[a + i], expected[i], 1e-13 * largest) << element_name(type);
      }
    }
  }
}

TEST(Element, MassAloneIsTheSameMass) {
  for (const ElementType type : all_types) {
    const auto x = coordinates_of(type);
    const DenseElement e = dense_element(type, x, steel());
    std::vector<double> mass(e.lumped_mass.size());
    element_lumped_mass(type, x, steel(), mass);
    EXPECT_EQ(mass, e.lumped_mass) << element_name(type);
    for (const double m : mass) EXPECT_GT(m, 0) << element_name(type);
  }
}

TEST(Element, WrongShapesAreRefused) {
  std::vector<double> k(36), m(6), short_m(5), x(6, 0.0), long_x(9, 0.0);
  x[3] = 1;
  EXPECT_NO_THROW(element_matrices(ElementType::bar, x, steel(), k, m));
  EXPECT_THROW(element_matrices(ElementType::beam, x, steel(), k, m), std::logic_error);
  EXPECT_THROW(element_matrices(ElementType::bar, x, steel(), k, short_m), std::logic_error);
  EXPECT_THROW(element_lumped_mass(ElementType::bar, long_x, steel(), m), std::logic_error);
}

}  // namespace element_test
}  // namespace pounding
