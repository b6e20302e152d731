#include "stiffness/strains/single_hexahedron.h"

#include <algorithm>
#include <cmath>

#include "stiffness/strains/batch_product.h"

namespace pounding::stiffness {
namespace {

constexpr std::size_t modes = SingleHexahedron::Strains::strain_count;
using Energies = std::array<std::array<double, modes>, modes>;  ///< of the c_m

template <typename Values>
Energies energies_of(const Values& numbers) {
  Energies s{};
  auto next = numbers.begin() + SingleHexahedron::Strains::modes;
  for (std::size_t i = 0; i < modes; ++i) {
    for (std::size_t j = 0; j <= i; ++j) s[i][j] = s[j][i] = *next++;
  }
  return s;
}

/// Lower triangle of L L' = S in its place; false if S is not positive definite.
bool factorise(Energies& s) {
  for (std::size_t j = 0; j < modes; ++j) {
    for (std::size_t k = 0; k < j; ++k) s[j][j] -= s[j][k] * s[j][k];
    if (!(s[j][j] > 0)) return false;
    s[j][j] = std::sqrt(s[j][j]);
    for (std::size_t i = j + 1; i < modes; ++i) {
      for (std::size_t k = 0; k < j; ++k) s[i][j] -= s[i][k] * s[j][k];
      s[i][j] /= s[j][j];
    }
  }
  return true;
}

/// Rows of a symmetric matrix become those of (L^-1 A)'.
void divide_by_factor(const Energies& factor, Energies& a) {
  for (auto& row : a) {
    for (std::size_t i = 0; i < modes; ++i) {
      for (std::size_t k = 0; k < i; ++k) row[i] -= factor[i][k] * row[k];
      row[i] /= factor[i][i];
    }
  }
}

/// Largest part by which energies differ: the Frobenius norm of L^-1 (R - S) L^-T.
double largest_difference(const Energies& rounded, Energies exact) {
  Energies difference{};
  for (std::size_t i = 0; i < modes; ++i) {
    for (std::size_t j = 0; j < modes; ++j) difference[i][j] = rounded[i][j] - exact[i][j];
  }
  if (!factorise(exact)) return INFINITY;
  divide_by_factor(exact, difference);
  for (std::size_t i = 0; i < modes; ++i) {
    for (std::size_t j = 0; j < i; ++j) std::swap(difference[i][j], difference[j][i]);
  }
  divide_by_factor(exact, difference);
  double sum = 0;
  for (const auto& row : difference) {
    for (const double value : row) sum += value * value;
  }
  return std::sqrt(sum);
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
template void BatchElements<SingleHexahedron>::apply(std::size_t, const BatchValue*,
                                                     BatchValue*) const;

}  // namespace pounding::stiffness
