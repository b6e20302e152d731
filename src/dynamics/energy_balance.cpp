#include "dynamics/energy_balance.h"

#include <algorithm>
#include <cmath>

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
    stiffening_.push_back(system.stiffening());
    relief_.push_back(system.uniform_damping ? 1 - system.uniform_damping->at_rest() : 0);
  }
}

void EnergyBalance::take_energies(std::span<const StepSums> sums) {
  lagged_damping_ = 0;
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    lagged_damping_ += time_step_ / 4 * sums[b].extra_damping_before;
    energies_[b] = energy(b, sums[b]);
    if (steps_ == 1) initial_ += energies_[b].energy();
  }
  stored_work_ = stored_work(sums);
}

void EnergyBalance::add_step(std::span<const StepSums> sums,
                             const std::array<double, 3>& ground_acceleration, bool with_energies) {
  if (with_energies) take_energies(sums);
  for (const StepSums& structure : sums) {
    open_.links += structure.link_loss_before;
    open_.plastic += structure.plastic_loss_before;
  }
  if (steps_ == 1) {
    initial_lagged_damping_ = lagged_damping_;
    initial_stored_work_ = stored_work_;
    initial_ -= open_.contact - open_.friction + open_.contact_supports;
    contact_.add(open_.contact);
    friction_.add(open_.friction);
    input_.add(open_.contact_supports);
  }
  if (steps_ > 1) {
    damping_.add(open_.damping);
    input_.add(open_.input);
    contact_.add(open_.contact);
    device_.add(open_.device);
    links_.add(open_.links);
    plastic_.add(open_.plastic);
    gravity_.add(open_.gravity);
    loads_.add(open_.loads);
    friction_.add(open_.friction);
    for (std::size_t b = 0; b < systems_.size(); ++b) {
      damping_.add(open_filtered_[b]);
      filtered_[b].add(open_filtered_[b]);
    }
  }
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    open_filtered_[b] = time_step_ / 2 * sums[b].filtered;
  }
  open_ = works(sums, ground_acceleration);
  ++steps_;
}

double EnergyBalance::stored_work(std::span<const StepSums> sums) const {
  double stored = 0;
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    const double beta = systems_[b].damping.beta;
    if (beta == 0) continue;
    stored += sums[b].strain_back / 2 - time_step_ / 4 * beta * sums[b].stiffness_before;
  }
  return stored;
}

/// Works of the step just made.
EnergyBalance::Works EnergyBalance::works(std::span<const StepSums> sums,
                                          const std::array<double, 3>& ground_acceleration) const {
  Works result;
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    const Rayleigh& damping = systems_[b].damping;
    result.damping += time_step_ / 4 * mass_damping_[b] * sums[b].mass_sum;
    if (damping.beta != 0) result.damping += time_step_ / 2 * sums[b].stiffness_work;
    result.damping += sums[b].damping_loss;
    for (std::size_t d = 0; d < 3; ++d) {
      result.input +=
          time_step_ / 2 * (systems_[b].gravity[d] - ground_acceleration[d]) * sums[b].momentum[d];
      result.gravity += time_step_ / 2 * systems_[b].gravity[d] * sums[b].momentum[d];
    }
    result.loads += time_step_ / 2 * sums[b].load;
    result.device += time_step_ / 2 * sums[b].device;
    result.links += sums[b].link_loss;
    result.plastic += sums[b].plastic_loss;
    result.contact += sums[b].contact_work;
    result.friction += sums[b].friction_loss;
    result.input += sums[b].link_input + sums[b].support_input + sums[b].contact_support_input;
    result.contact_supports += sums[b].contact_support_input;
  }
  return result;
}

StructureEnergy EnergyBalance::energy(std::size_t structure, const StepSums& sums) const {
  const LinearSystem& system = systems_[structure];
  const double dt = time_step_;
  const double inertia =
      (1 - dt / 2 * mass_damping_[structure]) * sums.kinetic_before + sums.added_kinetic_before;
  const double damped =
      inertia - dt / 2 * (system.damping.beta * sums.stiffness_before + sums.extra_damping_before);
  return {damped / 2,
          sums.strain_before / 2 + sums.link_energy_before,
          (damped - dt * dt / 4 * stiffening_[structure] * sums.stiffness_before) / 2,
          sums.displacement_mass,
          sums.rest_before,
          relief_[structure] * (sums.strain_before / 2 + sums.rest_before)};
}

