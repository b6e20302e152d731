#include "dynamics/filler_step.h"

#include <algorithm>
#include <cmath>

#include "common/parallel.h"

namespace pounding {
namespace {

constexpr int most_filler_sweeps = 1000;
constexpr double filler_converged = 1e-15;  ///< change of a force over the largest

constexpr std::size_t remembered = 2;  // values of FillerLaw
constexpr std::size_t saved_values = 4;
constexpr std::size_t saved_totals = 4;

}  // namespace

FillerStep::FillerStep(MPI_Comm comm, const interactions::Interface& interface,
                       std::span<const Contact> contacts, std::span<const LinearSystem> systems,
                       std::span<const Mesh> meshes, double time_step)
    : rows_(comm, interface, systems, meshes),
      counts_(rows_.root() == rank_of(comm)),
      time_step_(time_step),
      totals_(contacts.size()),
      contact_force_(contacts.size(), 0.0) {
  for (const interactions::FillerRows::Row& row : rows_.rows()) {
    laws_.emplace_back(*contacts[row.contact].filler, row.part.thickness, row.part.area);
  }
  for (const std::vector<interactions::FillerRows::Coupling>& coupled : rows_.couplings()) {
    double sum = 0;
    for (const interactions::FillerRows::Coupling& other : coupled) {
      sum += std::abs(other.compliance);
    }
    reach_.push_back(sum);
  }
  const std::size_t count = laws_.size();
  memory_.assign(remembered * count, 0.0);
  for (auto* values : {&now_, &rate_, &rate_before_, &before_, &free_after_, &force_,
                       &force_before_, &held_, &impulse_}) {
    values->assign(count, 0.0);
  }
  for (std::size_t s = 0; s < systems.size(); ++s) {
    before_step_.emplace_back(rows_.trace(s).dofs().size());
    velocity_.emplace_back(rows_.trace(s).dofs().size(), 0.0);
  }
}

void FillerStep::begin(std::span<const StructureState> structures, std::span<StructureStep> steps,
                       const SupportStep& supports) {
  if (!rows_.member()) return;
  support_input_ = 0;
  for (std::size_t s = 0; s < structures.size(); ++s) {
    rows_.set_state(s, structures[s].displacement.data(), structures[s].velocity.data(),
                    {supports.displacement, supports.velocity_before});
    steps[s].remember(rows_.trace(s).dofs(), before_step_[s]);
  }
  rate_before_.swap(rate_);
  force_before_.swap(force_);
  rows_.gather(now_, rate_);
  loss_ = 0;
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    const std::span<double> memory(&memory_[remembered * r], remembered);
    before_[r] = now_[r] - time_step_ * rate_[r];
    const double held = laws_[r].energy(before_[r], now_[r], memory);
    if (made_) {
      const double taken = force_before_[r] * time_step_ * (rate_[r] + rate_before_[r]) / 2;
      const double loss = taken - (held - held_[r]);
      loss_ += loss;
      totals_[rows_.rows()[r].contact].loss += loss;
    }
    held_[r] = held;
    laws_[r].yield(now_[r], 0, memory);
  }
  for (std::size_t k = 0; made_ && k < records_.links().size(); ++k) {
    const std::size_t r = records_.links()[k];
    records_.add_work(k, force_before_[r] * time_step_ * (rate_[r] + rate_before_[r]) / 2);
  }
  made_ = true;
}

void FillerStep::press(bool first, std::span<const StructureState> structures,
                       std::span<StructureStep> steps, const SupportStep& supports) {
  if (!rows_.member()) return;
  std::fill(force_.begin(), force_.end(), 0.0);
  bool idle = true;
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    idle = idle && laws_[r].is_idle(now_[r], {&memory_[remembered * r], remembered});
  }
  if (idle) return;
  const double share = first ? 0.5 : 1;
  for (std::size_t s = 0; s < structures.size(); ++s) {
    rows_.set_state(s, structures[s].displacement.data(), structures[s].velocity.data(),
                    {supports.displacement, supports.velocity});
  }
  rows_.gather(impulse_, free_after_);  // of the displacements nothing is needed
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    free_after_[r] = now_[r] + time_step_ * free_after_[r];
  }
  if (!hold(share)) solve(share);
  for (std::size_t r = 0; r < laws_.size(); ++r) impulse_[r] = share * time_step_ * force_[r];
  rows_.set_impulses(impulse_);
  for (std::size_t s = 0; s < structures.size(); ++s) {
    const std::vector<LocalIndex>& dofs = rows_.trace(s).dofs();
    rows_.trace(s).restrict_to_dofs(structures[s].velocity.data(), velocity_[s].data());
    rows_.add_velocity_change(s, velocity_[s].data());
    steps[s].correct(dofs, before_step_[s], velocity_[s]);
    support_input_ -= rows_.support_work(s, supports.velocity_mean);
  }
  note_peaks();
}

