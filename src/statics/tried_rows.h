#pragma once

#include <memory>
#include <span>
#include <vector>

#include "statics/assembled_statics.h"
#include "statics/unilateral_rows.h"
#include "system/linear_system.h"

namespace pounding {

using Fields = std::vector<std::vector<double>>;  // per structure, owned dofs

Fields zeros(std::span<const LinearSystem> systems);

/// Forces of unilateral rows at rest. Rows join the complementarity problem when they are violated;
/// those that no iterate violates are never solved for.
class TriedRows {
 public:
  /// `stiffness`: per structure, there when rows are solved for. All are borrowed.
  TriedRows(UnilateralRows& rows, std::span<const LinearSystem> systems,
            const std::vector<std::unique_ptr<StaticStiffness>>& stiffness)
      : rows_(rows),
        systems_(systems),
        stiffness_(stiffness),
        force_(rows.size(), 0.0),
        is_tried_(rows.size(), false) {}

  int count() const { return static_cast<int>(tried_.size()); }
  const std::vector<double>& forces() const { return force_; }  ///< f per row [N]
  std::vector<double>& forces() { return force_; }
  /// Forces of rows [first, end) on the dofs.
  Fields on_dofs(int first, int end) const;
  /// Brings the forces to where rows are fulfilled whose openings are given with the forces in
  /// force; returns their change. Collective.
  std::vector<double> solve(std::vector<double> opening);

 private:
  /// Lets violated rows join; false if none was.
  bool try_violated(std::vector<double> opening, const std::vector<double>& change, double limit);
  void try_row(int row);
  /// 0 <= f _|_ H f + opening - H before >= 0 on the rows tried.
  void solve_tried(const std::vector<double>& opening, const std::vector<double>& before);

  UnilateralRows& rows_;
  std::span<const LinearSystem> systems_;
  const std::vector<std::unique_ptr<StaticStiffness>>& stiffness_;
  std::vector<double> force_;
  std::vector<int> tried_;                     ///< in the order they joined
  std::vector<char> is_tried_;                 ///< per row
  std::vector<std::vector<double>> response_;  ///< per row tried: w of all rows for a unit force
};

}  // namespace pounding
