#include "solvers/anderson_mixing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pounding::interactions {
namespace {

/// Parts of the scaled diagonal: what keeps nearly dependent differences apart, and the pivot below
/// which they are dependent.
constexpr double regular = 1e-10;
constexpr double dependent = 1e-14;

double product(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

AndersonMixing::AndersonMixing(std::size_t most_values)
    : last_image_(most_values),
      last_change_(most_values),
      change_(most_values),
      changes_(depth, std::vector<double>(most_values)),
      images_(depth, std::vector<double>(most_values)),
      matrix_(depth * depth),
      scale_(depth),
      factor_(depth) {}

void AndersonMixing::forget() {
  count_ = next_ = 0;
  has_last_ = false;
}

bool AndersonMixing::solve() {
  for (std::size_t i = 0; i < count_; ++i) {
    if (!(matrix_[i * depth + i] > 0)) return false;
    scale_[i] = 1 / std::sqrt(matrix_[i * depth + i]);
  }
  for (std::size_t i = 0; i < count_; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double value = matrix_[i * depth + j] * scale_[i] * scale_[j] + (i == j ? regular : 0);
      for (std::size_t k = 0; k < j; ++k) value -= matrix_[i * depth + k] * matrix_[j * depth + k];
      if (i == j && !(value > dependent)) return false;
      matrix_[i * depth + j] = i == j ? std::sqrt(value) : value / matrix_[j * depth + j];
    }
  }
  for (std::size_t i = 0; i < count_; ++i) {
    factor_[i] *= scale_[i];
    for (std::size_t k = 0; k < i; ++k) factor_[i] -= matrix_[i * depth + k] * factor_[k];
    factor_[i] /= matrix_[i * depth + i];
  }
  for (std::size_t i = count_; i-- > 0;) {
    for (std::size_t k = i + 1; k < count_; ++k) {
      factor_[i] -= matrix_[k * depth + i] * factor_[k];
    }
    factor_[i] /= matrix_[i * depth + i];
  }
  for (std::size_t i = 0; i < count_; ++i) factor_[i] *= scale_[i];
  return true;
}

bool AndersonMixing::mix(std::span<const double> weight, std::span<const double> image,
                         std::span<double> x) {
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < n; ++i) change_[i] = weight[i] * (image[i] - x[i]);
  if (has_last_) {
    for (std::size_t i = 0; i < n; ++i) {
      changes_[next_][i] = change_[i] - last_change_[i];
      images_[next_][i] = image[i] - last_image_[i];
    }
    next_ = (next_ + 1) % depth;
    count_ = std::min(count_ + 1, depth);
  }
  has_last_ = true;
  std::copy_n(change_.begin(), n, last_change_.begin());
  std::ranges::copy(image, last_image_.begin());
  std::ranges::copy(image, x.begin());
  const auto first = [n](const std::vector<double>& values) { return std::span(values).first(n); };
  for (std::size_t i = 0; i < count_; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      matrix_[i * depth + j] = product(first(changes_[i]), first(changes_[j]));
    }
    factor_[i] = product(first(changes_[i]), first(change_));
  }
  if (!solve()) {
    forget();
    return false;
  }
  for (std::size_t k = 0; k < count_; ++k) {
    for (std::size_t i = 0; i < n; ++i) x[i] -= factor_[k] * images_[k][i];
  }
  return true;
}

}  // namespace pounding::interactions
