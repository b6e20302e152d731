#pragma once

#include <span>
#include <vector>

#include "dynamics/state.h"
#include "mesh/mesh.h"
#include "mesh/probe_set.h"
#include "system/trace.h"

namespace pounding {

/// Mean velocities of probes, relative to the ground, whatever the fidelity of their structures; a
/// channel is a direction of a probe. Local.
class ProbeMeans {
 public:
  ProbeMeans(std::span<const ResolvedProbe> probes, std::span<const LinearSystem> systems,
             std::span<const Mesh> meshes);
  std::size_t channels() const { return channels_; }
  /// This rank's part of the channels [m/s]: the ranks' parts add up.
  void velocities(const State& state, std::span<double> channels);

 private:
  /// Nodes of probes on one structure that this rank knows.
  struct Nodes {
    std::size_t structure = 0;
    Trace trace;                        ///< three components of each node
    std::vector<std::size_t> channels;  ///< of every place
    std::vector<double> weights;        ///< of every place in the mean
    std::vector<double> values;         ///< of every place
  };
  std::size_t channels_ = 0;
  std::vector<Nodes> nodes_;
};

}  // namespace pounding
