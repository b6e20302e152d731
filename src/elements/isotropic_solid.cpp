#include "elements/isotropic_solid.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pounding {

namespace {

constexpr double smallest_relative_thickness = 1e-12;

}  // namespace

LameConstants lame_constants(const ElementProperties& properties) {
  const double young = properties.young;
  const double poisson = properties.poisson;
  return {young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
}

Matrix3 jacobian_of(std::span<const Vector3> nodes, std::span<const Vector3> derivatives) {
  Matrix3 result{};
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) result[i][j] += derivatives[a][i] * nodes[a][j];
    }
  }
  return result;
}

double flat_thickness(std::span<const double> coordinates) {
  double extent = 0;
  for (const double x : coordinates) extent = std::max(extent, std::abs(x));
  return smallest_relative_thickness * extent;
}

void require_volume(const Matrix3& jacobian, double flat) {
  const double volume = determinant(jacobian);
  const Vector3 edges{norm(jacobian[0]), norm(jacobian[1]), norm(jacobian[2])};
  const double face = std::max({edges[0] * edges[1], edges[1] * edges[2], edges[2] * edges[0]});
  // Negated so that it also catches a value that is not a number.
  if (!(volume > flat * face)) {
    std::ostringstream message;
    message << "non-positive Jacobian " << volume;
    throw ElementError(message.str());
  }
}

void add_elastic_blocks(std::span<const Vector3> gradients, const LameConstants& lame,
                        double weight, std::span<double> matrix) {
  const std::size_t size = 3 * gradients.size();
  for (std::size_t a = 0; a < gradients.size(); ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      const Vector3& ga = gradients[a];
      const Vector3& gb = gradients[b];
      const double diagonal = lame.shear * dot(ga, gb);
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          matrix[(3 * a + i) * size + 3 * b + j] +=
              weight * (lame.lambda * ga[i] * gb[j] + lame.shear * ga[j] * gb[i] +
                        (i == j ? diagonal : 0.0));
        }
      }
    }
  }
}

}  // namespace pounding
