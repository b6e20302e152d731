#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "laws/link_law.h"

namespace pounding::interactions {

/// Response of a row to another: the velocity b_i^T M^-1 b_j per impulse [1/kg].
struct Coupling {
  std::size_t row = 0;
  double compliance = 0;
};

/// Part of a row in the six motions of the one rigid body that alone it moves, W^T b.
struct OnBody {
  using Motion = std::array<double, 6>;
  int body = -1;  ///< -1: it moves something else
  Motion motion{};
};

/// Elongations of all rows of a step [m, rad].
struct Elongations {
  std::vector<double> before;      ///< e_{n-1}
  std::vector<double> now;         ///< e_n; 0 of laws with a rate
  std::vector<double> free_after;  ///< e_{n+1} without the rows' forces

  explicit Elongations(std::size_t rows) : before(rows), now(rows), free_after(rows) {}
};

/// Memories of laws, row by row; see LinkLaw.
class LawMemory {
 public:
  explicit LawMemory(std::span<const std::unique_ptr<LinkLaw>> laws);
  std::span<double> operator[](std::size_t row) {
    return {values_.data() + begin_[row], begin_[row + 1] - begin_[row]};
  }
  std::span<const double> operator[](std::size_t row) const {
    return {values_.data() + begin_[row], begin_[row + 1] - begin_[row]};
  }
  /// All of them, row after row.
  std::span<double> values() { return values_; }

 private:
  std::vector<double> values_;
  std::vector<std::size_t> begin_{0};
};

/// Forces N_n [N] of rows that follow laws and move each other, in one step:
///
///     N_i = law_i( e_{n-1}, e_n, e_{n+1} ),     e_{n+1} = e_free - share dt^2 B^T M^-1 B N
///
/// Rows with a rate that move each other directly are solved for together (block); the others by
/// Gauss-Seidel sweeps over blocks and rows, which converge since no force falls as its elongation
/// grows; where all of them are explicit, one pass over them and then the blocks is exact. Rows on
/// one rigid body move each other by products of their motions, so that many of them cost no more
/// than a few each. Pure: no MPI, no PETSc; `solve` allocates nothing.
class LawSolver {
 public:
  using Laws = std::span<const std::unique_ptr<LinkLaw>>;

  /// `couplings` per row: itself first, then every other row that it moves, but those on the same
  /// body; `on_body` per row, or empty. The laws must outlive this object.
  LawSolver(Laws laws, std::vector<std::vector<Coupling>> couplings, std::vector<OnBody> on_body,
            double time_step);

  /// No row can pull in a step from these e_n.
  bool is_idle(std::span<const double> now, const LawMemory& memory) const;
  /// Forces of all rows in a step of which they act for `share`; `driven` [N] is taken off rows
  /// with a rate. Throws std::logic_error if the compliance of a block is not positive.
  void solve(double share, const Elongations& elongations, std::span<const double> driven,
             const LawMemory& memory, std::vector<double>& force);

 private:
  using Motion = OnBody::Motion;
  /// Rows with a rate that move each other, solved for together.
  struct Block {
    int body = -1;  ///< all on this one: solved for by its motions
    std::vector<std::size_t> rows;
    std::vector<double> compliance;  ///< dt^2 B^T M^-1 B, shape (rows, rows) [m/N]
    std::vector<double> inverse;     ///< of that for `share_` of a step and 1 / rate [N/m]; on a
                                     ///< body that of 1 / (share dt^2) + B^T W rate W^T B
    std::vector<double> free;        ///< e_{n+1} - e_{n-1} without them
    std::vector<double> force;
  };
  /// Quantities of the step that is being solved.
  struct Problem {
    const Elongations& elongations;
    std::span<const double> driven;
    const LawMemory& memory;
    std::vector<double>& force;
  };

  void find_blocks();
  void fill_block(Block& block, const std::vector<std::size_t>& place);
  void form_inverses(double share);
  void invert_on_body(Block& block);
  /// Forces of rows none of which lets go in the step; false if one may.
  bool hold(const Problem& problem);
  /// Largest change of the force of a row without a rate [N].
  double solve_others(const Problem& problem);
  /// Forces of a block from those of the other rows.
  void solve_block(const Problem& problem, Block& block);
  void solve_on_body(Block& block);
  /// Brings block_pull_ to the forces of a block.
  void renew_pull(const Problem& problem, const Block& block);
  /// e_{n+1} that forces of other rows than those of its block leave a row.
  double left_over(const Problem& problem, std::size_t row) const;
  int body_of(std::size_t row) const { return on_body_.empty() ? -1 : on_body_[row].body; }

  Laws laws_;
  double time_step_;
  /// Per row: itself first, none of its block; dt^2 b_i^T M^-1 b_j [m/N].
  std::vector<std::vector<Coupling>> coupled_;
  std::vector<OnBody> on_body_;
  std::vector<Block> blocks_;
  std::vector<double> rate_;         ///< per row, for `share_` of a step; 0: it has none
  std::vector<std::size_t> others_;  ///< rows without a rate
  bool explicit_ = false;            ///< all of these are, so that one pass solves for them
  std::vector<double> reach_;        ///< sum of the moduli of a row's compliances [m/N]; empty
                                     ///< where `hold` does not give it
  std::vector<Motion> pull_;         ///< per body: sum of W^T b N of rows without a rate on it
  std::vector<Motion> block_pull_;   ///< the same of those with a rate
  double share_ = 0;                 ///< of a step, for which forces act
};

}  // namespace pounding::interactions
