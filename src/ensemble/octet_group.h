#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "ensemble/member_run.h"
#include "ensemble/octet_recorder.h"

namespace pounding {

/// Up to eight members of an ensemble from t_0 to the end time, stepped together: the free step in
/// lanes (OctetStep), gaps and contact member by member (MemberRun). The results of a member depend
/// neither on its lane nor on its companions. Local: nothing is communicated.
class OctetGroup {
 public:
  /// All arguments must outlive this object. `members`: at most eight.
  OctetGroup(std::span<const MemberScene* const> members, const Scene& scene,
             const EnsembleModel& shared, OctetRecorder& recorder);

  /// Steps to the end; false if `stopped`, asked now and then, said so. Throws DivergenceError with
  /// the lane's number in `failed_lane`.
  bool run(const std::function<bool()>& stopped);
  std::size_t failed_lane() const { return failed_lane_; }
  /// Results of the run in a lane.
  MemberResult result(std::size_t lane);
  /// Steps in which the gaps of a lane were looked at.
  std::int64_t looks(std::size_t lane) const { return runs_[lane]->looks(); }

 private:
  void step(std::int64_t n);
  /// Displacements of all lanes at the places of the interface.
  void find_places();
  void close_lines(std::int64_t n);

  const Scene& scene_;
  const Model& shared_;
  OctetRecorder& recorder_;
  std::vector<std::unique_ptr<MemberRun>> runs_;
  std::vector<OctetStep> steps_;            ///< per structure
  std::vector<OctetState> states_;          ///< per structure
  std::vector<std::vector<Octet>> places_;  ///< per structure, of the interface
  std::int64_t gap_stride_ = 1;             ///< steps between two samples of the gaps
  std::array<Octet, 3> acceleration_{};
  std::size_t failed_lane_ = 0;
};

}  // namespace pounding
