#include "ensemble/octet_recorder.h"

#include "common/row_products.h"
#include "output/probe_rows.h"

namespace pounding {
namespace {

std::size_t records_of(const OctetRecorder::Times& times) {
  return static_cast<std::size_t>(times.steps / times.stride) + 1;
}

}  // namespace

double OctetRecorder::memory(std::size_t channels, const Times& times) {
  return static_cast<double>(channels * octet_size * records_of(times) * sizeof(double));
}

OctetRecorder::OctetRecorder(std::span<const ResolvedProbe> probes,
                             std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
                             const Times& times)
    : channels_(3 * probes.size()),
      stride_(times.stride),
      interval_(times.time_step * times.stride),
      first_(first_record_from(times.start, times.time_step, interval_)),
      capacity_(records_of(times)) {
  for (std::size_t s = 0; s < systems.size(); ++s) {
    std::vector<TracePoint> places;
    std::vector<std::size_t> counts;
    Rows rows{s, systems[s].lumped_mass.size(), {}, {}};
    for (std::size_t p = 0; p < probes.size(); ++p) {
      if (probes[p].structure != static_cast<int>(s)) continue;
      for (const GlobalIndex node : probes[p].nodes) {
        for (int d = 0; d < 3; ++d) places.push_back({node, d});
      }
      counts.push_back(probes[p].nodes.size());
      for (std::size_t d = 0; d < 3; ++d) rows.channels.push_back(3 * p + d);
    }
    if (counts.empty()) continue;
    rows.values = probe_rows(Trace(systems[s], meshes[s], places, false), counts);
    rows_.push_back(std::move(rows));
  }
  values_.assign(channels_, Octet{});
  products_.assign(channels_, Octet{});
  block_.assign(block_records * channels_, Octet{});
  history_.resize(channels_ * octet_size * capacity_);
}

void OctetRecorder::restart(std::span<const OctetStep> octets) {
  multiply(octets, &OctetState::velocity);
  last_velocity_ = values_;
  displacement_.assign(channels_, Octet{});
  ground_.fill(Octet{});
  blocked_ = records_ = 0;
}

void OctetRecorder::add_step(const std::array<Octet, 3>& ground_velocity_step) {
  for (std::size_t d = 0; d < 3; ++d) ground_[d] += ground_velocity_step[d];
}

void OctetRecorder::multiply(std::span<const OctetStep> octets,
                             std::vector<Octet> OctetState::*quantity) {
  for (const Rows& rows : rows_) {
    const Octet* const x = (octets[rows.structure].state().*quantity).data();
    multiply_rows(rows.values.data(), rows.channels.size(), rows.width, x, products_.data());
    for (std::size_t r = 0; r < rows.channels.size(); ++r) values_[rows.channels[r]] = products_[r];
  }
}

void OctetRecorder::take_displacements(std::span<const OctetStep> octets) {
  if (records_ < first_) return;
  multiply(octets, &OctetState::displacement);
  for (std::size_t c = 0; c < channels_; ++c) {
    displacement_[c] = larger(displacement_[c], magnitude(values_[c]));
  }
}

void OctetRecorder::record(std::span<const OctetStep> octets) {
  multiply(octets, &OctetState::velocity);
  Octet* const out = &block_[blocked_ * channels_];
  for (std::size_t c = 0; c < channels_; ++c) {
    out[c] = (values_[c] - last_velocity_[c] + ground_[c % 3]) / interval_;
    last_velocity_[c] = values_[c];
  }
  ground_.fill(Octet{});
  ++records_;
  if (++blocked_ == block_records) flush();
}

void OctetRecorder::flush() {
  const std::size_t first = records_ - blocked_;
  for (std::size_t c = 0; c < channels_; ++c) {
    for (std::size_t lane = 0; lane < octet_size; ++lane) {
      double* const to = &history_[(c * octet_size + lane) * capacity_ + first];
      for (std::size_t r = 0; r < blocked_; ++r) to[r] = block_[r * channels_ + c][lane];
    }
  }
  blocked_ = 0;
}

std::span<const double> OctetRecorder::acceleration(std::size_t channel, std::size_t lane) {
  if (blocked_ > 0) flush();
  return {&history_[(channel * octet_size + lane) * capacity_], records_};
}

}  // namespace pounding