bool FillerStep::hold(double share) {
  double largest = 0;
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    force_[r] = laws_[r].full(now_[r], {&memory_[remembered * r], remembered});
    largest = std::max(largest, force_[r]);
  }
  const double square = share * time_step_ * time_step_;
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    const std::span<const double> memory(&memory_[remembered * r], remembered);
    const double least = free_after_[r] - square * reach_[r] * largest;
    if (force_[r] > 0 && least < interactions::FillerLaw::holds_down_to(before_[r], memory)) {
      return false;
    }
  }
  return true;
}

void FillerStep::solve(double share) {
  const double square = share * time_step_ * time_step_;
  for (int sweep = 0; sweep < most_filler_sweeps; ++sweep) {
    double change = 0;
    double largest = 0;
    for (std::size_t r = 0; r < laws_.size(); ++r) {
      const std::span<const double> memory(&memory_[remembered * r], remembered);
      if (laws_[r].is_idle(now_[r], memory)) continue;
      const std::vector<interactions::FillerRows::Coupling>& coupled = rows_.couplings()[r];
      double after = free_after_[r];
      for (std::size_t k = 1; k < coupled.size(); ++k) {
        after -= square * coupled[k].compliance * force_[coupled[k].row];
      }
      const double force =
          laws_[r].solve(before_[r], now_[r], after, square * coupled[0].compliance, memory);
      change = std::max(change, std::abs(force - force_[r]));
      force_[r] = force;
      largest = std::max(largest, force);
    }
    if (change <= filler_converged * largest) break;
  }
}

void FillerStep::note_peaks() {
  std::fill(contact_force_.begin(), contact_force_.end(), 0.0);
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    const auto& [contact, part] = rows_.rows()[r];
    FillerTotals& totals = totals_[contact];
    contact_force_[contact] += force_[r];
    totals.peak_pressure = std::max(totals.peak_pressure, force_[r] / part.area);
    totals.crushed_strain =
        std::max(totals.crushed_strain, memory_[remembered * r + 1] / part.thickness);
  }
  for (std::size_t c = 0; c < totals_.size(); ++c) {
    totals_[c].peak_force = std::max(totals_[c].peak_force, contact_force_[c]);
  }
}

void FillerStep::finish(StepSums& sums) {
  for (std::size_t r = 0; rows_.member() && r < laws_.size(); ++r) {
    laws_[r].remember(0, now_[r], 0, 1, {&memory_[remembered * r], remembered});
    if (counts_) sums.link_energy_before += held_[r];
  }
  for (std::size_t k = 0; k < records_.links().size(); ++k) {
    const std::size_t r = records_.links()[k];
    records_.note(k, now_[r], force_[r], memory_[remembered * r] > 0);
  }
  if (counts_) sums.link_loss_before += loss_;
  if (rows_.member()) sums.support_input += support_input_;
}

std::vector<std::string> FillerStep::record_names() const {
  std::vector<std::string> names;
  for (const std::size_t r : records_.links()) {
    names.push_back("record of filler row " + std::to_string(r));
  }
  return names;
}

void FillerStep::save(SavedState& saved) const {
  if (!counts_) return;
  std::vector<double> values;
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    values.insert(values.end(), {memory_[remembered * r], force_[r], rate_[r], held_[r]});
  }
  saved.put("fillers", values, saved_values);
  values.clear();
  for (const FillerTotals& totals : totals_) {
    values.insert(values.end(),
                  {totals.peak_pressure, totals.peak_force, totals.crushed_strain, totals.loss});
  }
  saved.put("filler_totals", values, saved_totals);
  records_.save(record_names(), saved);
}

void FillerStep::load(const SavedState& saved) {
  std::vector<double> values(saved_values * laws_.size());
  saved.get("fillers", values);
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    const double* const v = &values[saved_values * r];
    memory_[remembered * r] = memory_[remembered * r + 1] = v[0];
    force_[r] = v[1];
    rate_[r] = v[2];
    held_[r] = v[3];
  }
  values.assign(saved_totals * totals_.size(), 0.0);
  saved.get("filler_totals", values);
  for (std::size_t c = 0; c < totals_.size(); ++c) {
    const double* const v = &values[saved_totals * c];
    totals_[c] = {v[0], v[1], v[2], v[3]};
  }
  if (rows_.member()) records_.load(record_names(), saved);
  made_ = true;
}

}  // namespace pounding