EnergyLine EnergyBalance::line(std::span<StructureEnergy> structures) const {
  constexpr std::size_t values = sizeof(StructureEnergy) / sizeof(double);
  std::copy(energies_.begin(), energies_.end(), structures.begin());
  for (std::size_t b = 0; b < structures.size(); ++b) {
    structures[b].held += structures[b].energy() + filtered_[b].total();
  }
  MPI_Allreduce(MPI_IN_PLACE, structures.data(), static_cast<int>(values * structures.size()),
                MPI_DOUBLE, MPI_SUM, comm_);
  std::array<double, 10> sums{initial_,
                              damping_.total() - (stored_work_ - initial_stored_work_),
                              contact_.total(),
                              input_.total(),
                              device_.total() + lagged_damping_ - initial_lagged_damping_,
                              links_.total(),
                              gravity_.total(),
                              friction_.total(),
                              loads_.total(),
                              plastic_.total()};
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                comm_);
  EnergyLine line;
  line.time = static_cast<double>(closed_steps() - 1) * time_step_;
  for (const StructureEnergy& structure : structures) {
    line.kinetic += structure.kinetic;
    line.strain += structure.strain;
    line.slow_relief += structure.slow_relief;
  }
  line.damping_loss = sums[1];
  line.contact_work = sums[2];
  line.input_work = sums[3];
  line.link_loss = sums[5];
  line.gravity_work = sums[6];
  line.friction_loss = sums[7];
  line.load_work = sums[8];
  line.plastic_loss = sums[9];
  line.device_work = sums[4] + line.link_loss;
  line.residual = line.energy() - sums[0] + line.damping_loss + line.device_work +
                  line.plastic_loss - line.contact_work + line.friction_loss - line.input_work;
  return line;
}

template <typename Balance, typename Function>
void EnergyBalance::for_each_sum(Balance& balance, Function&& function) {
  for (auto* sum :
       {&balance.damping_, &balance.input_, &balance.contact_, &balance.device_, &balance.links_,
        &balance.plastic_, &balance.gravity_, &balance.loads_, &balance.friction_}) {
    function(sum->value);
    function(sum->correction);
  }
  function(balance.initial_);
  function(balance.initial_lagged_damping_);
  function(balance.initial_stored_work_);
  for (auto* work :
       {&balance.open_.damping, &balance.open_.input, &balance.open_.contact, &balance.open_.device,
        &balance.open_.links, &balance.open_.plastic, &balance.open_.gravity, &balance.open_.loads,
        &balance.open_.friction, &balance.open_.contact_supports}) {
    function(*work);
  }
  for (auto& sum : balance.filtered_) {
    function(sum.value);
    function(sum.correction);
  }
  for (auto& work : balance.open_filtered_) function(work);
}

void EnergyBalance::save(SavedState& saved) const {
  std::vector<double> sums;
  for_each_sum(*this, [&](double value) { sums.push_back(value); });
  saved.put_sums("energy", sums);
  saved.put("energy", {static_cast<double>(steps_), largest_term_, largest_residual_});
}

void EnergyBalance::load(const SavedState& saved) {
  std::size_t count = 0;
  for_each_sum(*this, [&](double) { ++count; });
  std::vector<double> sums(count);
  saved.get_sums("energy", sums);
  std::size_t next = 0;
  for_each_sum(*this, [&](double& value) { value = sums[next++]; });
  std::array<double, 3> numbers{};
  saved.get("energy", numbers);
  steps_ = saved.whole("energy", numbers[0]);
  largest_term_ = numbers[1];
  largest_residual_ = numbers[2];
}

void EnergyBalance::note(const EnergyLine& line) {
  largest_residual_ = std::max(largest_residual_, std::abs(line.residual));
  largest_term_ =
      std::max({largest_term_, std::abs(line.kinetic), std::abs(line.strain),
                std::abs(line.device_work), std::abs(line.plastic_loss), line.damping_loss,
                std::abs(line.contact_work), std::abs(line.input_work), line.friction_loss});
}

}  // namespace pounding
