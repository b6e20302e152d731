#pragma once

#include <span>
#include <string>
#include <vector>

#include "driver/model.h"
#include "driver/solver.h"
#include "interactions/link_records.h"
#include "scene/scene.h"

namespace pounding {

/// Links of one item of the option `loops`, after the run.
struct LoopReport {
  std::string name;
  std::vector<std::string> links;
  std::vector<interactions::LinkTotals> totals;  ///< per link

  /// Extremes over all links; `work` and `yielded` are sums.
  interactions::LinkTotals whole() const;
};

/// Links that the scene wants recorded: finds them, has their steps record them, and tells their
/// names and values. A link is named after its item, the element's number in the mesh file, and the
/// component ("frame:pads.17.x", a bar's "axial", a dashpot's "x.dashpot"); a pair with filler
/// after its contact and its number among the pairs.
class Loops {
 public:
  /// Starts recording. `solver` must outlive this object. Throws UserError for a group without
  /// links. Collective.
  Loops(MPI_Comm comm, const Scene& scene, const Model& model, Solver& solver);

  /// All links, the same on all ranks; and which of them this rank holds.
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<int>& mine() const { return mine_; }
  /// Elongation and force of each of this rank in the step just made.
  std::span<const double> values();
  /// Collective; the same on all ranks.
  std::vector<LoopReport> report() const;

 private:
  struct Own {
    const interactions::LinkRecords* records = nullptr;
    std::size_t number = 0;  ///< among those
  };

  MPI_Comm comm_;
  std::vector<std::string> items_;  ///< of the option
  std::vector<int> item_of_;        ///< per name
  std::vector<std::string> names_;
  std::vector<int> mine_;
  std::vector<Own> own_;  ///< per link of this rank
  std::vector<double> values_;
};

}  // namespace pounding
