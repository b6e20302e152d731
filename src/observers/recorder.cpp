#include "observers/recorder.h"

#include <algorithm>
#include <cmath>

#include "common/parallel.h"
#include "common/row_products.h"
#include "io/schema.h"
#include "observers/storeys.h"
#include "system/support_shapes.h"

namespace pounding {
namespace {

constexpr const char* history_file = "history.h5";

constexpr std::size_t buffer_records = 4096;

/// Displacement and velocity, three components each.
constexpr std::size_t values_per_node = 6;

/// Component d of the mean of three values of nodes from `offset` on, as they count. One node is
/// the mean already.
double mean(const ResolvedProbe& probe, std::span<const double* const> nodes, std::size_t offset,
            std::size_t d) {
  if (nodes.size() == 1) return 0 + nodes[0][offset + d];
  double sum = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const double* const x = nodes[k] + offset;
    sum += dot(probe.weight(k, d), {x[0], x[1], x[2]});
  }
  return sum / static_cast<double>(nodes.size());
}

}  // namespace

Recorder::Recorder(const ObservedRun& run, Observers& before)
    : run_(run),
      stride_(record_stride(run.scene, run.model)),
      continued_(run.continued_path(history_file)),
      drifts_(find_storeys(run.comm, run.scene, run.model)) {
  const std::span<const LinearSystem> systems = run.model.systems;
  for (const auto& other : before.list()) {
    if (auto columns = other->columns()) columns_.push_back(std::move(*columns));
  }
  for (const ResolvedProbe& probe : run_.model.recorded) {
    const bool mean = systems[probe.structure].generalised != nullptr;
    recorded_nodes_.push_back(mean ? 1 : probe.nodes.size());
  }
  std::vector<GlobalIndex> mine;  // probe, and place of the node in it
  for (std::size_t s = 0; s < systems.size(); ++s) {
    structures_.push_back(find_nodes(s, mine));
    nodes_ += structures_.back().values.size() / 3;
  }
  bases_ = BaseMotion(run.model.storey_bases, systems, run.model.meshes);
  base_values_.resize(bases_.values());
  if (!run_.model.storey_bases.empty()) columns_.push_back(base_columns());
  std::vector<int> places;  // table and column of each value beside those of nodes
  for (const RecordColumns& columns : columns_) {
    for (const int column : columns.mine) {
      for (std::size_t q = 0; q < columns.quantities.size(); ++q) {
        places.insert(places.end(), {static_cast<int>(tables_.size() + q), column});
      }
    }
    for (const RecordColumns::Quantity& quantity : columns.quantities) {
      tables_.push_back({quantity.name, columns.names.size(), quantity.unit});
    }
  }
  width_ = values_per_node * nodes_ + places.size() / 2;
  buffer_.resize(buffer_records * width_);
  ground_.resize(3 * buffer_records);
  for_each_rank(run_.comm, std::pair(mine, places), [&](int /*rank*/, const auto& own) {
    const auto& [nodes, others] = own;
    widths_.push_back(static_cast<int>(values_per_node * (nodes.size() / 2) + others.size() / 2));
    rank_places_.push_back(others);
    for (std::size_t i = 0; i < nodes.size(); i += 2) {
      order_.push_back(
          {static_cast<std::size_t>(nodes[i]), static_cast<std::size_t>(nodes[i + 1])});
    }
  });
  if (rank_of(run_.comm) == 0) name_channels();
  if (continued_.empty()) on_rank0(run_.comm, [&] { create_file(run_.path(history_file)); });
}

Recorder::~Recorder() = default;

RecordColumns Recorder::base_columns() const {
  RecordColumns columns{"bases", {}, {{"base_displacement", "m"}}, {}, base_values_};
  for (const ResolvedProbe& base : run_.model.storey_bases) {
    for (const char* direction : direction_names) {
      columns.mine.push_back(static_cast<int>(columns.names.size()));
      columns.names.push_back(base.name + "." + direction);  // "tower.x"
    }
  }
  return columns;
}

