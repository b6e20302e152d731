#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/profile.h"
#include "common/saved_state.h"
#include "dynamics/cd_lagrange.h"

namespace pounding {

/// Columns of `history.h5` beside the motion of probes: their names and datasets, and the columns
/// whose values this rank brings to a record.
struct RecordColumns {
  /// A dataset with a value per column.
  struct Quantity {
    std::string name;
    std::string unit;
  };

  std::string list;                ///< dataset of the names
  std::vector<std::string> names;  ///< of all ranks, the same on all of them
  std::vector<Quantity> quantities;
  std::vector<int> mine;           ///< columns of this rank; of shared ones the values are added
  std::span<const double> values;  ///< of these when a record is made, shape (mine, quantities)

  /// This rank has all columns, with values of shape (columns, quantities).
  void take_all(std::span<const double> all) {
    mine.resize(names.size());
    std::iota(mine.begin(), mine.end(), 0);
    values = all;
  }
};

class ImpactCatalogue;
class Recorder;
struct MemberResult;
struct RunStatistics;

/// Results of a step beside the motion, for which an output asks.
struct StepNeeds {
  bool gaps = false;      ///< of the interface, however wide it is open
  bool energies = false;  ///< for the line of the ledger before the step
  bool forces = false;    ///< at the dofs that are watched
};

/// An output of a run: it sees the steps that it is due at, and those in between if it sums over
/// them, keeps its findings in checkpoints, and adds them to the report. All calls but `follow`
/// come on every rank in the same order and may be collective. A call that is not overridden does
/// nothing.
class Observer {
 public:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer() = default;

  /// Before the first step: begins its files, or takes over those of the run that `continued` is
  /// the state of, once `keep_state` of all observers has accepted that. Null: a new run.
  virtual void start(const CdLagrange& /*stepper*/, const SavedState* /*continued*/) {}
  /// The first step from `step` on at which it is due, the same on every rank.
  virtual std::int64_t next_due(std::int64_t /*step*/) const { return never; }
  /// Before a step at which it is due, the state being u_n and v_{n-1/2}.
  virtual StepNeeds begin(const CdLagrange& /*stepper*/) { return {}; }
  /// After it, the state being u_{n+1} and v_{n+1/2}.
  virtual void observe(const CdLagrange& /*stepper*/) {}
  /// Whether this rank follows every step, to sum over those between; called before `observe`.
  virtual bool follows() const { return false; }
  virtual void follow(const CdLagrange& /*stepper*/) {}

  /// Brings to its files all that it holds back.
  virtual void flush() {}
  /// After the last step, `complete` if that is the last one of the scene: closes its files.
  virtual void finish(bool /*complete*/) {}
  /// Puts the state that a continued run needs, or brings it back; then it throws UserError on
  /// every rank alike.
  virtual void keep_state(const StateKeeper& /*state*/) {}
  /// After `finish`: adds its findings, and writes its tables.
  virtual void report(RunStatistics& /*statistics*/) {}

  /// Columns that it brings to every record of the history. Local.
  virtual std::optional<RecordColumns> columns() const { return std::nullopt; }
  /// Results that others read of it; null where it has none.
  virtual const ImpactCatalogue* impacts() const { return nullptr; }
  virtual const Recorder* history() const { return nullptr; }
  /// After `finish`: adds the numbers that an ensemble keeps of a member, always as many of them.
  virtual void keep(MemberResult& /*member*/) const {}
  /// Phase of the profile that its time counts for.
  virtual Phase phase() const { return Phase::output; }
};

/// The first multiple of `stride` from `step` on.
inline std::int64_t next_multiple(std::int64_t step, std::int64_t stride) {
  return (step + stride - 1) / stride * stride;
}

/// The observers of a run, in the order in which they are called. A step at which none is due costs
/// one comparison, and a call for each that follows.
class Observers {
 public:
  /// `profile` must outlive this object.
  explicit Observers(Profile& profile) : profile_(profile) {}

  template <typename Kind>
  Kind& add(std::unique_ptr<Kind> observer) {
    Kind& added = *observer;
    list_.push_back(std::move(observer));
    return added;
  }
  std::span<const std::unique_ptr<Observer>> list() const { return list_; }
  /// Results of the observers that have them; they must be there.
  const ImpactCatalogue& impacts() const;
  const Recorder& history() const;

  /// `continued`: see Observer::start. Collective.
  void start(const CdLagrange& stepper, const SavedState* continued);
  /// Before a step: the needs of those that are due. Collective.
  StepNeeds before(const CdLagrange& stepper) {
    return stepper.state().step < earliest_ ? StepNeeds{} : begin_due(stepper);
  }
  /// After it. Collective.
  void after(const CdLagrange& stepper);

 private:
  StepNeeds begin_due(const CdLagrange& stepper);

  Profile& profile_;
  std::vector<std::unique_ptr<Observer>> list_;
  std::vector<Observer*> followers_;
  std::vector<std::int64_t> next_;  ///< step at which each one is due
  std::vector<std::size_t> due_;    ///< at the step at hand
  std::int64_t earliest_ = 0;       ///< of `next_`
};

}  // namespace pounding
