#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <mpi.h>

#include "interactions/interface_rows.h"
#include "solvers/proportioning.h"

namespace pounding::interactions {

/// A group of coupled rows of H that several ranks solve together, each its share: parts of alike
/// size that few couplings cross, each given to the rank that knows most of its dofs. Rows have
/// numbers by parts, which begin at multiples of eight. Allocates nothing after construction.
class SharedRows final : public RowShare {
 public:
  /// `rows`: all of the group, ascending; per row, how many of its dofs this rank knows, and the
  /// places in the group of the rows `coupled` with it. `holds`: whether this rank takes a share;
  /// the others are done with it after construction, and may leave the arrays empty. Every share
  /// must have rows. Collective over `comm`.
  SharedRows(MPI_Comm comm, bool holds, const std::vector<int>& rows, std::span<const int> known,
             std::span<const std::vector<int>> coupled);

  const std::vector<int>& rows() const { return rows_; }  ///< of this rank, ascending
  std::size_t first() const { return first_; }            ///< number of the first of them
  std::size_t numbers() const { return numbers_; }        ///< above that of any row
  /// Number of each row of the group, in the order given.
  std::span<const int> number() const { return number_; }

  /// A row of another rank that moves dofs that this one knows, or those of its rows.
  struct Felt {
    int row = 0;
    std::size_t number = 0;
  };
  const std::vector<Felt>& felt() const { return felt_; }
  /// Brings the values of those; `values`: per number. Collective over the ranks of the group.
  void bring_felt(std::span<double> values);

  void bring(std::span<double> values) override;
  void agree(std::span<double> sums, std::span<double> least) override {
    near_->agree(sums, least);
  }

 private:
  /// Numbers all rows, and finds those of this rank; `rank_of_part` in ranks of `comm`.
  void number_rows(const std::vector<int>& rows, std::span<const int> part,
                   std::span<const int> rank_of_part, int me);

  std::vector<int> rows_;
  std::vector<int> number_;
  std::vector<Felt> felt_;
  std::vector<int> border_;  ///< numbers of rows here that rows of others feel
  std::vector<double> sent_;
  std::size_t first_ = 0;
  std::size_t numbers_ = 0;
  std::unique_ptr<InterfaceGather> near_;  ///< of rows at borders
  std::unique_ptr<InterfaceGather> all_;   ///< of all rows, to where they are felt
};

}  // namespace pounding::interactions
