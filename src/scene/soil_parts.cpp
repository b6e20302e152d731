#include "scene/soil_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pounding {
namespace {

constexpr std::array impedance_values{&Impedance::stiffness,     &Impedance::dashpot,
                                      &Impedance::inner_dashpot, &Impedance::inner_mass,
                                      &Impedance::mass,          &Impedance::inner_stiffness};
constexpr double last_pivot = 1e-13;  ///< over the diagonal, from which on nothing is left

/// Turns a part into an equal one against a motion whose largest component is 1.
void make_unit(SoilPart& part) {
  const double largest =
      *std::ranges::max_element(part.motion, {}, [](double value) { return std::abs(value); });
  for (double& value : part.motion) value /= largest;
  for (double Impedance::*value : impedance_values) part.impedance.*value *= largest * largest;
}

}  // namespace

void add_part(SoilPart part, std::vector<SoilPart>& parts) {
  make_unit(part);
  Impedance& from = part.impedance;
  const auto same = std::ranges::find_if(parts, [&](const SoilPart& other) {
    return other.motion == part.motion &&
           (other.impedance.inner_dashpot == 0 || from.inner_dashpot == 0);
  });
  if (same == parts.end()) {
    parts.push_back(part);
    return;
  }
  Impedance& to = same->impedance;
  for (double Impedance::*value : impedance_values) to.*value += from.*value;
}

void add_parts(DenseMatrix matrix, double Impedance::*value, std::vector<SoilPart>& parts) {
  const std::size_t size = matrix.rows;
  std::vector<double> diagonal(size);
  for (std::size_t i = 0; i < size; ++i) diagonal[i] = matrix.column(i)[i];
  for (std::size_t turn = 0; turn < size; ++turn) {
    std::size_t pivot = 0;
    double most = last_pivot;
    for (std::size_t i = 0; i < size; ++i) {
      const double share = diagonal[i] > 0 ? matrix.column(i)[i] / diagonal[i] : 0;
      if (share > most) {
        most = share;
        pivot = i;
      }
    }
    if (most == last_pivot) return;
    SoilPart part;
    const double strength = matrix.column(pivot)[pivot];
    for (std::size_t i = 0; i < size; ++i) {
      part.motion.push_back(matrix.column(pivot)[i] / strength);
    }
    part.impedance.*value = strength;
    for (std::size_t j = 0; j < size; ++j) {
      for (std::size_t i = 0; i < size; ++i) {
        matrix.column(j)[i] -= strength * part.motion[i] * part.motion[j];
      }
    }
    for (std::size_t i = 0; i < size; ++i) matrix.column(i)[pivot] = matrix.column(pivot)[i] = 0;
    add_part(part, parts);
  }
}

std::vector<DirectedImpedance> parts_of_mat(std::span<const SoilPart> parts) {
  std::vector<DirectedImpedance> directed(parts.size());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    std::copy_n(parts[k].motion.begin(), 6, directed[k].motion.begin());
    directed[k].impedance = parts[k].impedance;
  }
  return directed;
}

std::vector<DirectedImpedance> own_springs(const DenseMatrix& stiffness, std::size_t first) {
  DenseMatrix own(6, 6);
  for (std::size_t j = 0; j < 6; ++j) {
    std::copy_n(stiffness.column(first + j) + first, 6, own.column(j));
  }
  std::vector<SoilPart> springs;
  add_parts(own, &Impedance::stiffness, springs);
  return parts_of_mat(springs);
}

void add_springs_between(const DenseMatrix& stiffness, std::vector<SoilPart>& parts) {
  const std::size_t size = stiffness.rows;
  for (std::size_t i = 0; i < size; ++i) {
    const double own = stiffness.column(i)[i];
    SoilPart part{std::vector<double>(size, 0.0), {}};
    for (std::size_t j = (i / 6 + 1) * 6; j < size; ++j) {
      part.motion[j] = stiffness.column(j)[i] / own;
    }
    if (part.motion == std::vector<double>(size, 0.0)) continue;
    for (const double sign : {1.0, -1.0}) {
      part.motion[i] = sign;
      part.impedance.stiffness = sign * own / 2;
      parts.push_back(part);
    }
  }
}

}  // namespace pounding
