#include "modal/block_krylov.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>

#include "common/repeatable_random.h"
#include "modal/eigen_solver.h"
#include "modal/orthonormal_space.h"

namespace pounding {
namespace {

constexpr double residual_tolerance = 1e-10;  // of theta
constexpr double weak = 1e-5;                 // see keep_strong_directions
constexpr double rounding = 1e-14;            // part of (A - s I)^-1 V that is nothing
constexpr double fresh_rest = 1e-8;           // part of a new column that must be new
constexpr double equal_values = 1e-6;         // relative
constexpr std::size_t most_blocks = 5000;

/// Columns of a block. Larger ones make more of a pass over the factor and over the space, and less
/// of each product: 32 take as long as 16 for 400 modes, and more memory.
constexpr std::size_t block_size = 16;

class BlockKrylov {
 public:
  BlockKrylov(const LinearSystem& system, const Mesh& mesh, const ShiftedSolver& solver,
              std::size_t count)
      : system_(system),
        mesh_(mesh),
        solver_(solver),
        wanted_(count),
        capacity_(largest_krylov_space(count)),
        space_(system.comm, static_cast<std::size_t>(system.owned_dofs())) {
    space_.reserve(capacity_ + block_size);
  }

  Eigenpairs run() {
    DenseMatrix next(space_.columns().rows, 0);
    add_fresh_block(next);
    for (std::size_t blocks = 0; blocks < most_blocks && next.columns > 0; ++blocks) {
      next = grow(std::move(next));
      if (next.columns > 0 && !is_due()) continue;
      diagonalise();
      if (lock_the_largest()) {
        next = DenseMatrix(space_.columns().rows, 0);
        add_fresh_block(next);
        continue;
      }
      const bool enough = converged() >= wanted_;
      if (enough && none_missed()) break;
      if (enough || next.columns == 0) add_fresh_block(next);
      if (space_.size() + next.columns > capacity_) cut_down();
    }
    return pairs();
  }

 private:
  /// Leading pairs whose residual is small enough.
  std::size_t converged() const {
    std::size_t count = 0;
    while (count < residual_.size() && residual_[count] <= residual_tolerance * theta_[count]) {
      ++count;
    }
    return count;
  }

  /// Adds orthonormal columns that nothing distinguishes to the next block, at right angles to it
  /// and to the space; none where there are no others.
  void add_fresh_block(DenseMatrix& next) {
    DenseMatrix block(space_.columns().rows, block_size);
    for_each_owned_dof(mesh_, [&](LocalIndex dof, LocalIndex node, int c) {
      const auto number = static_cast<std::uint64_t>(6 * mesh_.file_node[node] + c);
      for (std::size_t j = 0; j < block_size; ++j) {
        block.column(j)[dof] = scattered_normal((number << 16U) + fresh_ + j);
      }
    });
    fresh_ += block_size;
    const double least = fresh_rest * std::ranges::max(space_.norms(block));
    OrthonormalSpace others(system_.comm, block.rows);
    others.append_columns(next);
    for (int pass = 0; pass < 2 && block.columns > 0; ++pass) {
      space_.project(block);
      others.project(block);
      orthonormalise(block, pass == 0 ? least : 0);
    }
    // Nothing before leads to the new columns: rows of zeros in R.
    DenseMatrix longer(last_.rows + block.columns, last_.columns);
    for (std::size_t j = 0; j < last_.columns; ++j) {
      std::copy_n(last_.column(j), last_.rows, longer.column(j));
    }
    last_ = std::move(longer);
    next.append_columns(block);
  }

  /// Whether there are as many eigenvalues as were found below a gap among the last that are
  /// wanted. A space from a block sees no more equal ones than this has columns: only where so many
  /// were found do others have to be counted.
  bool none_missed() const {
    const auto value = [this](std::size_t i) { return solver_.shift() + 1 / theta_[i]; };
    const auto gap = [&](std::size_t i) { return value(i) - value(i - 1); };
    bool doubtful = false;
    for (std::size_t i = block_size; i <= wanted_; ++i) {
      const double last = value(i - 1);
      doubtful = doubtful || last - value(i - block_size) <= equal_values * std::abs(last);
    }
    if (!doubtful) return true;
    const std::size_t end = std::min(converged(), wanted_ + 1);
    std::size_t below = end - 1;
    for (std::size_t i = end - 1; i > 0 && i + looked_past >= wanted_; --i) {
      if (gap(i) > gap(below)) below = i;
    }
    if (!(gap(below) > equal_values * std::abs(value(below)))) return true;  // they are all alike
    const double between = (value(below) + value(below - 1)) / 2;
    return solver_.eigenvalues_below(between) <= static_cast<int>(below);
  }

