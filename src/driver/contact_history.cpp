#include "driver/contact_history.h"

#include <cmath>
#include <span>

#include "driver/field_plan.h"
#include "driver/run_statistics.h"

namespace pounding {
namespace {

/// Closings below this part of the gap are no motion.
constexpr double least_share = 1e-6;

class ContactHistory final : public Observer {
 public:
  explicit ContactHistory(const ObservedRun& run)
      : run_(run),
        gap_stride_(gap_stride(run.scene, run.model)),
        impulses_(run.scene.contacts.size(), 0.0),
        values_(2 * impulses_.size()),
        closings_(impulses_.size()) {}

  std::int64_t next_due(std::int64_t step) const override { return run_.next_record_step(step); }
  StepNeeds begin(const CdLagrange& stepper) override {
    return {.gaps = stepper.state().step % gap_stride_ == 0};
  }
  bool follows() const override { return run_.is_contact_root(); }
  void follow(const CdLagrange& stepper) override;
  void observe(const CdLagrange& stepper) override;
  void save(SavedState& saved) override;
  void load(const SavedState& saved) override;
  void report(RunStatistics& statistics) override;
  std::optional<RecordColumns> columns() const override;

 private:
  int contact_of(std::size_t row) const { return run_.model.interface.constraints[row].contact; }
  void note_closing(std::size_t row, double gap);

  ObservedRun run_;
  std::int64_t gap_stride_;       ///< steps between two samples of the gaps
  std::vector<double> impulses_;  ///< per contact, since the last record [N s]
  std::vector<double> values_;    ///< gap and force of each contact
  std::vector<JointClosing> closings_;
};

}  // namespace

void ContactHistory::follow(const CdLagrange& /*stepper*/) {
  if (!run_.solver.rows_act()) return;
  const std::span<const double> impulses = run_.solver.row_actions().impulses;
  for (std::size_t row = 0; row < impulses.size(); ++row) {
    impulses_[contact_of(row)] += impulses[row];
  }
}

void ContactHistory::observe(const CdLagrange& /*stepper*/) {
  if (!run_.is_contact_root()) return;
  const bool known = run_.solver.interface_known();
  for (std::size_t c = 0; c < impulses_.size(); ++c) {
    values_[2 * c] =
        known ? std::numeric_limits<double>::max() : std::numeric_limits<double>::quiet_NaN();
    values_[2 * c + 1] =
        impulses_[c] / (run_.model.time_step * record_stride(run_.scene, run_.model));
    impulses_[c] = 0;
  }
  if (!known) return;
  const std::span<const double> gaps = run_.solver.contact()->gaps();
  for (std::size_t row = 0; row < gaps.size(); ++row) {
    double& smallest = values_[2 * contact_of(row)];
    smallest = std::min(smallest, gaps[row]);
    note_closing(row, gaps[row]);
  }
}

void ContactHistory::note_closing(std::size_t row, double gap) {
  const double start = run_.model.start_gaps[row];
  const double closing = start - gap;
  if (start == interactions::open_gap || gap == interactions::open_gap || !(closing > 0)) return;
  JointClosing& joint = closings_[contact_of(row)];
  joint.largest = std::max(joint.largest, closing);
  if (closing > least_share * start) {
    joint.factor = std::min(joint.factor, std::max(0.0, start) / closing);
  }
}

std::optional<RecordColumns> ContactHistory::columns() const {
  RecordColumns columns{"contacts", run_.contact_names(), {}, {}, {}};
  if (!columns.names.empty()) columns.quantities = {{"gap", "m"}, {"contact_force", "N"}};
  if (run_.is_contact_root()) columns.take_all(values_);
  return columns;
}

void ContactHistory::save(SavedState& saved) {
  if (run_.is_contact_root()) saved.put("recorder_impulse", impulses_);
  if (rank_of(run_.comm) != std::max(run_.contact_root(), 0)) return;
  std::vector<double> numbers;
  for (const JointClosing& joint : closings_) {
    // A joint that never closes has no factor, and no infinite number goes into files.
    const bool closes = std::isfinite(joint.factor);
    numbers.insert(numbers.end(), {joint.largest, closes ? joint.factor : -1});
  }
  saved.put("joint_closings", numbers, 2);
}

void ContactHistory::load(const SavedState& saved) {
  if (run_.contact_root() >= 0) saved.get("recorder_impulse", impulses_);
  std::vector<double> numbers(2 * closings_.size());
  saved.get("joint_closings", numbers);
  for (std::size_t c = 0; c < closings_.size(); ++c) {
    closings_[c].largest = numbers[2 * c];
    if (numbers[2 * c + 1] >= 0) closings_[c].factor = numbers[2 * c + 1];
  }
}

void ContactHistory::report(RunStatistics& statistics) {
  if (run_.contact_root() < 0) return;
  statistics.closings = closings_;
  broadcast_array(run_.comm, statistics.closings, run_.contact_root());
}

std::unique_ptr<Observer> make_contact_history(const ObservedRun& run) {
  return std::make_unique<ContactHistory>(run);
}

}  // namespace pounding
