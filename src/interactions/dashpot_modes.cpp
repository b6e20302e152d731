#include "interactions/dashpot_modes.h"

#include <algorithm>
#include <cmath>

#include "common/dense_matrix.h"
#include "common/row_products.h"

namespace pounding::interactions {
namespace {

/// h lambda of motions that nothing is left of in a run: a damping of 1e-8 per second or less.
constexpr double unfelt = 1e-13;

}  // namespace

DashpotModes::DashpotModes(const LinearSystem& system, std::span<const double> rows,
                           std::span<const double> strengths, double time_step)
    : mass_(system.lumped_mass),
      inverse_mass_(system.inverse_mass),
      time_step_(time_step),
      pull_(mass_.size(), 0.0),
      sums_(mass_.size(), 0.0) {
  const std::size_t size = mass_.size();
  DenseMatrix scaled(strengths.size(), size);  // diag(c)^1/2 B M^-1/2
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t b = 0; b < strengths.size(); ++b) {
      scaled.column(i)[b] = std::sqrt(strengths[b] * inverse_mass_[i]) * rows[b * size + i];
    }
  }
  DenseMatrix vectors = transposed_product(scaled, scaled);
  const std::vector<double> values = symmetric_eigenvalues(vectors);
  for (std::size_t j = size; j > 0 && time_step / 2 * values[j - 1] > unfelt; --j) {
    lambda_.push_back(values[j - 1]);
    for (std::size_t i = 0; i < size; ++i) {
      rows_.push_back(std::sqrt(mass_[i]) * vectors.column(j - 1)[i]);
    }
  }
  parts_.assign(lambda_.size(), 0.0);
}

void DashpotModes::brake(double share, std::span<const double> before, std::span<double> velocity) {
  share_ = share;
  const std::size_t size = velocity.size();
  for (std::size_t i = 0; i < size; ++i) sums_[i] = velocity[i] + before[i];
  multiply_rows(rows_.data(), parts_.size(), size, sums_.data(), parts_.data(), 1);
  std::fill(pull_.begin(), pull_.end(), 0.0);
  double* const pull = pull_.data();
  for (std::size_t j = 0; j < parts_.size(); ++j) {
    const double braked = share * time_step_ / 2 * lambda_[j];
    const double part = braked / (1 + braked) * parts_[j];
    const double* const row = &rows_[j * size];
    for (std::size_t i = 0; i < size; ++i) pull[i] += part * row[i];
  }
  for (std::size_t i = 0; i < size; ++i) {
    velocity[i] -= inverse_mass_[i] * pull[i];
    sums_[i] = velocity[i] + before[i];
  }
}

double DashpotModes::loss(std::span<const double> before, std::span<const double> after) const {
  double sum = 0;
  for (std::size_t i = 0; i < pull_.size(); ++i) sum += pull_[i] * (after[i] + before[i]);
  return sum / (2 * share_);
}

}  // namespace pounding::interactions
