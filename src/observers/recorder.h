#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dynamics/state.h"
#include "io/hdf5_file.h"
#include "io/hdf5_reader.h"
#include "mesh/probe_set.h"
#include "observers/base_motion.h"
#include "observers/observed_run.h"
#include "observers/storey_drifts.h"
#include "system/trace.h"

namespace pounding {

/// Largest recorded values of one probe and direction, from `peaks_start` on.
struct ChannelPeaks {
  double acceleration = 0;  ///< absolute [m/s2]
  double displacement = 0;  ///< relative to the ground [m]
};

/// Writes `history.h5`. A record is made every `stride` steps: displacement at t_n, velocity at
/// t_n + dt/2, and as absolute acceleration the change of velocity since the last record over the
/// interval (so that no impulse is lost between samples), ground included. Bases: displacement at
/// t_n. Rotations at the ends of spans at t_n. Beside these come the columns of other observers, as
/// these bring them.
///
/// Values wait in a buffer on the rank that owns them and travel to rank 0 a few thousand records
/// at a time, or on demand; a record itself neither allocates nor communicates. The
/// file can be read by others at any moment, also after the program was killed: `records`, a single
/// number, says how many rows of every dataset are whole, and is written after them. The attribute
/// `complete` is 1 when the run has reached its end, 0 before.
class Recorder final : public Observer {
 public:
  /// Takes the columns of the observers before it. Rank 0 creates the file, unless the run is a
  /// continued one. Throws UserError. Collective.
  Recorder(const ObservedRun& run, Observers& before);
  ~Recorder() override;

  /// Takes the velocities that a new run starts with, or the records known to `continued` over from
  /// the history continued, which may be the file that is then replaced. Throws UserError on every
  /// rank alike. Collective.
  void start(const CdLagrange& stepper, const SavedState* continued) override;
  std::int64_t next_due(std::int64_t step) const override { return next_multiple(step, stride_); }
  StepNeeds begin(const CdLagrange& stepper) override;
  /// Makes the record. Collective only when the buffer is full.
  void observe(const CdLagrange& stepper) override;
  bool follows() const override { return true; }
  void follow(const CdLagrange& stepper) override;
  /// Brings all records made to the file and to the operating system. Throws UserError on every
  /// rank alike (no space). Collective.
  void flush() override;
  /// Flushes and closes the file. Collective.
  void finish(bool complete) override;
  const Recorder* history() const override { return this; }
  /// Writes all records to the file and keeps the values that the next one needs. Collective.
  void keep_state(const StateKeeper& state) override;

  /// After finish, rank 0: names "probe.x", samples of absolute acceleration of a channel from a
  /// record on, peaks.
  const std::vector<std::string>& channels() const { return channels_; }
  std::vector<double> acceleration(std::size_t channel, std::size_t first_record = 0) const;
  const std::vector<ChannelPeaks>& peaks() const { return peaks_; }
  /// Drifts of the records from `peaks_start` on, rank 0.
  const StoreyDrifts& drifts() const { return drifts_; }
  /// Largest displacement of all channels and all records [m].
  double largest_displacement() const { return largest_displacement_; }
  /// The first record that counts: the middle of its interval is not before `start` [s].
  std::size_t first_record_from(double start) const;
  double interval() const { return run_.model.time_step * stride_; }
  const std::vector<ResolvedProbe>& probes() const { return run_.model.probes; }

 private:
  /// The nodes of a structure that probes and rotations read, as far as this rank knows them. In
  /// generalised coordinates each probe counts as one node, the mean of its own.
  struct StructureNodes {
    std::size_t structure;
    Trace trace;                    ///< three components of each node, node after node
    std::vector<double> mean_rows;  ///< of generalised coordinates, shape (nodes x 3, coordinates)
    /// How supports carry these, shape (nodes x 3, columns); empty without.
    std::vector<double> mean_carried;
    std::size_t first_node;      ///< into the nodes of a record of this rank
    std::vector<double> values;  ///< per place of the trace
  };

  /// A dataset of the file; `columns` 0: a plain vector.
  struct Quantity {
    std::string name;
    std::size_t columns;
    std::string unit;
  };

  StructureNodes find_nodes(std::size_t structure, std::vector<GlobalIndex>& found) const;
  /// Writes a quantity of the state into the record at hand, `offset` values into each node.
  void put(const CdLagrange& stepper, std::vector<double> StructureState::*quantity,
           std::span<const double> supports, std::size_t offset);
  void take_over(const SavedState& saved);
  void name_channels();
  RecordColumns base_columns() const;
  std::vector<Quantity> quantities() const;
  void create_file(const std::string& path);
  void check_history(const Hdf5Reader& history) const;
  void copy_history(const Hdf5Reader& history);
  void note_peaks(std::size_t first_record, std::span<const double> displacement,
                  std::span<const double> acceleration, std::span<const double> bases);
  /// Brings so many records to rank 0, rank after rank; `offsets` of the ranks there.
  std::vector<double> gather_rows(std::size_t rows, std::vector<int>& offsets) const;
  void write_rows(std::size_t rows, const std::vector<double>& gathered,
                  const std::vector<int>& offsets);
  /// Values of the columns in gathered records, per table, shape (records, columns).
  std::vector<std::vector<double>> column_values(std::size_t rows,
                                                 const std::vector<double>& gathered,
                                                 const std::vector<int>& offsets) const;
  /// Where the values of the nodes of each probe are in a gathered record, in the probe's own
  /// order, so that means do not depend on the ranks.
  using NodeValues = std::vector<std::vector<const double*>>;
  void find_values(std::size_t row, const std::vector<double>& gathered,
                   const std::vector<int>& offsets, NodeValues& values) const;
  /// Sends appended rows to the disk before their number says that they are there. Rank 0.
  void count_rows();

  ObservedRun run_;
  int stride_;
  std::string continued_;               ///< history of the run that this one continues; or empty
  std::vector<RecordColumns> columns_;  ///< beside the motion of probes
  std::vector<StructureNodes> structures_;
  BaseMotion bases_;
  std::vector<double> base_values_;
  std::vector<Quantity> tables_;  ///< of the columns
  std::size_t nodes_ = 0;         ///< of this rank
  std::size_t width_ = 0;         ///< values of this rank per record
  std::vector<double> buffer_;
  std::size_t buffered_ = 0;
  std::vector<double> ground_;  ///< velocity change per record and direction, rank 0
  std::array<double, 3> ground_sum_{};

  // Rank 0
  std::unique_ptr<Hdf5File> file_;
  std::vector<std::string> channels_;
  std::vector<std::string> rotations_;  ///< "span.probe.x"
  std::vector<int> widths_;             ///< per rank
  /// Per rank, table and column of each of its values beside those of nodes.
  std::vector<std::vector<int>> rank_places_;
  std::vector<std::array<std::size_t, 2>> order_;  ///< probe and position of the gathered nodes
  std::vector<std::size_t> recorded_nodes_;        ///< per probe
  std::vector<double> last_velocity_;
  std::vector<double> accelerations_;  ///< all records, shape (records, channels)
  std::vector<ChannelPeaks> peaks_;
  StoreyDrifts drifts_;
  double largest_displacement_ = 0;
  std::int64_t records_ = 0;
};

/// The first record that counts of those that are made every `interval` [s], half a time step [s]
/// after which their intervals end: the middle of its interval is not before `start` [s].
std::size_t first_record_from(double start, double time_step, double interval);

}  // namespace pounding
