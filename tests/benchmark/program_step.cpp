#include <cmath>
#include <limits>
#include <stdexcept>

#include "benchmark/timed_step.h"
#include "model/model_scheme.h"
#include "scene/option_table.h"
#include "stability/stable_time_step.h"

namespace pounding::measuring {
namespace {

constexpr double gap_tolerance = 1e-12;  // of the model's size

ModelScheme::Parts scheme_parts(const SteppedModel& model, Profile& profile) {
  ModelScheme::Parts parts{model.comm,         model.systems,
                           model.meshes,       &model.interface,
                           model.motion.get(), gap_tolerance * model.interface.model_size,
                           model.time_step,    {},
                           &profile,           std::numeric_limits<double>::infinity(),
                           model.contacts,     model.supports.get()};
  for (const LinearSystem& system : model.systems) {
    parts.energy_margins.push_back(
        energy_margin(system.damping, system.element_frequency_bound, model.time_step));
  }
  return parts;
}

class ProgramStep final : public TimedStep {
 public:
  explicit ProgramStep(const SteppedModel& model)
      : scheme_(scheme_parts(model, profile_)),
        ledger_interval_(std::stol(std::string(option_row("energy_interval").preset.text))),
        energies_(model.systems.size()),
        no_round_off_(model.systems.size(), 0.0) {}

  void run(long steps) override {
    for (long i = 0; i < steps; ++i, ++step_) {
      const bool ledger = step_ > 0 && step_ % ledger_interval_ == 0;
      scheme_.stepper().step(true, ledger);
      if (ledger) {
        close_ledger_line();
      }
    }
  }

  double displacement_square() const override {
    double sum = 0;
    for (const StructureState& body : scheme_.stepper().state().structures) {
      for (std::size_t i = 0; i < body.displacement.size(); ++i) {
        // The state is one step ahead of the velocities' time.
        const double u = body.displacement[i] - scheme_.stepper().time_step() * body.velocity[i];
        sum += u * u;
      }
    }
    return sum;
  }

  double contact_seconds() const override { return profile_.seconds(Phase::contact); }

 private:
  void close_ledger_line() {
    EnergyBalance& energy = scheme_.stepper().energy();
    energy.note(energy.line(energies_));
    scheme_.note_energies(energy.closed_steps() - 1, energies_, no_round_off_);
    if (!(energy.relative_residual() < 1e-6)) {
      throw std::runtime_error("the energy identity does not close");
    }
  }

  Profile profile_;
  ModelScheme scheme_;
  long ledger_interval_;
  std::vector<StructureEnergy> energies_;
  std::vector<double> no_round_off_;
  long step_ = 0;
};

}  // namespace

std::unique_ptr<TimedStep> make_program_step(const SteppedModel& model) {
  return std::make_unique<ProgramStep>(model);
}

}  // namespace pounding::measuring