Recorder::StructureNodes Recorder::find_nodes(std::size_t structure,
                                              std::vector<GlobalIndex>& found) const {
  const LinearSystem& system = run_.model.systems[structure];
  const Mesh& mesh = run_.model.meshes[structure];
  std::vector<TracePoint> places;
  std::vector<const ResolvedProbe*> here;
  for (std::size_t p = 0; p < run_.model.recorded.size(); ++p) {
    const ResolvedProbe& probe = run_.model.recorded[p];
    const std::size_t before = places.size();
    for (std::size_t k = 0; k < probe.nodes.size(); ++k) {
      if (probe.structure != static_cast<int>(structure) || mesh.owned_node(probe.nodes[k]) < 0) {
        continue;
      }
      if (!system.generalised || places.size() == before) {
        found.insert(found.end(), {static_cast<GlobalIndex>(p), static_cast<GlobalIndex>(k)});
      }
      for (int d = 0; d < 3; ++d) places.push_back({probe.nodes[k], probe.component + d});
    }
    if (places.size() > before) here.push_back(&probe);
  }
  StructureNodes nodes{structure, Trace(system, mesh, places, false), {}, {}, nodes_, {}};
  nodes.values.resize(system.generalised ? 3 * here.size() : places.size());
  if (system.generalised) {
    nodes.mean_rows = probe_means(here, [&](std::size_t k) { return nodes.trace.row(k); });
    nodes.mean_carried = probe_means(here, [&](std::size_t k) { return nodes.trace.carried(k); });
  }
  return nodes;
}

void Recorder::name_channels() {
  for (std::size_t i = 0; i < 3 * run_.model.recorded.size(); ++i) {
    const std::string& of = run_.model.recorded[i / 3].name;
    (i < 3 * probes().size() ? channels_ : rotations_).push_back(of + "." + direction_names[i % 3]);
  }
  last_velocity_.assign(channels_.size(), 0.0);
  peaks_.assign(channels_.size(), {});
}

std::vector<Recorder::Quantity> Recorder::quantities() const {
  std::vector<Quantity> list{{"time", 0, "s"}, {"ground_acceleration", 3, "m/s2"}};
  if (!channels_.empty()) {
    list.push_back({"displacement", channels_.size(), "m"});
    list.push_back({"velocity", channels_.size(), "m/s"});
    list.push_back({"acceleration", channels_.size(), "m/s2"});
  }
  if (!rotations_.empty()) list.push_back({"rotation", rotations_.size(), "rad"});
  list.insert(list.end(), tables_.begin(), tables_.end());
  return list;
}

void Recorder::create_file(const std::string& path) {
  file_ = std::make_unique<Hdf5File>(path);
  schema::write(*file_, schema::history);
  file_->write_attribute("/", "title", run_.scene.title);
  file_->write_strings("channels", channels_);
  if (!rotations_.empty()) file_->write_strings("rotations", rotations_);
  for (const RecordColumns& columns : columns_) {
    file_->write_strings(columns.list, columns.names);
  }
  for (const Quantity& quantity : quantities()) {
    file_->create_dataset(quantity.name, quantity.columns, quantity.unit);
  }
  file_->create_number("records");
  file_->write_attribute("/", "complete", 0);
  const double half = run_.model.time_step / 2;
  if (!channels_.empty()) {
    file_->write_attribute("displacement", "frame", "relative to the ground");
    file_->write_attribute("velocity", "frame", "relative to the ground");
    file_->write_attribute("velocity", "time_offset", half);
    file_->write_attribute("acceleration", "frame", "absolute, mean over the output interval");
    file_->write_attribute("acceleration", "time_offset", half - interval() / 2);
  }
  file_->write_attribute("ground_acceleration", "time_offset", half - interval() / 2);
  file_->stay_readable();
}

void Recorder::follow(const CdLagrange& stepper) {
  for (std::size_t d = 0; d < 3; ++d) {
    ground_sum_[d] += stepper.ground_acceleration()[d] * stepper.force_duration();
  }
}

void Recorder::put(const CdLagrange& stepper, std::vector<double> StructureState::*quantity,
                   std::span<const double> supports, std::size_t offset) {
  double* const record = buffer_.data() + buffered_ * width_;
  for (StructureNodes& nodes : structures_) {
    stepper.bring(nodes.structure, nodes.trace.dofs());
    const std::vector<double>& owned = stepper.state().structures[nodes.structure].*quantity;
    if (nodes.mean_rows.empty()) {
      nodes.trace.apply(owned.data(), nodes.values.data(), 1, supports);
    } else {
      multiply_rows(nodes.mean_rows.data(), nodes.values.size(), owned.size(), owned.data(),
                    nodes.values.data(), 1);
      add_columns(nodes.mean_carried, supports, nodes.values.data(), 1);
    }
    for (std::size_t i = 0; i < nodes.values.size(); ++i) {
      record[values_per_node * (nodes.first_node + i / 3) + offset + i % 3] = nodes.values[i];
    }
  }
}

