#pragma once

#include <span>
#include <vector>

#include "common/types.h"

namespace pounding::stiffness {

/// A sparse matrix over the owned rows of a rank, its columns split into owned dofs and ghosts, for
/// the few elements that nothing better fits. Rows without entries cost nothing.
class AssembledRows {
 public:
  /// Entries that elements will have; `slots` as in DofSlots.
  class Pattern {
   public:
    explicit Pattern(LocalIndex owned_dofs) : owned_(owned_dofs) { columns_.resize(owned_dofs); }
    void add(std::span<const LocalIndex> slots);

   private:
    friend class AssembledRows;
    LocalIndex owned_;
    std::vector<std::vector<LocalIndex>> columns_;
  };

  explicit AssembledRows(Pattern&& pattern);

  /// Adds an element matrix, shape (n, n), that the pattern knows. Entries sum in the order of the
  /// calls.
  void add(std::span<const LocalIndex> slots, std::span<const double> matrix);

  /// Rows with entries on owned columns, or on ghosts. An owned row is a column of one, too.
  const std::vector<LocalIndex>& owned_rows() const { return owned_part_.rows; }
  const std::vector<LocalIndex>& ghost_rows() const { return ghost_part_.rows; }

  /// Calls `visit(row, columns, values)` for each row with entries on owned columns.
  void each_owned(const auto& visit) const {
    for (std::size_t r = 0; r < owned_part_.rows.size(); ++r) {
      const std::size_t begin = owned_part_.start[r], count = owned_part_.start[r + 1] - begin;
      visit(owned_part_.rows[r], std::span(&owned_part_.columns[begin], count),
            std::span(&owned_part_.values[begin], count));
    }
  }
  /// q += the part that owned values, or ghosts, contribute.
  void add_owned(const double* owned, double* q) const { add_product(owned_part_, owned, q); }
  void add_ghosts(const double* ghosts, double* q) const { add_product(ghost_part_, ghosts, q); }

 private:
  struct Part {
    std::vector<LocalIndex> rows;
    std::vector<std::size_t> start{0};  ///< per row, and the end
    std::vector<LocalIndex> columns;    ///< sorted within a row
    std::vector<double> values;
  };
  static void add_product(const Part& part, const double* w, double* q);
  static void add_entry(Part& part, LocalIndex row, LocalIndex column, double value);

  LocalIndex owned_dofs_;
  Part owned_part_;
  Part ghost_part_;
};

}  // namespace pounding::stiffness
