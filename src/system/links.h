#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "links/link_law.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/linear_system.h"
#include "system/trace.h"

namespace pounding {

/// A link between two nodes of which this rank owns those that can move.
struct Link {
  std::array<int, 6> place{};      ///< of its ends' components in the trace of all links; -1: held
  Vector3 axis{0, 0, 0};           ///< from the first end to the second, of length 1
  double length = 0;               ///< [m]
  double beta = 0;                 ///< stiffness damping of its structure [s]
  const Region* region = nullptr;  ///< borrowed from the structure
  std::int64_t number = 0;  ///< among the elements of its structure's file; its name in checkpoints

  /// axis . (w_2 - w_1) of a field at the places of the trace.
  double elongation(std::span<const double> field) const;
};

/// Links of a structure: elements between two nodes whose force is not linear in their elongation.
/// Today these are the bars that resist stretching only. Links that share a node that can move live
/// on one rank, with all that moves with their nodes (see `coupled_nodes`). Constant during a run;
/// what evolves is with LinkStep.
class Links {
 public:
  /// Null if the structure has no link. Throws std::logic_error if the nodes of one live on several
  /// ranks.
  static std::unique_ptr<Links> build(const Structure& structure, const Mesh& mesh);

  /// Once the system's mass is complete.
  void find_trace(const LinearSystem& system, const Mesh& mesh);

  const std::vector<Link>& links() const { return links_; }  ///< of this rank
  const Trace& trace() const { return *trace_; }

 private:
  Links() = default;
  void add(const Structure& structure, const Mesh& mesh, const ElementBlock& block,
           std::size_t element);

  std::vector<Link> links_;
  std::vector<LocalIndex> dofs_;  ///< per place of the trace, increasing
  std::unique_ptr<Trace> trace_;
};

}  // namespace pounding