StepNeeds Recorder::begin(const CdLagrange& stepper) {
  const State& state = stepper.state();
  put(stepper, &StructureState::displacement, state.supports.displacement, 0);
  bases_.put(stepper, base_values_.data());
  return {};
}

void Recorder::observe(const CdLagrange& stepper) {
  put(stepper, &StructureState::velocity, stepper.state().supports.velocity, 3);
  double* out = buffer_.data() + buffered_ * width_ + values_per_node * nodes_;
  for (const RecordColumns& columns : columns_) {
    out = std::copy(columns.values.begin(), columns.values.end(), out);
  }
  std::copy(ground_sum_.begin(), ground_sum_.end(), &ground_[3 * buffered_]);
  ground_sum_ = {0, 0, 0};
  if (++buffered_ == buffer_records) flush();
}

std::vector<double> Recorder::gather_rows(std::size_t rows, std::vector<int>& offsets) const {
  std::vector<int> counts;
  std::vector<double> gathered;
  if (rank_of(run_.comm) == 0) {
    int total = 0;
    for (const int width : widths_) {
      counts.push_back(width * static_cast<int>(rows));
      offsets.push_back(total);
      total += counts.back();
    }
    gathered.resize(total);
  }
  MPI_Gatherv(buffer_.data(), static_cast<int>(rows * width_), MPI_DOUBLE, gathered.data(),
              counts.data(), offsets.data(), MPI_DOUBLE, 0, run_.comm);
  return gathered;
}

void Recorder::start(const CdLagrange& stepper, const SavedState* continued) {
  if (continued != nullptr) return take_over(*continued);
  put(stepper, &StructureState::velocity, stepper.state().supports.velocity, 3);
  std::vector<int> offsets;
  const std::vector<double> gathered = gather_rows(1, offsets);
  if (rank_of(run_.comm) != 0) return;
  NodeValues values;
  find_values(0, gathered, offsets, values);
  for (std::size_t channel = 0; channel < channels_.size(); ++channel) {
    last_velocity_[channel] = mean(probes()[channel / 3], values[channel / 3], 3, channel % 3);
  }
}

void Recorder::flush() {
  const std::size_t rows = buffered_;
  buffered_ = 0;
  std::vector<int> offsets;
  const std::vector<double> gathered = gather_rows(rows, offsets);
  on_rank0(run_.comm, [&] {
    if (rows > 0) write_rows(rows, gathered, offsets);
  });
}

void Recorder::find_values(std::size_t row, const std::vector<double>& gathered,
                           const std::vector<int>& offsets, NodeValues& values) const {
  values.resize(recorded_nodes_.size());
  for (std::size_t p = 0; p < values.size(); ++p) values[p].resize(recorded_nodes_[p]);
  std::size_t node = 0;
  for (std::size_t rank = 0; rank < widths_.size(); ++rank) {
    const std::size_t width = widths_[rank];
    const double* from = gathered.data() + offsets[rank] + row * width;
    const double* const end = from + (width - rank_places_[rank].size() / 2);
    for (; from != end; ++node, from += values_per_node) {
      values[order_[node][0]][order_[node][1]] = from;
    }
  }
}

std::vector<std::vector<double>> Recorder::column_values(std::size_t rows,
                                                         const std::vector<double>& gathered,
                                                         const std::vector<int>& offsets) const {
  std::vector<std::vector<double>> tables;
  // Ranks add their parts to -0, which leaves a single part as it is to the bit.
  for (const Quantity& table : tables_) tables.emplace_back(rows * table.columns, -0.0);
  for (std::size_t rank = 0; rank < widths_.size(); ++rank) {
    const std::vector<int>& places = rank_places_[rank];
    for (std::size_t row = 0; row < rows; ++row) {
      const std::size_t width = widths_[rank];
      const double* from = gathered.data() + offsets[rank] + (row + 1) * width - places.size() / 2;
      for (std::size_t i = 0; i < places.size(); i += 2) {
        const std::size_t columns = tables_[places[i]].columns;
        tables[places[i]][row * columns + places[i + 1]] += *from++;
      }
    }
  }
  return tables;
}

