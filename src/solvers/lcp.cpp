#include "solvers/lcp.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "common/array_reductions.h"
#include "solvers/sparse_rows.h"

namespace pounding::interactions {
namespace {

constexpr int max_sweeps = 20;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

bool is_diagonal(std::span<const double> matrix, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (i != j && matrix[i * n + j] != 0) return false;
    }
  }
  return true;
}

}  // namespace

double complementarity_residual(std::span<const double> delassus, std::span<const double> free_rate,
                                std::span<const double> impulse) {
  const std::size_t n = free_rate.size();
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i) {
    long double gap_rate = free_rate[i];
    for (std::size_t j = 0; j < n; ++j) {
      gap_rate += static_cast<long double>(delassus[i * n + j]) * impulse[j];
    }
    const double closing = delassus[i * n + i] * impulse[i];
    const auto rate = static_cast<double>(gap_rate);
    if (!std::isfinite(closing) || !std::isfinite(rate)) return infinity;
    worst = std::max(worst, std::abs(std::min(closing, rate)));
  }
  const double scale = largest_magnitude(free_rate);
  return scale > 0 ? worst / scale : worst;
}

PrincipalFactor::PrincipalFactor(int max_size)
    : stride_(index(max_size)), lower_(stride_ * stride_), rows_(stride_) {
  for (auto* const room : {&pivot_, &diagonal_, &work_}) room->resize(stride_);
}

void PrincipalFactor::reset(std::span<const double> delassus, int n) {
  delassus_ = delassus;
  n_ = n;
  size_ = 0;
}

bool PrincipalFactor::append(int row) {
  const double* h = &delassus_[index(row) * index(n_)];
  double* l = &lower_[index(size_) * stride_];
  for (int j = 0; j < size_; ++j) {  // L y = h, y in l
    l[j] = h[rows_[index(j)]] - dot_product(factor_row(j), l, index(j));
  }
  double pivot = h[row];
  for (int j = 0; j < size_; ++j) {
    const double y = l[j];
    l[j] = y / pivot_[index(j)];
    pivot -= l[j] * y;
  }
  if (!(pivot > 1e-3 * h[row]) && !(pivot > roundoff_of_pivot(h[row]))) return false;
  pivot_[index(size_)] = pivot;
  diagonal_[index(size_)] = h[row];
  rows_[index(size_)] = row;
  ++size_;
  return true;
}

/// The new row minus its combination c of the rows before, L^T c = l, has the squared norm `pivot`.
/// Round-off of H of relative size eps moves it by about eps (H_ii + sum c_j^2 H_jj).
double PrincipalFactor::roundoff_of_pivot(double diagonal) {
  const double* l = factor_row(size_);
  std::copy(l, l + size_, work_.begin());
  back_substitute(work_);
  double norm = diagonal, largest = 4 * diagonal;
  weak_position_ = -1;
  for (int j = 0; j < size_; ++j) {
    const double part = work_[index(j)] * work_[index(j)] * diagonal_[index(j)];
    norm += part;
    if (part > largest) {
      largest = part;
      weak_position_ = j;
    }
  }
  return (8 + size_) * epsilon * norm;
}

void PrincipalFactor::exchange(int position, int row, std::vector<int>& refused) {
  const int old_size = size_;
  size_ = position;
  if (!append(row)) refused.push_back(row);
  for (int k = position + 1; k < old_size; ++k) {
    const int next = rows_[index(k)];  // append() writes at k or before
    if (!append(next)) refused.push_back(next);
  }
}

void PrincipalFactor::back_substitute(std::span<double> x) const {
  for (int k = size_ - 1; k > 0; --k) {
    const double* l = factor_row(k);
    for (int j = 0; j < k; ++j) x[index(j)] -= l[j] * x[index(k)];
  }
}

void PrincipalFactor::solve(std::span<double> x) const {
  for (int k = 0; k < size_; ++k) x[index(k)] -= dot_product(factor_row(k), x.data(), index(k));
  for (int k = 0; k < size_; ++k) x[index(k)] /= pivot_[index(k)];
  back_substitute(x);
}

LcpSolver::LcpSolver(int max_size) : max_size_(index(max_size)), factor_(max_size) {
  for (auto* const room : {&free_rate_, &gap_rate_, &noise_, &step_}) room->resize(max_size_);
  for (auto* const room : {&dependent_, &kept_}) room->reserve(max_size_);
  for (auto* const room : {&in_contact_, &is_new_, &leaves_}) room->resize(max_size_);
}