  /// X of W = X R with orthonormal columns, in the place of W; returns R. Columns may differ by
  /// orders, as rigid motions beside fast modes: the remainder beside strong directions is a block
  /// of its own. Columns no longer than `least` are lost.
  DenseMatrix orthonormalise(DenseMatrix& w, double least) const {
    OrthonormalSpace block(system_.comm, w.rows);
    block.reserve(w.columns);
    DenseMatrix rest = w;
    for (int turn = 0; turn < 8 && block.size() < w.columns; ++turn) {
      DenseMatrix strong = scaled_columns(rest, least);
      if (strong.columns == 0) break;
      keep_strong_directions(strong);
      if (block.size() > 0) {
        block.project(strong);
        keep_strong_directions(strong);
      }
      block.append_columns(strong);
      if (block.size() < w.columns) block.project(rest);
    }
    DenseMatrix r = block.parts(w);
    w = block.release();
    return r;
  }

  /// Columns longer than `least`, brought to length 1.
  DenseMatrix scaled_columns(const DenseMatrix& x, double least) const {
    const std::vector<double> lengths = space_.norms(x);
    DenseMatrix scaled(x.rows, 0);
    scaled.values.reserve(x.values.size());
    for (std::size_t j = 0; j < lengths.size(); ++j) {
      if (!(lengths[j] > least)) continue;
      scaled.append({x.column(j), x.rows});
      double* const column = scaled.column(scaled.columns - 1);
      for (std::size_t i = 0; i < x.rows; ++i) column[i] /= lengths[j];
    }
    return scaled;
  }

  /// X := orthonormal directions of its columns, X U D^-1/2 with X^T X = U D U^T, but for those
  /// that are weak beside the strongest or not longer than `least` (Stathopoulos and Wu, SIAM J.
  /// Sci. Comput. 23 (2002) 2165).
  void keep_strong_directions(DenseMatrix& x, double least = 0) const {
    DenseMatrix directions = product_over_ranks(system_.comm, x, x);
    const std::vector<double> squares = symmetric_eigenvalues(directions);
    DenseMatrix shrink(x.columns, 0);
    for (std::size_t j = 0; j < squares.size(); ++j) {
      if (!(squares[j] > std::max(weak * weak * squares.back(), least * least))) continue;
      std::vector<double> column(directions.column(j), directions.column(j) + x.columns);
      for (double& value : column) value /= std::sqrt(squares[j]);
      shrink.append(column);
    }
    combine_columns(x, shrink);
  }

  /// Takes a block into the space; returns the next one.
  DenseMatrix grow(DenseMatrix&& block) {
    const std::size_t before = space_.size();
    space_.append_columns(block);
    DenseMatrix w = std::move(block);
    last_count_ = w.columns;
    solver_.solve(w);
    const double least = rounding * std::ranges::max(space_.norms(w));
    // H is zero beyond the block before; Ritz vectors that the space began with are one block.
    const std::size_t related = before_;
    DenseMatrix part(space_.size(), w.columns);
    const DenseMatrix near = space_.project(w, related);
    for (std::size_t j = 0; j < w.columns; ++j) {
      std::copy_n(near.column(j), near.rows, part.column(j) + related);
    }
    last_ = orthonormalise(w, least);
    // All of the space: the rounding left in it grew with the scale.
    add_product(1, space_.project(w), last_, part);
    before_ = before;
    extend(before, part);
    if (w.columns == 0) return w;
    // A column that has lost half of itself by then was nothing but rounding.
    DenseMatrix x = w;
    keep_strong_directions(x, 0.5);
    last_ = product(product_over_ranks(system_.comm, x, w), last_);
    return x;
  }

  static DenseMatrix product(const DenseMatrix& a, const DenseMatrix& b) {
    DenseMatrix c(a.rows, b.columns);
    add_product(1, a, b, c);
    return c;
  }

  /// More columns of H; its upper triangle is right.
  void extend(std::size_t before, const DenseMatrix& part) {
    const std::size_t size = space_.size();
    DenseMatrix larger(size, size);
    for (std::size_t j = 0; j < before; ++j) {
      std::copy_n(projected_.column(j), before, larger.column(j));
    }
    std::ranges::copy(part.values, larger.column(before));
    projected_ = std::move(larger);
  }

  /// Whether to look how far it has come: seldom, as the projected problem is dense.
  bool is_due() {
    if (space_.size() + block_size > capacity_) return true;
    if (space_.size() < wanted_ + wanted_ / 4 + 2 * block_size || space_.size() < next_look_) {
      return false;
    }
    next_look_ = space_.size() + std::max(2 * block_size, space_.size() / 10);
    return true;
  }

