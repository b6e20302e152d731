#include "stiffness/strains/single_hexahedron.h"

#include <cmath>
#include <vector>

#include "common/dense_matrix.h"
#include "stiffness/strains/batch_product.h"

namespace pounding::stiffness {
namespace {

constexpr std::size_t modes = SingleHexahedron::Strains::strain_count;
using Energies = std::vector<double>;  ///< of the c_m, shape (modes, modes)

template <typename Values>
Energies energies_of(const Values& numbers) {
  Energies s(modes * modes);
  auto next = numbers.begin() + SingleHexahedron::Strains::modes;
  for (std::size_t i = 0; i < modes; ++i) {
    for (std::size_t j = 0; j <= i; ++j) s[i * modes + j] = s[j * modes + i] = *next++;
  }
  return s;
}

/// Largest part by which energies differ, the Frobenius norm of L^-1 (R - S) L^-T with L L' = S:
/// the root of the trace of the square of S^-1 (R - S). Infinite if S is not positive definite.
double largest_difference(const Energies& rounded, const Energies& exact) {
  Energies inverse = exact;
  if (!invert_definite(inverse)) return INFINITY;
  Energies part(modes * modes);
  for (std::size_t i = 0; i < modes; ++i) {
    for (std::size_t k = 0; k < modes; ++k) {
      for (std::size_t j = 0; j < modes; ++j) {
        const std::size_t kj = k * modes + j;
        part[i * modes + j] += inverse[i * modes + k] * (rounded[kj] - exact[kj]);
      }
    }
  }
  double square = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    square += part[i] * part[i % modes * modes + i / modes];
  }
  return std::sqrt(square);
}

/// The digits of a number that its 24 leading ones leave.
float rest_of(double number) {
  return static_cast<float>(number - static_cast<double>(static_cast<float>(number)));
}

}  // namespace

std::optional<SingleHexahedron::Numbers> SingleHexahedron::find(std::span<const double> coordinates,
                                                                std::span<const double> stiffness) {
  auto exact = Strains::numbers(coordinates, stiffness);
  const double unit = exact[Strains::lame + 1];
  Numbers numbers{};
  for (std::size_t k = 0; k < exact.size(); ++k) {
    if (k < Strains::inverse || k >= Strains::modes) exact[k] /= unit;
    numbers[k] = static_cast<float>(exact[k]);
    if (!std::isfinite(numbers[k])) return std::nullopt;
  }
  numbers[Strains::lame + 1] = rest_of(exact[Strains::lame]);
  numbers[scale] = static_cast<float>(unit);
  numbers[scale + 1] = rest_of(unit);
  const double change = largest_difference(energies_of(numbers), energies_of(exact));
  return change <= largest_change ? std::optional(numbers) : std::nullopt;
}

template <typename In>
void SingleHexahedron::product(In numbers, ElementLanes* values) {
  Strains::product(OfUnitShear<In>{numbers}, values);
  const ElementLanes unit = numbers[scale] + numbers[scale + 1];
#pragma GCC unroll 24
  for (std::size_t i = 0; i < size; ++i) values[i] *= unit;
}

template void SingleHexahedron::product(NumbersOfBatch<float>, ElementLanes*);
template void SingleHexahedron::product(NumbersOfOne<float>, ElementLanes*);
template void BatchElements<SingleHexahedron>::apply(std::size_t, const BatchValue*, BatchValue*,
                                                     StateAhead&) const;

}  // namespace pounding::stiffness