void Recorder::write_rows(std::size_t rows, const std::vector<double>& gathered,
                          const std::vector<int>& offsets) {
  const std::size_t channels = channels_.size();
  std::vector<double> time, displacement, velocity, rotation;
  const std::vector<std::vector<double>> tables = column_values(rows, gathered, offsets);
  NodeValues values;
  const auto first = static_cast<std::ptrdiff_t>(accelerations_.size());
  for (std::size_t row = 0; row < rows; ++row) {
    find_values(row, gathered, offsets, values);
    time.push_back(static_cast<double>(records_++ * stride_) * run_.model.time_step);
    for (std::size_t channel = 0; channel < channels; ++channel) {
      const std::size_t d = channel % 3;
      const double u = mean(probes()[channel / 3], values[channel / 3], 0, d);
      const double v = mean(probes()[channel / 3], values[channel / 3], 3, d);
      const double a = (v - last_velocity_[channel] + ground_[3 * row + d]) / interval();
      last_velocity_[channel] = v;
      displacement.push_back(u);
      velocity.push_back(v);
      accelerations_.push_back(a);
    }
    for (std::size_t i = channels; i < channels + rotations_.size(); ++i) {
      rotation.push_back(mean(run_.model.recorded[i / 3], values[i / 3], 0, i % 3));
    }
  }
  const std::span<const double> acceleration(accelerations_.begin() + first, accelerations_.end());
  note_peaks(static_cast<std::size_t>(records_) - rows, displacement, acceleration,
             run_.model.storey_bases.empty() ? std::span<const double>() : tables.back());
  file_->append("time", time);
  if (channels > 0) {
    file_->append("displacement", displacement);
    file_->append("velocity", velocity);
    file_->append("acceleration", acceleration);
  }
  if (!rotation.empty()) file_->append("rotation", rotation);
  std::vector<double> ground(ground_.begin(),
                             ground_.begin() + static_cast<std::ptrdiff_t>(3 * rows));
  for (double& value : ground) value /= interval();
  file_->append("ground_acceleration", ground);
  for (std::size_t t = 0; t < tables.size(); ++t) file_->append(tables_[t].name, tables[t]);
  count_rows();
}

void Recorder::count_rows() {
  file_->flush();
  file_->write_number("records", static_cast<double>(records_));
  file_->flush();
}

std::size_t Recorder::first_record_from(double start) const {
  return pounding::first_record_from(start, run_.model.time_step, interval());
}

void Recorder::note_peaks(std::size_t first_record, std::span<const double> displacement,
                          std::span<const double> acceleration, std::span<const double> bases) {
  const std::size_t first = first_record_from(run_.scene.spectra.start);
  for (std::size_t i = 0; i < displacement.size(); ++i) {
    largest_displacement_ = std::max(largest_displacement_, std::abs(displacement[i]));
    if (first_record + i / channels_.size() < first) continue;
    ChannelPeaks& peaks = peaks_[i % channels_.size()];
    peaks.acceleration = std::max(peaks.acceleration, std::abs(acceleration[i]));
    peaks.displacement = std::max(peaks.displacement, std::abs(displacement[i]));
  }
  const std::size_t rows = channels_.empty() ? 0 : displacement.size() / channels_.size();
  for (std::size_t row = first > first_record ? first - first_record : 0; row < rows; ++row) {
    drifts_.note(static_cast<double>(first_record + row) * interval(),
                 displacement.subspan(row * channels_.size(), channels_.size()),
                 bases.subspan(row * bases_.values(), bases_.values()));
  }
}

void Recorder::finish(bool complete) {
  flush();
  on_rank0(run_.comm, [&] {
    file_->close();
    if (complete) file_->mark("complete", 1);
  });
}

std::vector<double> Recorder::acceleration(std::size_t channel, std::size_t first_record) const {
  std::vector<double> samples;
  for (std::size_t i = first_record * channels_.size() + channel; i < accelerations_.size();
       i += channels_.size()) {
    samples.push_back(accelerations_[i]);
  }
  return samples;
}

OutputKind history_output() {
  return output<Recorder>(
      {{history_file, "motion of the probes, and all that is recorded with it, over time", "",
        true}});
}

std::size_t first_record_from(double start, double time_step, double interval) {
  const double middle = (time_step - interval) / 2;  // of the first record's interval
  return start > 0 ? static_cast<std::size_t>(std::ceil((start - middle) / interval - 1e-6)) : 0;
}

}  // namespace pounding
