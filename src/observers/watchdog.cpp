#include "observers/watchdog.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "mesh/location.h"
#include "modal/reduced_system.h"
#include "observers/energy_ledger.h"
#include "observers/run_statistics.h"
#include "scene/law_kinds.h"

namespace pounding {
namespace {

/// Part of the largest energy term beyond which the identity is broken.
constexpr double broken_identity = 1e-6;

/// Part of the largest energy term that damping and devices may have given.
constexpr double given_energy = 1e-6;

/// Round-off of u^T K u over omega_max^2 u^T M u, with a margin for sums over many steps.
constexpr double product_round_off = 1e-14;

/// Part of the kinetic energy by which round-off can make the positive part negative.
constexpr double round_off = 1e-10;

/// Frequency that bounds the round-off of K u of a structure [rad/s].
double row_frequency(const Model& model, std::size_t structure) {
  // K keeps its stiff entries whatever the mass is that they meet.
  return std::max(model.buildings[structure].limits.largest.omega_max,
                  model.systems[structure].mass_scaling.row_frequency);
}

/// Complaint about the energies of a structure; empty if nothing is wrong. `omega`: see
/// row_frequency.
std::string complaint(const StructureEnergy& energy, double omega) {
  // K v comes from two products K u, whose round-off stays when v is next to nothing.
  const double allowed = round_off * std::abs(energy.kinetic) +
                         product_round_off * omega *
                             std::sqrt(2 * std::abs(energy.kinetic) * energy.displacement_mass);
  if (!std::isfinite(energy.energy()) || !std::isfinite(energy.positive_part)) {
    return "its energy is not a number";
  }
  if (!(energy.positive_part < -allowed)) return "";
  return sentence(
      "v^T (M + S - dt/2 C - dt^2/4 s K) v / 2 = {} J is negative (kinetic {} J, strain {} J)",
      {energy.positive_part, energy.kinetic, energy.strain});
}

class EnergyWatch final : public Observer {
 public:
  explicit EnergyWatch(const ObservedRun& run)
      : run_(run), ledger_(run.model.steps / run.scene.energy_interval + 2) {}

  std::int64_t next_due(std::int64_t step) const override { return run_.next_ledger_step(step); }
  StepNeeds begin(const CdLagrange& /*stepper*/) override { return {.energies = true}; }
  void observe(const CdLagrange& stepper) override {
    EnergyBalance& energy = run_.scheme.stepper().energy();
    const ClosedLine closed =
        close_line(run_.comm, run_.model, stepper.state(), run_.scheme.contact(), energy);
    run_.scheme.note_energies(energy.closed_steps() - 1, closed.energies, closed.round_off);
    ledger_.add(closed.line);
  }

  void keep_state(const StateKeeper& state) override {
    ledger_.keep(state.known_if(rank_of(run_.comm) == 0));
  }

  void report(RunStatistics& statistics) override {
    statistics.energy = ledger_.last();
    statistics.energy_residual = run_.scheme.stepper().energy().relative_residual();
    on_rank0(run_.comm, [&] {
      write_energy(run_.path("energy.csv"), ledger_.lines(), run_.scene.csv_digits);
    });
  }

  Phase phase() const override { return Phase::energy; }