LcpResult LcpSolver::solve(std::span<const double> delassus, std::span<const double> free_rate,
                           std::span<double> impulse) {
  const std::size_t n = free_rate.size();
  if (n > max_size_ || delassus.size() != n * n || impulse.size() != n) {
    throw std::invalid_argument("LcpSolver: " + std::to_string(n) + " rows, at most " +
                                std::to_string(max_size_) + "; delassus " +
                                std::to_string(delassus.size()) + ", impulse " +
                                std::to_string(impulse.size()) + " numbers");
  }
  LcpResult result;
  delassus_ = delassus;
  size_ = static_cast<int>(n);
  factor_.reset(delassus, size_);
  dependent_.clear();
  const auto give_up = [&] {
    std::fill(impulse.begin(), impulse.end(), 0.0);
    factor_.truncate(0);
    result.method = LcpMethod::not_finite;
    result.residual = infinity;
    return result;
  };
  if (!all_finite(delassus) || !all_finite(free_rate)) return give_up();

  const double largest = largest_magnitude(free_rate);
  result.free_rate = largest;
  if (std::all_of(free_rate.begin(), free_rate.end(), [](double b) { return b >= 0; })) {
    std::fill(impulse.begin(), impulse.end(), 0.0);
    return result;
  }
  const int exponent = std::ilogb(largest);
  for (std::size_t i = 0; i < n; ++i) {
    free_rate_[i] = std::scalbn(free_rate[i], -exponent);
    const bool zero_row = !(delassus[i * n + i] > 0);
    if (zero_row && free_rate[i] < 0) ++result.infeasible_rows;
    const double guess = std::scalbn(impulse[i], -exponent);
    impulse[i] = !zero_row && std::isfinite(guess) && guess > 0 ? guess : 0.0;
  }
  if (is_diagonal(delassus, n)) {
    result.method = LcpMethod::diagonal;
    for (std::size_t i = 0; i < n; ++i) {
      const double h = delassus[i * n + i];
      impulse[i] = h > 0 ? std::max(0.0, -free_rate_[i] / h) : 0.0;
    }
    result.roundoff = epsilon;
  } else {
    sweep_until_set_rests(impulse, result);
    finish_exactly(impulse, result);
  }
  for (double& value : impulse) value = std::scalbn(value, exponent);
  if (!all_finite(impulse)) return give_up();
  result.residual = complementarity_residual(delassus, free_rate, impulse);
  return result;
}

void LcpSolver::sweep_until_set_rests(std::span<double> impulse, LcpResult& result) {
  const std::size_t n = impulse.size();
  for (int unchanged = 0; unchanged < 2 && result.sweeps < max_sweeps; ++result.sweeps) {
    bool changed = false;
    for (std::size_t i = 0; i < n; ++i) {
      const double* row = &delassus_[i * n];
      if (!(row[i] > 0)) continue;
      const double rate = free_rate_[i] + dot_product(row, impulse.data(), n);
      const double updated = std::max(0.0, impulse[i] - rate / row[i]);
      changed = changed || (updated > 0) != (impulse[i] > 0);
      impulse[i] = updated;
    }
    unchanged = changed ? 0 : unchanged + 1;
  }
}

void LcpSolver::finish_exactly(std::span<double> impulse, LcpResult& result) {
  const int limit = 50 + 10 * size_;
  result.method = LcpMethod::stalled;
  start_set(impulse);
  update_gap_rate(impulse);
  bool first_round = true, moved = false;
  while (result.method == LcpMethod::stalled && result.iterations < limit) {
    ++result.iterations;
    const double fraction = step_to_boundary(impulse);
    moved = moved || fraction > 0;
    update_gap_rate(impulse);
    bool done = false;
    if (fraction < 1) {
      remove_marked();
      // All new rows left again without a move: they came in by round-off.
      done = !first_round && !moved && !has_new_row();
    } else {
      done = !add_violated(result.iterations);
      first_round = moved = false;
    }
    if (done) result.method = LcpMethod::active_set;
  }
  if (result.method == LcpMethod::active_set) refine(impulse);
  result.dependent_rows = static_cast<int>(dependent_.size());
  result.roundoff = epsilon * largest_magnitude(std::span(noise_).first(impulse.size())) /
                    largest_magnitude(std::span(free_rate_).first(impulse.size()));
}

void LcpSolver::start_set(std::span<const double> impulse) {
  std::fill(is_new_.begin(), is_new_.end(), char{0});
  for (int i = 0; i < size_; ++i) {
    in_contact_[index(i)] = impulse[index(i)] > 0;
    if (in_contact_[index(i)]) enter(i);
  }
}

