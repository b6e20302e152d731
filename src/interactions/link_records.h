#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/saved_state.h"

namespace pounding::interactions {

/// Extremes of a recorded link, and the work it took.
struct LinkTotals {
  double largest_elongation = 0;  ///< magnitude [m, rad]
  double largest_force = 0;       ///< magnitude [N, N m]
  double work = 0;                ///< sum of N_n (e_{n+1} - e_{n-1}) / 2 [J]
  double yielded = 0;             ///< 1: it left its straight line for good
};

/// Elongation and force of chosen links in the step at hand, and their extremes and work so far.
/// Reads and changes nothing else. Local.
class LinkRecords {
 public:
  /// `links`: which ones to record, numbers among those of their owner. `push_only`: what is below
  /// zero is no elongation of theirs, the joint is open.
  void watch(std::vector<std::size_t> links, bool push_only = false);
  bool empty() const { return links_.empty(); }
  const std::vector<std::size_t>& links() const { return links_; }

  /// Link k of those chosen in the step from t_n: e_n [m, rad], N_n [N, N m].
  void note(std::size_t k, double elongation, double force, bool yielded);
  void add_work(std::size_t k, double work) { totals_[k].work += work; }

  double elongation(std::size_t k) const { return elongation_[k]; }
  double force(std::size_t k) const { return force_[k]; }
  const LinkTotals& totals(std::size_t k) const { return totals_[k]; }

  /// Under a name for each chosen link, in their order.
  void save(const std::vector<std::string>& names, SavedState& saved) const;
  void load(const std::vector<std::string>& names, const SavedState& saved);

 private:
  bool push_only_ = false;
  std::vector<std::size_t> links_;
  std::vector<double> elongation_;
  std::vector<double> force_;
  std::vector<LinkTotals> totals_;
};

}  // namespace pounding::interactions
