#include "dynamics/energy_balance.h"

#include <algorithm>
#include <cmath>

namespace pounding {

void EnergyBalance::Sum::add(double term) {
  const double sum = value + term;
  correction += std::abs(value) >= std::abs(term) ? (value - sum) + term : (term - sum) + value;
  value = sum;
}

EnergyBalance::EnergyBalance(MPI_Comm comm, std::span<const LinearSystem> systems, double time_step)
    : comm_(comm), systems_(systems), time_step_(time_step) {
  for (const LinearSystem& system : systems) {
    const std::vector<double> zero(system.lumped_mass.size(), 0.0);
    Body body{zero, zero, zero, {}, 0, 0, 0};
    for (std::size_t d = 0; d < 3; ++d) {
      body.momentum[d] = system.influence[d];
      for (std::size_t i = 0; i < zero.size(); ++i) {
        body.momentum[d][i] *= system.lumped_mass[i];
      }
    }
    bodies_.push_back(std::move(body));
  }
}

void EnergyBalance::close_previous_step(const State& state) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    close_body(systems_[b], state.bodies[b], bodies_[b]);
  }
  contact_.add(closed_steps_ > 0 ? contact_step_ : 0);
  ++closed_steps_;
}

void EnergyBalance::close_body(const LinearSystem& system, const BodyState& state, Body& body) {
  const double dt = time_step_;
  const double alpha = system.damping.alpha;
  const double beta = system.damping.beta;
  const bool first = closed_steps_ == 0;
  const std::size_t n = state.displacement.size();
  const double* const mass = system.lumped_mass.data();
  const double* const v = state.velocity_half.data();
  const double* const u = state.displacement.data();
  const double* const q = state.stiffness_force.data();
  double kinetic = 0;
  double strain = 0;
  double lost = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double ku_before = body.stiffness_displacement[i];
    const double kv = (q[i] - ku_before) / (beta + dt);
    const double cv = alpha * mass[i] * v[i] + beta * kv;
    kinetic += v[i] * (mass[i] * v[i] - dt / 2 * cv);
    strain += u[i] * ku_before;
    const double mean = (v[i] + body.velocity[i]) / 2;
    lost += mean * (alpha * mass[i] * mean + beta * (kv + body.stiffness_velocity[i]) / 2);
    body.stiffness_displacement[i] = (beta * ku_before + dt * q[i]) / (beta + dt);
    body.stiffness_velocity[i] = kv;
  }
  body.kinetic = kinetic / 2;
  body.strain = strain / 2;
  double work = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double acceleration = acceleration_[d] - system.gravity[d];
    if (acceleration != 0) {
      double momentum = 0;
      for (std::size_t i = 0; i < n; ++i) {
        momentum += body.momentum[d][i] * (v[i] + body.velocity[i]);
      }
      work -= dt / 2 * acceleration * momentum;
    }
  }
  double device = 0;
  for (std::size_t i = 0; i < state.device_force.size(); ++i) {
    device += dt / 2 * state.device_force[i] * (v[i] + body.velocity[i]);
  }
  if (first) {
    body.initial = body.kinetic + body.strain;
  } else {
    damping_.add(dt * lost);
    input_.add(work);
    device_.add(device);
  }
  std::copy_n(v, n, body.velocity.begin());
}

void EnergyBalance::add_step(const std::array<double, 3>& ground_acceleration,
                             double contact_work) {
  acceleration_ = ground_acceleration;
  contact_step_ = contact_work;
}

EnergyLine EnergyBalance::line(std::span<double> energies) const {
  std::array<double, 7> sums{
      0, 0, 0, damping_.total(), contact_.total(), input_.total(), device_.total()};
  for (const Body& body : bodies_) {
    sums[0] += body.kinetic;
    sums[1] += body.strain;
    sums[2] += body.initial;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 7, MPI_DOUBLE, MPI_SUM, comm_);
  if (!energies.empty()) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      energies[b] = bodies_[b].kinetic + bodies_[b].strain;
    }
    MPI_Allreduce(MPI_IN_PLACE, energies.data(), static_cast<int>(energies.size()), MPI_DOUBLE,
                  MPI_SUM, comm_);
  }
  EnergyLine line;
  line.time = static_cast<double>(closed_steps_ - 1) * time_step_;
  line.kinetic = sums[0];
  line.strain = sums[1];
  line.damping_loss = sums[3];
  line.contact_work = sums[4];
  line.input_work = sums[5];
  line.device_work = sums[6];
  line.residual = line.energy() - sums[2] + line.damping_loss + line.device_work -
                  line.contact_work - line.input_work;
  return line;
}

void EnergyBalance::note(const EnergyLine& line) {
  largest_residual_ = std::max(largest_residual_, std::abs(line.residual));
  largest_term_ = std::max({largest_term_, std::abs(line.kinetic), std::abs(line.strain),
                            std::abs(line.device_work), line.damping_loss,
                            std::abs(line.contact_work), std::abs(line.input_work)});
}

}  // namespace pounding
