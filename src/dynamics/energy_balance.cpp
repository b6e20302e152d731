#include "dynamics/energy_balance.h"

#include <algorithm>
#include <cmath>

namespace pounding {
namespace {

/// Sums run in this many lanes, which the vector unit adds side by side; the order is fixed.
constexpr std::size_t lanes = 8;

double add_up(const std::array<double, lanes>& sums) {
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

double dot(const double* __restrict a, const double* __restrict b, std::size_t n) {
  std::array<double, lanes> sums{};
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes) {
    for (std::size_t l = 0; l < lanes; ++l) {
      sums[l] += a[i + l] * b[i + l];
    }
  }
  for (; i < n; ++i) {
    sums[0] += a[i] * b[i];
  }
  return add_up(sums);
}

struct Coefficients {
  double alpha;
  double beta;
  double dt;
};

/// Brings velocity, K u and K v one step on and returns vbar^T C vbar of the step closed.
double advance_stiffness_products(const Coefficients& c, std::size_t n,
                                  const double* __restrict mass, const double* __restrict v,
                                  const double* __restrict q, double* __restrict velocity,
                                  double* __restrict ku, double* __restrict kv) {
  const double inverse = 1 / (c.beta + c.dt);
  std::array<double, lanes> sums{};
  const auto advance = [&](std::size_t i) {
    const double kv_now = (q[i] - ku[i]) * inverse;
    const double mean = (v[i] + velocity[i]) / 2;
    const double force = c.alpha * mass[i] * mean + c.beta * ((kv_now + kv[i]) / 2);
    ku[i] += c.dt * kv_now;
    kv[i] = kv_now;
    velocity[i] = v[i];
    return mean * force;
  };
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes) {
    for (std::size_t l = 0; l < lanes; ++l) {
      sums[l] += advance(i + l);
    }
  }
  for (; i < n; ++i) {
    sums[0] += advance(i);
  }
  return add_up(sums);
}

}  // namespace

void EnergyBalance::Sum::add(double term) {
  const double sum = value + term;
  correction += std::abs(value) >= std::abs(term) ? (value - sum) + term : (term - sum) + value;
  value = sum;
}

EnergyBalance::EnergyBalance(MPI_Comm comm, std::span<const LinearSystem> systems,
                             std::array<bool, 3> shaken, double time_step)
    : comm_(comm), systems_(systems), shaken_(shaken), time_step_(time_step) {
  for (const LinearSystem& system : systems) {
    const std::vector<double> zero(system.lumped_mass.size(), 0.0);
    Body body{zero, zero, zero, {}, {}, 0, 0, 0};
    for (std::size_t d = 0; d < 3; ++d) {
      body.momentum[d] = system.influence[d];
      for (std::size_t i = 0; i < zero.size(); ++i) {
        body.momentum[d][i] *= system.lumped_mass[i];
      }
    }
    bodies_.push_back(std::move(body));
  }
}

void EnergyBalance::close_previous_step(const State& state, bool with_energies) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (with_energies || closed_steps_ == 0) {
      evaluate_energies(systems_[b], state.bodies[b], bodies_[b]);
    }
    close_body(systems_[b], state.bodies[b], bodies_[b]);
  }
  contact_.add(closed_steps_ > 0 ? contact_step_ : 0);
  ++closed_steps_;
}

void EnergyBalance::evaluate_energies(const LinearSystem& system, const BodyState& state,
                                      Body& body) const {
  const double dt = time_step_;
  const double alpha = system.damping.alpha;
  const double beta = system.damping.beta;
  double kinetic = 0;
  double strain = 0;
  for (std::size_t i = 0; i < state.displacement.size(); ++i) {
    const double ku_before = body.stiffness_displacement[i];
    const double kv = (state.stiffness_force[i] - ku_before) / (beta + dt);
    const double v = state.velocity_half[i];
    const double mv = system.lumped_mass[i] * v;
    kinetic += v * (mv - dt / 2 * (alpha * mv + beta * kv));
    strain += state.displacement[i] * ku_before;
  }
  body.kinetic = kinetic / 2;
  body.strain = strain / 2;
  if (closed_steps_ == 0) {
    body.initial = body.kinetic + body.strain;
  }
}

void EnergyBalance::close_body(const LinearSystem& system, const BodyState& state, Body& body) {
  const double dt = time_step_;
  const bool first = closed_steps_ == 0;
  const std::size_t n = state.displacement.size();
  const double* const v = state.velocity_half.data();
  double work = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double before = body.ground_momentum[d];
    if (system.gravity[d] != 0 || shaken_[d]) {
      body.ground_momentum[d] = dot(body.momentum[d].data(), v, n);
    }
    work -= dt / 2 * (acceleration_[d] - system.gravity[d]) * (before + body.ground_momentum[d]);
  }
  double device = 0;
  for (std::size_t i = 0; i < state.device_force.size(); ++i) {
    device += dt / 2 * state.device_force[i] * (v[i] + body.velocity[i]);
  }
  const Coefficients coefficients{system.damping.alpha, system.damping.beta, dt};
  const double lost = advance_stiffness_products(
      coefficients, n, system.lumped_mass.data(), v, state.stiffness_force.data(),
      body.velocity.data(), body.stiffness_displacement.data(), body.stiffness_velocity.data());
  if (!first) {
    damping_.add(dt * lost);
    input_.add(work);
    device_.add(device);
  }
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
