#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "ensemble/member_run.h"
#include "ensemble/octet_recorder.h"

namespace pounding {

/// Up to eight members of an ensemble from t_0 to the end time, stepped together: the structures in
/// lanes (OctetStep), interactions and outputs member by member (MemberRun). A member's results
/// depend neither on its lane nor on its companions. Local: nothing is communicated.
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

 private:
  void step(std::int64_t n);

  const Scene& scene_;
  const Model& shared_;
  OctetRecorder& recorder_;
  std::vector<Model> models_;      ///< per member, as the next ones
  std::vector<OctetStep> octets_;  ///< per structure
  std::vector<std::unique_ptr<MemberRun>> runs_;
  std::array<Octet, 3> acceleration_{};
  std::size_t failed_lane_ = 0;
};

}  // namespace pounding
