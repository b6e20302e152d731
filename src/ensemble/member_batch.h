#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "common/memory.h"
#include "dynamics/batch_step.h"
#include "ensemble/batch_passes.h"
#include "ensemble/coordinate_rows.h"
#include "ensemble/member_scene.h"
#include "observers/observed_run.h"

namespace pounding {

/// One run of a batch: the scheme of single runs in its place, with interactions, ledger and
/// those outputs of single runs that an ensemble keeps. Local.
class MemberRun {
 public:
  /// `slot`: where the structures of `model`, the member's own, are stepped. The arguments
  /// must outlive this object.
  MemberRun(const MemberScene& member, const EnsembleModel& shared, const Model& model,
            BatchSlot slot);

  /// Before the structures' step; returns whether that is to be made with energies, with forces.
  StepNeeds open();
  /// After it. Throws DivergenceError if this member's numbers cannot be trusted.
  void close();
  const CdLagrange& stepper() const { return scheme_.stepper(); }
  /// The step of structures that no batch steps.
  void step_alone(bool with_forces) { scheme_.stepper().free_velocity(with_forces); }

  /// Impacts, gaps, forces and the ledger's residual.
  void fill(MemberResult& result);

 private:
  Profile profile_{Profile::Clock::off};
  ModelScheme scheme_;
  ObservedRun run_;
  Observers observers_;
  int record_stride_;               ///< steps between two records
  std::span<const double> forces_;  ///< of the last record
  std::vector<double> history_;     ///< of these at all records
};

/// Records the probes of eight runs, as Recorder does those of one: largest displacement, and the
/// history of the absolute acceleration, which is the change of velocity over the interval, ground
/// included. A channel is a direction of a probe. Everything is kept in memory: channels x records
/// x 8 doubles, which the next group of runs uses again.
class BatchRecorder {
 public:
  struct Times {
    double time_step = 0;    ///< [s]
    int stride = 1;          ///< steps between two records
    std::int64_t steps = 0;  ///< last step of a run
    double start = 0;        ///< records before do not count as peaks [s]
  };

  /// `model`: of any of the runs, whose coordinates are alike.
  BatchRecorder(const Model& model, const Times& times);

  std::size_t channels() const { return channels_; }
  double interval() const { return interval_; }
  /// The first record that counts.
  std::size_t first() const { return first_; }
  /// Memory that records of so many channels take [bytes].
  static double memory(std::size_t channels, const Times& times);

  /// Begins runs from their states at t = 0. `supports`, here and below: motion of the supports as
  /// that of the coordinates is taken, per column; empty where the ground moves as one.
  void restart(std::span<const StatesOfRuns> states, const std::vector<BatchValue>& supports);
  bool due(std::int64_t step) const { return step % stride_ == 0; }
  /// The ground's acceleration in a step [m/s2], and how long it acted [s].
  void add_step(double duration, const std::array<BatchValue, 3>& acceleration);
  /// Before the step to be recorded.
  void take_displacements(std::span<const StatesOfRuns> states,
                          const std::vector<BatchValue>& supports);
  /// After it.
  void record(std::span<const StatesOfRuns> states, const std::vector<BatchValue>& supports);
  /// After the last record: samples of a channel of a run [m/s2].
  std::span<const double> acceleration(std::size_t channel, std::size_t member);
  double largest_displacement(std::size_t channel, std::size_t member) const {
    return displacement_[channel][member];
  }
  /// How far the second end of each span moved against its first since the start of a run at most,
  /// and when: three displacements and their length, three rotations and theirs.
  void fill_spans(std::size_t member, MemberResult& result) const;
  /// How far each base of structures lies lower at the end than at the start of a run, how far it
  /// did at most, and how far it stays moved in plan.
  void fill_bases(std::size_t member, MemberResult& result) const;

 private:
  /// Probes, rotations and base of one structure.
  struct Rows {
    std::size_t structure = 0;
    CoordinateRows values;
    std::vector<double> carried;        ///< by supports, shape (channels, columns); or empty
    std::vector<std::size_t> channels;  ///< numbers among all
  };
  /// Looks how far the ends of spans are apart at `time` [s]. `counts`: for the largest.
  void note_spans(double time, bool counts);
  void note_bases();
  /// values_ := rows times a part of the states, and the way with the supports.
  void multiply(std::span<const StatesOfRuns> states, const StatePart& part,
                const std::vector<BatchValue>& supports);
  /// Brings the records of the block to the histories.
  void flush();

  static constexpr std::size_t block_records = 256;

  std::size_t channels_ = 0;
  int stride_;
  double interval_;
  std::size_t first_;
  std::size_t capacity_;  ///< records of a run
  std::vector<Rows> rows_;
  std::vector<BatchValue> values_;         ///< per channel, and behind these of rotations, of bases
  std::vector<BatchValue> products_;       ///< of the channels of one structure
  std::vector<BatchValue> last_velocity_;  ///< per channel
  std::vector<BatchValue> displacement_;   ///< per channel, largest
  /// Per end of spans, first value of its displacements and its rotations.
  std::vector<std::array<std::size_t, 2>> ends_;
  std::vector<BatchValue> apart_;  ///< per span, six at the start
  /// Eight of each, largest and when; of lengths the square.
  std::vector<std::array<BatchValue, 2>> largest_;
  std::vector<BatchValue> bases_at_start_;  ///< three per base, as the next ones [m]
  std::vector<BatchValue> bases_moved_;     ///< since then
  std::vector<BatchValue> lowest_;          ///< per base, how far it was below at most [m]
  std::array<BatchValue, 3> ground_{};
  std::vector<BatchValue> block_;  ///< shape (block records, channels)
  LargeArray history_;             ///< shape (channels, members, records)
  std::size_t blocked_ = 0;
  std::size_t records_ = 0;  ///< made, those of the block included
};

/// Up to eight members of an ensemble from t_0 to the end time, stepped together: the structures in
/// batches (BatchStep) where that pays, interactions and outputs member by member (MemberRun). A
/// member's results depend neither on its place nor on its companions. Local: nothing is
/// communicated.
class MemberBatch {
 public:
  /// All arguments must outlive this object. `members`: at most eight.
  MemberBatch(std::span<const MemberScene* const> members, const Scene& scene,
              const EnsembleModel& shared, BatchRecorder& recorder);

  /// Steps to the end; false if `stopped`, asked now and then, said so. Throws DivergenceError with
  /// the member's number in `failed_member`.
  bool run(const std::function<bool()>& stopped);
  std::size_t failed_member() const { return failed_; }
  /// Results of a member.
  MemberResult result(std::size_t member);

 private:
  void step(std::int64_t n);
  /// Motion of the supports of all members, per column; `part`: of a stepper.
  const std::vector<BatchValue>& motion_of_supports(const auto& part);

  const Scene& scene_;
  const Model& shared_;
  BatchRecorder& recorder_;
  std::vector<Model> models_;  ///< per member, as the next ones
  BatchPasses passes_;
  /// Per structure; null where every run steps its own.
  std::vector<std::unique_ptr<BatchStep>> batches_;
  std::vector<BatchStep*> slots_;     ///< these
  std::vector<StatesOfRuns> states_;  ///< per structure
  std::vector<std::unique_ptr<MemberRun>> runs_;
  std::array<BatchValue, 3> acceleration_{};
  std::vector<BatchValue> supports_;
  std::size_t failed_ = 0;
};

}  // namespace pounding
