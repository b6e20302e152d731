#include "ensemble/member_run.h"

#include <algorithm>
#include <limits>

#include "driver/time_loop.h"
#include "driver/watchdog.h"

namespace pounding {
namespace {

Solver::Parts parts_in_lane(const MemberScene& member, const EnsembleModel& shared,
                            const Model& model, RunLane lane, Profile& profile) {
  Solver::Parts parts =
      solver_parts(MPI_COMM_SELF, member.scene, model, shared.model->meshes, profile);
  parts.lane = lane;
  return parts;
}

/// The smallest recorded gap of each contact [m].
class SmallestGaps final : public Observer {
 public:
  SmallestGaps(const ObservedRun& run, std::vector<double>& smallest)
      : solver_(run.solver),
        rows_(run.model.interface.constraints),
        record_stride_(record_stride(run.scene, run.model)),
        gap_stride_(gap_stride(run.scene, run.model)),
        smallest_(smallest) {}

  std::int64_t next_due(std::int64_t step) const override {
    return next_multiple(step, gap_stride_);
  }
  StepNeeds begin(const CdLagrange& /*stepper*/) override { return {.gaps = true}; }
  bool follows() const override { return true; }
  void follow(const CdLagrange& stepper) override {
    if (!solver_.interface_known() || (stepper.state().step - 1) % record_stride_ != 0) return;
    const std::vector<double>& gaps = solver_.contact()->gaps();
    for (std::size_t row = 0; row < gaps.size(); ++row) {
      double& gap = smallest_[rows_[row].contact];
      gap = std::min(gap, gaps[row]);
    }
  }

 private:
  const Solver& solver_;
  std::span<const interactions::Constraint> rows_;
  std::int64_t record_stride_;  ///< steps between two records
  std::int64_t gap_stride_;     ///< and between two samples of the gaps, a multiple of it
  std::vector<double>& smallest_;
};

}  // namespace

MemberRun::MemberRun(const MemberScene& member, const EnsembleModel& shared, const Model& model,
                     RunLane lane)
    : solver_(parts_in_lane(member, shared, model, lane, profile_)),
      run_{MPI_COMM_SELF, member.scene, model, solver_},
      impacts_(observers_.add(std::make_unique<ImpactWatch>(run_))),
      smallest_gaps_(member.scene.contacts.size(), std::numeric_limits<double>::infinity()) {
  observers_.add(std::make_unique<SmallestGaps>(run_, smallest_gaps_));
  observers_.add(make_energy_watch(run_));
  observers_.start(solver_.stepper(), nullptr);
}

bool MemberRun::open() {
  const StepNeeds needs = observers_.before(solver_.stepper());
  return solver_.stepper().open(needs.gaps, needs.energies);
}

void MemberRun::close() {
  solver_.stepper().close();
  observers_.after(solver_.stepper());
}

void MemberRun::fill(MemberResult& result) {
  impacts_.finish(true);
  const ImpactCatalogue& catalogue = impacts_.catalogue();
  const std::size_t contacts = smallest_gaps_.size();
  result.smallest_gap = smallest_gaps_;
  result.energy_residual = {solver_.stepper().energy().relative_residual()};
  if (solver_.contact() != nullptr) {
    result.contact_residual = {solver_.contact()->largest_residual()};
  }
  result.first_time.assign(contacts, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t c = 0; c < contacts; ++c) {
    const ImpactTotals totals = catalogue.totals(static_cast<int>(c));
    result.episodes.push_back(totals.episodes);
    result.impulse_sum.push_back(totals.total_impulse);
    result.impulse_largest.push_back(totals.largest_impulse);
    result.force_peak.push_back(totals.peak_force);
  }
  for (const Impact& impact : catalogue.impacts()) {  // the earliest first
    double& first = result.first_time[impact.contact];
    if (!(first <= impact.start)) first = impact.start;
  }
}

}  // namespace pounding