 private:
  ObservedRun run_;
  EnergyLedger ledger_;
};

}  // namespace

void watch_divergence(const Model& model, const State& state, const EnergyLine& line,
                      std::span<const StructureEnergy> structures) {
  for (std::size_t s = 0; s < structures.size(); ++s) {
    const std::string wrong = complaint(structures[s], row_frequency(model, s));
    if (wrong.empty()) continue;
    std::vector<double> motion = state.structures[s].velocity;
    for (std::size_t i = 0; i < motion.size(); ++i) {
      motion[i] *= std::sqrt(model.systems[s].lumped_mass[i]);
    }
    throw DivergenceError(
        sentence("the run diverged: structure {}: {} at t = {} s (step {}); it moves most at {}; "
                 "time step {} s, stable {} s",
                 {model.systems[s].name, wrong, line.time, state.step - 1,
                  model.buildings[s].locate_largest(motion), model.time_step,
                  model.buildings[s].limits.stable_time_step}));
  }
}

double energy_round_off(const Model& model, std::size_t structure, const StructureEnergy& energy) {
  const double omega = row_frequency(model, structure);
  return product_round_off * omega * omega * energy.displacement_mass;
}

void watch_passivity(const EnergyLine& line, double largest_term, bool leaning) {
  const auto refuse = [&](std::string_view what, double loss,
                          const char* remedy = "a smaller time step") {
    throw DivergenceError(
        sentence("{} gave {} J more than it took until t = {} s (largest term of the energies {} "
                 "J); the run is stopped, its results cannot be trusted; try {}",
                 {what, -loss, line.time, largest_term, remedy}));
  };
  const double allowed = given_energy * largest_term;
  for (std::size_t r = 0; r < ledger_rows.size(); ++r) {
    const std::string_view taker = ledger_rows[r].taker;
    if (!taker.empty() && line.rows[r] < -allowed) refuse(taker, line.rows[r]);
  }
  const double dashpots = line.rows[ledger_row("device_work")] - line.rows[ledger_row("link_loss")];
  const double damped = line.rows[ledger_row("damping_loss")] + dashpots;
  if (damped + std::abs(line.slow_relief) < -allowed) {
    refuse("damping", damped,
           leaning ? "damping_alpha alone: beta damps with the stiffness that is left, and beside "
                     "p_delta that is below 0 where columns yield and lean, at any time step"
                   : "a smaller time step");
  }
}

void watch_contact(MPI_Comm comm, const interactions::ContactProblem* contact, double time) {
  double residual = contact != nullptr ? contact->largest_residual() : 0;
  reduce_over_ranks(comm, MPI_MAX, residual);
  if (!std::isfinite(residual)) {
    throw DivergenceError(sentence(
        "the run diverged: before t = {} s the contact problem held a number that is not finite, "
        "and its impulses were left out; look at masses and stiffnesses beside the contacts",
        {time}));
  }
}

void watch_identity(const Model& model, const EnergyLine& line,
                    std::span<const StructureEnergy> structures, double largest_term) {
  double allowed = broken_identity * largest_term;
  const double shaking = model.motion->peak_acceleration();
  for (std::size_t s = 0; s < structures.size(); ++s) {
    const Vector3& g = model.systems[s].gravity;
    const double speed = model.time_step * (shaking + std::hypot(g[0], g[1], g[2]));
    allowed += broken_identity * model.systems[s].total_mass * speed * speed / 2;
    allowed += energy_round_off(model, s, structures[s]);
  }
  if (std::abs(line.residual) > allowed) {
    throw DivergenceError(
        sentence("the energy identity does not close at t = {} s: residual {} J, largest term {} "
                 "J, round-off allows {} J; the run is stopped, its results cannot be trusted",
                 {line.time, line.residual, largest_term, allowed}));
  }
}

ClosedLine close_line(MPI_Comm comm, const Model& model, const State& state,
                      const interactions::ContactProblem* contact, EnergyBalance& energy) {
  ClosedLine closed;
  closed.energies.resize(model.systems.size());
  closed.line = energy.line(closed.energies);
  energy.note(closed.line);
  watch_divergence(model, state, closed.line, closed.energies);
  watch_identity(model, closed.line, closed.energies, energy.largest_term());
  const bool leaning = std::ranges::any_of(model.buildings, [](const Building& building) {
    const auto yields = [](const Region& region) {
      return has_element_law(region) && !follows_law(region);
    };
    return building.structure->p_delta && building.system->damping.beta > 0 &&
           std::ranges::any_of(building.structure->regions, yields);
  });
  watch_passivity(closed.line, energy.largest_term(), leaning);
  watch_contact(comm, contact, closed.line.time);
  for (std::size_t s = 0; s < closed.energies.size(); ++s) {
    closed.round_off.push_back(energy_round_off(model, s, closed.energies[s]));
  }
  return closed;
}

OutputKind energy_output() {
  return output<EnergyWatch>({{"energy.csv", "the energy ledger", energy_columns()}}, nullptr,
                             true);
}

}  // namespace pounding