/// Puts a row into the factor. If it depends on the rows there, with a combination that weighs one
/// of them more than itself, it takes the place of that one, which then is tried again: the volume
/// spanned by the factor's rows grows each time, and with it the safety of the verdict. The row
/// left over joins the dependent ones. Returns whether `row` is in the factor.
bool LcpSolver::enter(int row) {
  int candidate = row;
  for (int tries = 0; !factor_.append(candidate); ++tries) {
    const int position = factor_.weak_position();
    if (position < 0 || tries == size_) {  // the latter only if H is not semi-definite
      dependent_.push_back(candidate);
      return candidate != row;
    }
    const int weak = factor_.row(position);
    factor_.exchange(position, candidate, dependent_);
    candidate = weak;
  }
  return true;
}

/// w = b + H lambda by columns (H is symmetric), and the sum of the magnitudes of its terms.
void LcpSolver::update_gap_rate(std::span<const double> impulse) {
  const std::size_t n = impulse.size();
  for (std::size_t i = 0; i < n; ++i) {
    gap_rate_[i] = free_rate_[i];
    noise_[i] = std::abs(free_rate_[i]);
  }
  for (std::size_t j = 0; j < n; ++j) {
    if (impulse[j] == 0) continue;
    const double* column = &delassus_[j * n];
    for (std::size_t i = 0; i < n; ++i) {
      const double term = column[i] * impulse[j];
      gap_rate_[i] += term;
      noise_[i] += std::abs(term);
    }
  }
}

/// step_ := the change of impulse that brings w to zero on the rows of the factor.
void LcpSolver::compute_step() {
  for (int k = 0; k < factor_.size(); ++k) step_[index(k)] = -gap_rate_[index(factor_.row(k))];
  factor_.solve(step_);
}

/// Moves the impulses towards w = 0 on the rows of the factor, as far as none turns negative; marks
/// those that reach zero. Returns the fraction of the step.
double LcpSolver::step_to_boundary(std::span<double> impulse) {
  const int size = factor_.size();
  compute_step();
  double fraction = 1;
  for (int k = 0; k < size; ++k) {
    const double start = impulse[index(factor_.row(k))], step = step_[index(k)];
    if (start + step < 0) fraction = std::min(fraction, start / -step);
  }
  for (int k = 0; k < size; ++k) {
    double& value = impulse[index(factor_.row(k))];
    const double step = step_[index(k)];
    leaves_[index(k)] = value + step < 0 && value / -step <= fraction;
    value = leaves_[index(k)] ? 0.0 : std::max(0.0, value + fraction * step);
  }
  return fraction;
}

/// Takes the marked rows out of the factor; rows that depended on them may enter.
void LcpSolver::remove_marked() {
  int first = 0;
  while (first < factor_.size() && !leaves_[index(first)]) ++first;
  kept_.clear();
  for (int k = first; k < factor_.size(); ++k) {
    if (leaves_[index(k)]) {
      in_contact_[index(factor_.row(k))] = 0;
    } else {
      kept_.push_back(factor_.row(k));
    }
  }
  kept_.insert(kept_.end(), dependent_.begin(), dependent_.end());
  dependent_.clear();
  factor_.truncate(first);
  for (int row : kept_) enter(row);
}

bool LcpSolver::has_new_row() const {
  return std::ranges::any_of(factor_.rows(), [this](int row) { return is_new_[index(row)] != 0; });
}

/// Adds the rows that close, w < 0 beyond round-off. Returns whether one entered the factor.
bool LcpSolver::add_violated(int iteration) {
  const double tolerance = (4 + iteration) * epsilon;
  std::fill(is_new_.begin(), is_new_.end(), char{0});
  bool added = false;
  for (int i = 0; i < size_; ++i) {
    if (in_contact_[index(i)] || gap_rate_[index(i)] >= -tolerance * noise_[index(i)]) continue;
    in_contact_[index(i)] = is_new_[index(i)] = 1;
    added = enter(i) || added;
  }
  return added;
}

/// One step of iterative refinement.
void LcpSolver::refine(std::span<double> impulse) {
  compute_step();
  for (int k = 0; k < factor_.size(); ++k) {
    double& value = impulse[index(factor_.row(k))];
    value = std::max(0.0, value + step_[index(k)]);
  }
}

void LcpSolver::correct(std::span<const double> gap_rate, std::span<double> impulse,
                        std::span<double> increment) {
  std::fill(increment.begin(), increment.end(), 0.0);
  std::copy(gap_rate.begin(), gap_rate.end(), gap_rate_.begin());
  compute_step();
  for (int k = 0; k < factor_.size(); ++k) {
    const std::size_t i = index(factor_.row(k));
    increment[i] = std::max(step_[index(k)], -impulse[i]);
    impulse[i] += increment[i];
  }
}

}  // namespace pounding::interactions
