#include "driver/uplift_watch.h"

#include "common/number_rows.h"
#include "driver/run_statistics.h"

namespace pounding {
namespace {

/// The numbers of a ratio in a saved state.
constexpr auto ratio_members = [](auto& ratio, const auto& take) {
  take(ratio.now, ratio.smallest, ratio.time, ratio.low_duration);
};

class UpliftWatch final : public Observer {
 public:
  explicit UpliftWatch(const ObservedRun& run) : run_(run), ratios_(run.model.systems.size()) {}

  std::int64_t next_due(std::int64_t step) const override { return run_.next_ledger_step(step); }
  void observe(const CdLagrange& stepper) override;
  void save(SavedState& saved) override {
    if (rank_of(run_.comm) == 0) saved.put("contact_ratio", to_rows(ratios_, ratio_members));
  }
  void load(const SavedState& saved) override {
    std::vector<double> numbers(4 * ratios_.size());
    saved.get("contact_ratio", numbers);
    from_rows(numbers, ratios_, ratio_members);
  }
  void report(RunStatistics& statistics) override { statistics.contact_ratios = ratios_; }

 private:
  ObservedRun run_;
  std::vector<ContactRatio> ratios_;  ///< per structure, alike on all ranks
};

}  // namespace

void UpliftWatch::observe(const CdLagrange& stepper) {
  const int between = run_.scene.energy_interval;
  const std::int64_t rest = (stepper.state().step - 1) % between;  // of the last line
  const double interval = static_cast<double>(rest == 0 ? between : rest) * stepper.time_step();
  std::vector<double> sums;  // pressed and all, structure by structure
  for (std::size_t s = 0; s < ratios_.size(); ++s) {
    const interactions::StructureLinks* const links = run_.solver.links(s);
    const auto bedding =
        links != nullptr ? links->bedding() : interactions::StructureLinks::Bedding{};
    sums.insert(sums.end(), {bedding.pressed, bedding.all});
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                run_.comm);
  for (std::size_t s = 0; s < ratios_.size(); ++s) {
    if (!(sums[2 * s + 1] > 0)) continue;
    ContactRatio& ratio = ratios_[s];
    ratio.now = sums[2 * s] / sums[2 * s + 1];
    if (ratio.now < ContactRatio::low) ratio.low_duration += interval;
    if (ratio.now < ratio.smallest) {
      ratio.smallest = ratio.now;
      ratio.time = stepper.time();
    }
  }
}

std::unique_ptr<Observer> make_uplift_watch(const ObservedRun& run) {
  return std::make_unique<UpliftWatch>(run);
}

}  // namespace pounding
