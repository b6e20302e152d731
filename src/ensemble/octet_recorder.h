#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/memory.h"
#include "dynamics/octet_step.h"
#include "mesh/mesh.h"
#include "mesh/probe_set.h"

namespace pounding {

/// Records the probes of eight runs, as Recorder does those of one: largest displacement, and the
/// history of the absolute acceleration, which is the change of velocity over the interval, ground
/// included. A channel is a direction of a probe. Everything is kept in memory: channels x records
/// x 8 doubles, which the next group of runs uses again.
class OctetRecorder {
 public:
  struct Times {
    double time_step = 0;    ///< [s]
    int stride = 1;          ///< steps between two records
    std::int64_t steps = 0;  ///< last step of a run
    double start = 0;        ///< records before do not count as peaks [s]
  };

  /// `systems`, `meshes`: per structure, of any of the runs, whose coordinates are alike.
  OctetRecorder(std::span<const ResolvedProbe> probes, std::span<const LinearSystem> systems,
                std::span<const Mesh> meshes, const Times& times);

  std::size_t channels() const { return channels_; }
  double interval() const { return interval_; }
  /// The first record that counts.
  std::size_t first() const { return first_; }
  /// Memory that records of so many channels take [bytes].
  static double memory(std::size_t channels, const Times& times);

  /// Begins runs from their states at t = 0.
  void restart(std::span<const OctetStep> octets);
  bool due(std::int64_t step) const { return step % stride_ == 0; }
  /// The velocity that the ground gained in a step [m/s].
  void add_step(const std::array<Octet, 3>& ground_velocity_step);
  /// Before the step to be recorded.
  void take_displacements(std::span<const OctetStep> octets);
  /// After it.
  void record(std::span<const OctetStep> octets);
  /// After the last record: samples of a channel of a run [m/s2].
  std::span<const double> acceleration(std::size_t channel, std::size_t lane);
  double largest_displacement(std::size_t channel, std::size_t lane) const {
    return displacement_[channel][lane];
  }

 private:
  /// Probes of one structure.
  struct Rows {
    std::size_t structure = 0;
    std::size_t width = 0;              ///< coordinates
    std::vector<double> values;         ///< shape (channels, width)
    std::vector<std::size_t> channels;  ///< numbers among all
  };
  /// values_ := rows times the coordinates.
  void multiply(std::span<const OctetStep> octets, std::vector<Octet> OctetState::*quantity);
  /// Brings the records of the block to the histories.
  void flush();

  static constexpr std::size_t block_records = 256;

  std::size_t channels_ = 0;
  int stride_;
  double interval_;
  std::size_t first_;
  std::size_t capacity_;  ///< records of a run
  std::vector<Rows> rows_;
  std::vector<Octet> values_;         ///< per channel
  std::vector<Octet> products_;       ///< of the channels of one structure
  std::vector<Octet> last_velocity_;  ///< per channel
  std::vector<Octet> displacement_;   ///< per channel, largest
  std::array<Octet, 3> ground_{};
  std::vector<Octet> block_;  ///< shape (block records, channels)
  LargeArray history_;        ///< shape (channels, lanes, records)
  std::size_t blocked_ = 0;
  std::size_t records_ = 0;  ///< made, those of the block included
};

}  // namespace pounding
