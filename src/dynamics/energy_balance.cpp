#include "dynamics/energy_balance.h"

#include <algorithm>
#include <cmath>

#include "common/parallel.h"

namespace pounding {

void EnergyBalance::Sum::add(double term) {
  if (term == 0) return;
  const double sum = value + term;
  correction += std::abs(value) >= std::abs(term) ? (value - sum) + term : (term - sum) + value;
  value = sum;
}

EnergyBalance::EnergyBalance(MPI_Comm comm, std::span<const LinearSystem> systems, double time_step)
    : comm_(comm),
      systems_(systems),
      time_step_(time_step),
      energies_(systems.size()),
      filtered_(systems.size()),
      open_filtered_(systems.size(), 0.0) {
  for (const LinearSystem& system : systems) {
    const double decay = 1 - time_step_ * system.damping.alpha;
    mass_damping_.push_back((1 - decay) / time_step_);
  }
}

void EnergyBalance::take_energies(std::span<const StepSums> sums) {
  lagged_damping_ = 0;
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    lagged_damping_ += time_step_ / 4 * sums[b].extra_damping_before;
    energies_[b] = energy(b, sums[b]);
    if (steps_ == 1) initial_ += energies_[b].energy();
  }
  stored_work_ = 0;
  for (std::size_t b = 0; b < systems_.size(); ++b) stored_work_ += stored_work(b, sums[b]);
}

void EnergyBalance::add_step(std::span<const StepSums> sums,
                             const std::array<double, 3>& ground_acceleration, bool with_energies) {
  if (with_energies) take_energies(sums);
  for (std::size_t r = 0; steps_ > 1 && r < ledger_rows.size(); ++r) {
    if (ledger_rows[r].before == nullptr) continue;
    for (const StepSums& structure : sums) open_[r] += structure.*ledger_rows[r].before;
  }
  if (steps_ == 1) {
    initial_lagged_damping_ = lagged_damping_;
    initial_stored_work_ = stored_work_;
    double begun = 0;
    for (std::size_t r = 0; r < ledger_rows.size(); ++r) begun -= ledger_rows[r].sign * open_[r];
    initial_ -= begun;
  }
  for (std::size_t r = 0; r < ledger_rows.size(); ++r) closed_[r].add(open_[r]);
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    closed_[ledger_row("damping_loss")].add(open_filtered_[b]);
    filtered_[b].add(open_filtered_[b]);
    open_filtered_[b] = steps_ > 0 ? time_step_ / 2 * sums[b].filtered : 0;
  }
  open_rows(sums, ground_acceleration);
  ++steps_;
}

double EnergyBalance::stored_work(std::size_t structure, const StepSums& sums) const {
  const double beta = systems_[structure].damping.beta;
  return beta == 0 ? 0 : sums.strain_back / 2 - time_step_ / 4 * beta * sums.stiffness_before;
}

void EnergyBalance::change_order(std::size_t structure, const StepSums& before,
                                 const StepSums& after) {
  closed_[ledger_row("switch_loss")].add(energy(structure, before).energy() -
                                         energy(structure, after).energy());
  closed_[ledger_row("damping_loss")].add(stored_work(structure, after) -
                                          stored_work(structure, before));
}

void EnergyBalance::open_rows(std::span<const StepSums> sums,
                              const std::array<double, 3>& ground_acceleration) {
  open_ = {};
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    const LedgerStep step{sums[b], systems_[b], time_step_, mass_damping_[b], ground_acceleration};
    for (std::size_t r = 0; r < ledger_rows.size(); ++r) {
      const LedgerRow::Work add = steps_ == 0 ? ledger_rows[r].start : ledger_rows[r].add;
      if (add != nullptr) add(step, open_[r]);
    }
  }
}

StructureEnergy EnergyBalance::energy(std::size_t structure, const StepSums& sums) const {
  const LinearSystem& system = systems_[structure];
  const double dt = time_step_;
  const double inertia =
      (1 - dt / 2 * mass_damping_[structure]) * sums.kinetic_before + sums.added_kinetic_before;
  const double relief = system.uniform_damping ? 1 - system.uniform_damping->at_rest() : 0;
  const double damped =
      inertia - dt / 2 * (system.damping.beta * sums.stiffness_before + sums.extra_damping_before);
  return {damped / 2,
          sums.strain_before / 2 + sums.link_energy_before,
          (damped - dt * dt / 4 * system.stiffening() * sums.stiffness_before) / 2,
          sums.displacement_mass,
          sums.rest_before,
          relief * (sums.strain_before / 2 + sums.rest_before)};
}

EnergyLine EnergyBalance::line(std::span<StructureEnergy> structures) const {
  constexpr std::size_t values = sizeof(StructureEnergy) / sizeof(double);
  std::copy(energies_.begin(), energies_.end(), structures.begin());
  for (std::size_t b = 0; b < structures.size(); ++b) {
    structures[b].held += structures[b].energy() + filtered_[b].total();
  }
  reduce_over_ranks(comm_, MPI_SUM,
                    std::span(&structures.front().kinetic, values * structures.size()));
  std::array<double, ledger_rows.size() + 1> sums{};
  for (std::size_t r = 0; r < ledger_rows.size(); ++r) sums[r] = closed_[r].total();
  sums[ledger_row("damping_loss")] -= stored_work_ - initial_stored_work_;
  double& devices = sums[ledger_row("device_work")];
  devices = devices + lagged_damping_ - initial_lagged_damping_;
  sums.back() = initial_;
  reduce_over_ranks(comm_, MPI_SUM, sums);
  devices += sums[ledger_row("link_loss")];
  EnergyLine line;
  line.time = static_cast<double>(closed_steps() - 1) * time_step_;
  for (const StructureEnergy& structure : structures) {
    line.kinetic += structure.kinetic;
    line.strain += structure.strain;
    line.slow_relief += structure.slow_relief;
  }
  line.residual = line.energy() - sums.back();
  for (std::size_t r = 0; r < ledger_rows.size(); ++r) {
    line.rows[r] = sums[r];
    line.residual += ledger_rows[r].sign * sums[r];
  }
  return line;
}

void EnergyBalance::keep(const StateKeeper& state) {
  std::vector<double*> parts;  // numbers of this rank that add up over ranks
  const auto add = [&](auto& numbers) {
    for (double& number : numbers) parts.push_back(&number);
  };
  const auto add_sums = [&](auto& sums) {
    for (Sum& sum : sums) parts.insert(parts.end(), {&sum.value, &sum.correction});
  };
  add_sums(closed_);
  parts.insert(parts.end(), {&initial_, &initial_lagged_damping_, &initial_stored_work_});
  add(open_);
  add_sums(filtered_);
  add(open_filtered_);
  std::vector<double> sums;
  for (const double* part : parts) sums.push_back(*part);
  state.sums("energy", sums);
  for (std::size_t i = 0; i < parts.size(); ++i) *parts[i] = sums[i];
  state.numbers("energy", steps_, largest_term_, largest_residual_);
}

void EnergyBalance::note(const EnergyLine& line) {
  largest_residual_ = std::max(largest_residual_, std::abs(line.residual));
  largest_term_ = std::max({largest_term_, std::abs(line.kinetic), std::abs(line.strain)});
  for (std::size_t r = 0; r < ledger_rows.size(); ++r) {
    if (ledger_rows[r].sign != 0) largest_term_ = std::max(largest_term_, std::abs(line.rows[r]));
  }
}

}  // namespace pounding
