#include "ensemble/member_batch.h"

#include <algorithm>
#include <cmath>

#include "common/row_products.h"
#include "motion/response_spectrum.h"
#include "observers/floor_spectra.h"
#include "observers/kinds.h"
#include "observers/recorder.h"

namespace pounding {
namespace {

/// Steps between two questions whether to stop.
constexpr std::int64_t stop_interval = 2000;

std::size_t records_of(const BatchRecorder::Times& times) {
  return static_cast<std::size_t>(times.steps / times.stride) + 1;
}

ModelScheme::Parts parts_in_batch(const MemberScene& member, const EnsembleModel& shared,
                                  const Model& model, BatchSlot slot, Profile& profile) {
  ModelScheme::Parts parts =
      scheme_parts(MPI_COMM_SELF, member.scene, model, shared.model->meshes, profile);
  parts.batch = slot;
  return parts;
}

std::vector<Model> models_of(std::span<const MemberScene* const> members,
                             const EnsembleModel& shared) {
  std::vector<Model> models;
  for (const MemberScene* member : members) models.push_back(member_model(*member, shared));
  return models;
}

const std::vector<double>& velocity_of_supports(const CdLagrange& stepper) {
  return stepper.state().supports.velocity;
}

}  // namespace

MemberBatch::MemberBatch(std::span<const MemberScene* const> members, const Scene& scene,
                         const EnsembleModel& shared, BatchRecorder& recorder)
    : scene_(scene),
      shared_(*shared.model),
      recorder_(recorder),
      models_(models_of(members, shared)),
      passes_(members, models_, shared_.meshes) {
  for (std::size_t s = 0; s < shared_.systems.size(); ++s) {
    std::vector<const LinearSystem*> systems;
    for (const Model& model : models_) systems.push_back(&model.systems[s]);
    batches_.push_back(!shared.steps_alone(s) ? std::make_unique<BatchStep>(
                                                    systems, shared_.systems[s], shared_.time_step,
                                                    shared.elements[s].get())
                                              : nullptr);
    slots_.push_back(batches_.back().get());
  }
  for (std::size_t member = 0; member < members.size(); ++member) {
    runs_.push_back(std::make_unique<MemberRun>(*members[member], shared, models_[member],
                                                BatchSlot{slots_, member}));
  }
  for (std::size_t s = 0; s < slots_.size(); ++s) {
    StatesOfRuns& states = states_.emplace_back(StatesOfRuns{slots_[s], {}});
    for (std::size_t member = 0; member < runs_.size(); ++member) {
      states.own[member] = &runs_[member]->stepper().state().structures[s];
    }
  }
  recorder_.restart(states_, motion_of_supports(velocity_of_supports));
}

const std::vector<BatchValue>& MemberBatch::motion_of_supports(const auto& part) {
  supports_.resize(shared_.support_columns().size());
  for (std::size_t member = 0; member < runs_.size(); ++member) {
    const std::vector<double>& motion = part(runs_[member]->stepper());
    for (std::size_t c = 0; c < supports_.size(); ++c) supports_[c][member] = motion[c];
  }
  return supports_;
}

bool MemberBatch::run(const std::function<bool()>& stopped) {
  for (std::int64_t n = 0; n <= shared_.steps; ++n) {
    if (n % stop_interval == 0 && stopped()) return false;
    step(n);
  }
  return true;
}

void MemberBatch::step(std::int64_t n) {
  const bool records = recorder_.due(n);
  if (records || passes_.due(n)) {
    const std::vector<BatchValue>& supports = motion_of_supports(
        [](const CdLagrange& of) -> auto& { return of.state().supports.displacement; });
    const double time = static_cast<double>(n) * shared_.time_step;
    if (passes_.due(n)) passes_.look(states_, supports, n, time);
    if (records) recorder_.take_displacements(states_, supports);
  }
  bool with_energies = false, with_forces = false;
  for (std::size_t member = 0; member < runs_.size(); ++member) {
    const StepNeeds needs = runs_[member]->open();
    with_energies = needs.energies || with_energies;
    with_forces = needs.forces || runs_[member]->stepper().corrects() || with_forces;
    for (std::size_t d = 0; d < 3; ++d) {
      acceleration_[d][member] = runs_[member]->stepper().ground_acceleration()[d];
    }
  }
  const double duration = runs_.front()->stepper().force_duration();
  const std::vector<BatchValue>& supports =
      motion_of_supports([](const CdLagrange& of) -> auto& { return of.support_acceleration(); });
  for (BatchStep* const batch : slots_) {
    if (batch == nullptr) continue;
    batch->step(duration, acceleration_, supports, runs_.front()->stepper().load_values(),
                with_energies, with_forces);
  }
  for (const auto& run : runs_) run->step_alone(with_forces);
  for (failed_ = 0; failed_ < runs_.size(); ++failed_) runs_[failed_]->close();
  recorder_.add_step(duration, acceleration_);
  if (records) recorder_.record(states_, motion_of_supports(velocity_of_supports));
}

MemberResult MemberBatch::result(std::size_t member) {
  MemberResult result;
  runs_[member]->fill(result);
  passes_.fill(member, result);
  recorder_.fill_spans(member, result);
  recorder_.fill_bases(member, result);
  const double frequency = stated_frequency(scene_, recorder_.interval());
  for (std::size_t c = 0; c < recorder_.channels(); ++c) {
    const std::span<const double> history = recorder_.acceleration(c, member);
    const auto counted = history.subspan(std::min(recorder_.first(), history.size()));
    for (const auto& spectrum :
         response_spectra(counted, recorder_.interval(), scene_.spectra.frequencies,
                          scene_.spectra.damping_ratios, AfterRecord::ignored)) {
      for (const SpectrumPoint& point : spectrum) {
        result.spectra.push_back(point.pseudo_acceleration);
      }
    }
    result.displacement.push_back(recorder_.largest_displacement(c, member));
    result.acceleration.push_back(
        stated_peak(history, recorder_.interval(), frequency, recorder_.first()));
  }
  return result;
}

double BatchRecorder::memory(std::size_t channels, const Times& times) {
  return static_cast<double>(channels * batch_size * records_of(times) * sizeof(double));
}

BatchRecorder::BatchRecorder(const Model& model, const Times& times)
    : channels_(3 * model.probes.size()),
      stride_(times.stride),
      interval_(times.time_step * times.stride),
      first_(first_record_from(times.start, times.time_step, interval_)),
      capacity_(records_of(times)) {
  std::vector<ResolvedProbe> recorded = model.recorded;
  recorded.insert(recorded.end(), model.storey_bases.begin(), model.storey_bases.end());
  for (std::size_t s = 0; s < model.systems.size(); ++s) {
    std::vector<TracePoint> places;
    std::vector<const ResolvedProbe*> here;
    Rows rows{s, {0, model.systems[s]}, {}, {}};
    for (std::size_t p = 0; p < recorded.size(); ++p) {
      if (recorded[p].structure != static_cast<int>(s)) continue;
      for (const GlobalIndex node : recorded[p].nodes) {
        for (int d = 0; d < 3; ++d) places.push_back({node, recorded[p].component + d});
      }
      here.push_back(&recorded[p]);
      for (std::size_t d = 0; d < 3; ++d) rows.channels.push_back(3 * p + d);
    }
    if (here.empty()) continue;
    const Trace trace(model.systems[s], model.meshes[s], places, false);
    rows.values = mean_rows(here, model.systems[s], trace);
    rows.carried = probe_means(here, [&](std::size_t k) { return trace.carried(k); });
    rows_.push_back(std::move(rows));
  }
  for (std::size_t p = model.probes.size(); p < model.recorded.size(); ++p) {
    ends_.push_back({3 * static_cast<std::size_t>(recorded[p].of), 3 * p});
  }
  values_.assign(3 * recorded.size(), BatchValue{});
  bases_at_start_.resize(3 * model.storey_bases.size());
  bases_moved_ = bases_at_start_;
  products_.assign(values_.size(), BatchValue{});
  block_.assign(block_records * channels_, BatchValue{});
  history_.resize(channels_ * batch_size * capacity_);
}

void BatchRecorder::restart(std::span<const StatesOfRuns> states,
                            const std::vector<BatchValue>& supports) {
  multiply(states, velocities, supports);
  last_velocity_ = values_;
  displacement_.assign(channels_, BatchValue{});
  apart_.assign(3 * ends_.size(), BatchValue{});
  largest_.assign(4 * ends_.size(), {});
  lowest_.assign(bases_at_start_.size() / 3, BatchValue{});
  ground_.fill(BatchValue{});
  blocked_ = records_ = 0;
}

void BatchRecorder::add_step(double duration, const std::array<BatchValue, 3>& acceleration) {
  for (std::size_t d = 0; d < 3; ++d) ground_[d] += acceleration[d] * all_eight(duration);
}

void BatchRecorder::multiply(std::span<const StatesOfRuns> states, const StatePart& part,
                             const std::vector<BatchValue>& supports) {
  for (const Rows& rows : rows_) {
    rows.values.multiply(states[rows.structure], part, products_.data());
    for (std::size_t r = 0; r < rows.channels.size(); ++r) values_[rows.channels[r]] = products_[r];
    if (rows.carried.empty()) continue;
    multiply_rows(rows.carried.data(), rows.channels.size(), supports.size(), supports.data(),
                  products_.data());
    for (std::size_t r = 0; r < rows.channels.size(); ++r) {
      values_[rows.channels[r]] += products_[r];
    }
  }
}

void BatchRecorder::take_displacements(std::span<const StatesOfRuns> states,
                                       const std::vector<BatchValue>& supports) {
  const bool counts = records_ >= first_;
  if (!counts && records_ > 0 && lowest_.empty()) return;
  multiply(states, displacements, supports);
  note_bases();
  note_spans(static_cast<double>(records_) * interval_, counts);
  if (!counts) return;
  for (std::size_t c = 0; c < channels_; ++c) {
    displacement_[c] = larger(displacement_[c], magnitude(values_[c]));
  }
}

void BatchRecorder::note_spans(double time, bool counts) {
  BatchValue square{};
  for (std::size_t k = 0; k < largest_.size(); ++k) {  // x, y, z and the length of them, of each
    BatchValue found = square;
    if (const std::size_t d = k % 4, of = k / 4; d < 3) {  // even: displacements, odd: rotations
      found = values_[ends_[of | 1][of % 2] + d] - values_[ends_[of & ~1UL][of % 2] + d];
      if (records_ == 0) apart_[3 * of + d] = found;
      found = magnitude(found - apart_[3 * of + d]);
      square = d == 0 ? found * found : square + found * found;
    }
    const BatchMask more = largest_[k][0] < found;
    if (!counts || !any(more)) continue;
    largest_[k] = {larger(largest_[k][0], found), choose(more, all_eight(time), largest_[k][1])};
  }
}

void BatchRecorder::note_bases() {
  for (std::size_t i = 0; i < bases_moved_.size(); ++i) {
    const BatchValue& now = values_[values_.size() - bases_moved_.size() + i];
    if (records_ == 0) bases_at_start_[i] = now;
    bases_moved_[i] = now - bases_at_start_[i];
    if (i % 3 == 2) lowest_[i / 3] = larger(lowest_[i / 3], -bases_moved_[i]);
  }
}

void BatchRecorder::fill_bases(std::size_t member, MemberResult& result) const {
  for (std::size_t base = 0; base < lowest_.size(); ++base) {
    const auto moved = [&](std::size_t d) { return bases_moved_[3 * base + d][member]; };
    result.settled.insert(result.settled.end(),
                          {-moved(2), lowest_[base][member], std::hypot(moved(0), moved(1))});
  }
}

void BatchRecorder::fill_spans(std::size_t member, MemberResult& result) const {
  for (std::size_t k = 0; k < largest_.size(); ++k) {
    const double value = largest_[k][0][member];
    result.span_peak.push_back(k % 4 == 3 ? std::sqrt(value) : value);
    result.span_time.push_back(largest_[k][1][member]);
  }
}

void BatchRecorder::record(std::span<const StatesOfRuns> states,
                           const std::vector<BatchValue>& supports) {
  multiply(states, velocities, supports);
  BatchValue* const out = &block_[blocked_ * channels_];
  for (std::size_t c = 0; c < channels_; ++c) {
    out[c] = (values_[c] - last_velocity_[c] + ground_[c % 3]) / interval_;
    last_velocity_[c] = values_[c];
  }
  ground_.fill(BatchValue{});
  ++records_;
  if (++blocked_ == block_records) flush();
}

void BatchRecorder::flush() {
  const std::size_t first = records_ - blocked_;
  for (std::size_t c = 0; c < channels_; ++c) {
    for (std::size_t member = 0; member < batch_size; ++member) {
      double* const to = &history_[(c * batch_size + member) * capacity_ + first];
      for (std::size_t r = 0; r < blocked_; ++r) to[r] = block_[r * channels_ + c][member];
    }
  }
  blocked_ = 0;
}

std::span<const double> BatchRecorder::acceleration(std::size_t channel, std::size_t member) {
  if (blocked_ > 0) flush();
  return {&history_[(channel * batch_size + member) * capacity_], records_};
}

MemberRun::MemberRun(const MemberScene& member, const EnsembleModel& shared, const Model& model,
                     BatchSlot slot)
    : scheme_(parts_in_batch(member, shared, model, slot, profile_)),
      run_{MPI_COMM_SELF, member.scene, model, scheme_},
      observers_(make_observers(run_, profile_, true)),
      record_stride_(record_stride(member.scene, model)) {
  for (const auto& observer : observers_.list()) {
    const auto columns = observer->columns();
    if (columns && columns->list == "forces") forces_ = columns->values;
  }
  observers_.start(scheme_.stepper(), nullptr);
}

StepNeeds MemberRun::open() {
  StepNeeds needs = observers_.before(scheme_.stepper());
  needs.energies = scheme_.stepper().open(needs.gaps, needs.energies);
  return needs;
}

void MemberRun::close() {
  scheme_.stepper().close();
  observers_.after(scheme_.stepper());
  if (forces_.empty() || (scheme_.stepper().state().step - 1) % record_stride_ != 0) return;
  history_.insert(history_.end(), forces_.begin(), forces_.end());
}

void MemberRun::fill(MemberResult& result) {
  for (const auto& observer : observers_.list()) {
    observer->finish(true);
    observer->keep(result);
  }
  result.forces = history_;
  result.energy_residual = {scheme_.stepper().energy().relative_residual()};
  if (scheme_.contact() != nullptr) {
    result.contact_residual = {scheme_.contact()->largest_residual()};
  }
}

}  // namespace pounding
