#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/linear_system.h"
#include "system/trace.h"

namespace pounding {

/// A bar that buckles, between two nodes of which this rank owns those that can move.
struct TensionBar {
  std::array<int, 6> place{};  ///< of its ends' components in the trace of all bars; -1: held
  Vector3 axis{0, 0, 0};       ///< from the first end to the second, of length 1
  double stiffness = 0;        ///< k = E A / L [N/m]
  double damping = 0;          ///< beta k while it is taut [N s/m]

  /// axis . (w_2 - w_1) of a field at the places of the trace.
  double elongation(std::span<const double> field) const;
};

/// The bars of a structure that resist stretching only; the law by which they pull is in
/// dynamics/tension_law.h. The one nonlinear element; only structures that have it make one of
/// these. Bars that share a node that can move live on one rank, with all that moves with their
/// nodes (see `coupled_nodes`). Constant during a run.
class TensionBars {
 public:
  /// Null if the structure has no tension-only bar. Throws std::logic_error if the nodes of one
  /// live on several ranks.
  static std::unique_ptr<TensionBars> build(const Structure& structure, const Mesh& mesh);

  /// Once the system's mass is complete.
  void find_trace(const LinearSystem& system, const Mesh& mesh);

  const std::vector<TensionBar>& bars() const { return bars_; }  ///< of this rank
  const Trace& trace() const { return *trace_; }
  GlobalIndex count() const { return count_; }

 private:
  TensionBars() = default;
  void add(const Structure& structure, const Mesh& mesh, const ElementBlock& block,
           std::size_t element);

  GlobalIndex count_ = 0;
  std::vector<TensionBar> bars_;
  std::vector<LocalIndex> dofs_;  ///< per place of the trace, increasing
  std::unique_ptr<Trace> trace_;
};

}  // namespace pounding