  /// Rayleigh-Ritz beside the pairs that are locked, which would bring rounding of their own scale.
  void diagonalise() {
    const std::size_t size = space_.size();
    const std::size_t open = size - locked_;
    DenseMatrix h(open, open);
    for (std::size_t j = 0; j < open; ++j) {
      std::copy_n(projected_.column(locked_ + j) + locked_, open, h.column(j));
    }
    const std::vector<double> values = symmetric_eigenvalues(h);
    theta_.resize(locked_);
    residual_.assign(locked_, 0.0);
    DenseMatrix vectors(size, size);
    for (std::size_t i = 0; i < locked_; ++i) vectors.column(i)[i] = 1;
    for (std::size_t i = 0; i < open; ++i) {
      const double* s = h.column(open - 1 - i);
      theta_.push_back(values[open - 1 - i]);
      std::copy_n(s, open, vectors.column(locked_ + i) + locked_);
      residual_.push_back(length_of_rest(s + open - last_count_));
    }
    sort_pairs(vectors);
  }

  /// Pairs by theta, the largest first: one that was missed may lie among those that are locked.
  void sort_pairs(const DenseMatrix& vectors) {
    std::vector<std::size_t> order(theta_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [this](std::size_t i) { return theta_[i]; });
    std::vector<double> theta;
    std::vector<double> residual;
    vectors_ = DenseMatrix(vectors.rows, 0);
    vectors_.values.reserve(vectors.values.size());
    for (const std::size_t i : order) {
      theta.push_back(theta_[i]);
      residual.push_back(residual_[i]);
      vectors_.append({vectors.column(i), vectors.rows});
    }
    theta_ = std::move(theta);
    residual_ = std::move(residual);
  }

  /// |R s| with s the part of a vector of H in the last block.
  double length_of_rest(const double* s) const {
    double square = 0;
    for (std::size_t row = 0; row < last_.rows; ++row) {
      double sum = 0;
      for (std::size_t j = 0; j < last_count_; ++j) sum += last_.column(j)[row] * s[j];
      square += sum * sum;
    }
    return std::sqrt(square);
  }

  /// V := V S, the first Ritz vectors.
  void keep_ritz_vectors(std::size_t count) {
    DenseMatrix s(vectors_.rows, count);
    std::copy_n(vectors_.values.begin(), s.values.size(), s.values.begin());
    space_.combine(s);
  }

  /// Begins anew beside the pairs that have converged, as rigid motions do at once, where rounding
  /// of theirs is more than the residual that the last wanted pair may have; whether it does.
  bool lock_the_largest() {
    const double last = theta_[std::min(wanted_, theta_.size()) - 1];
    const double largest = last * residual_tolerance / std::numeric_limits<double>::epsilon();
    const std::size_t end = converged();
    std::size_t count = locked_;
    while (count < end && theta_[count] > largest) ++count;
    if (count == locked_) return false;
    cut_down_to(count);
    locked_ = count;
    return true;
  }

  void cut_down() {
    cut_down_to(std::min(wanted_ + 2 * block_size, space_.size() - block_size));
    locked_ = converged();
  }

  /// Makes the first Ritz vectors the space.
  void cut_down_to(std::size_t kept) {
    keep_ritz_vectors(kept);
    projected_ = DenseMatrix(kept, kept);
    for (std::size_t j = 0; j < kept; ++j) projected_.column(j)[j] = theta_[j];
    before_ = 0;
    next_look_ = 0;
  }

  /// Gives the pairs that have converged away.
  Eigenpairs pairs() {
    const std::size_t count = converged();
    keep_ritz_vectors(count);
    Eigenpairs found{{}, space_.release()};
    for (std::size_t i = 0; i < count; ++i) found.values.push_back(solver_.shift() + 1 / theta_[i]);
    return found;
  }

  const LinearSystem& system_;
  const Mesh& mesh_;
  const ShiftedSolver& solver_;
  std::size_t wanted_;
  std::size_t capacity_;        ///< of the space
  OrthonormalSpace space_;      ///< V
  DenseMatrix projected_;       ///< H, its upper triangle
  DenseMatrix last_;            ///< R
  std::size_t locked_ = 0;      ///< pairs that have converged, the first of the space
  std::size_t before_ = 0;      ///< columns before the last block
  std::size_t last_count_ = 0;  ///< columns of the last block
  std::uint64_t fresh_ = 0;     ///< columns that were made of nothing
  std::size_t next_look_ = 0;   ///< size of the space
  std::vector<double> theta_;   ///< decreasing
  DenseMatrix vectors_;         ///< S, in the order of theta_
  std::vector<double> residual_;
};

}  // namespace

std::size_t largest_krylov_space(std::size_t count) {
  return count + std::max(count / 2, 12 * block_size) + 2 * block_size;
}

Eigenpairs lowest_eigenpairs(const LinearSystem& system, const Mesh& mesh,
                             const ShiftedSolver& solver, std::size_t count) {
  BlockKrylov krylov(system, mesh, solver, count);
  Eigenpairs pairs = krylov.run();
  if (pairs.values.size() < count) {
    refuse_modes(system, mesh, static_cast<int>(pairs.values.size()), static_cast<int>(count));
  }
  return pairs;
}

}  // namespace pounding
