#include "driver/energy_watch.h"

#include "driver/run_statistics.h"
#include "driver/watchdog.h"
#include "output/energy_ledger.h"

namespace pounding {
namespace {

class EnergyWatch final : public Observer {
 public:
  explicit EnergyWatch(const ObservedRun& run)
      : run_(run), ledger_(run.model.steps / run.scene.energy_interval + 2) {}

  std::int64_t next_due(std::int64_t step) const override { return run_.next_ledger_step(step); }
  StepNeeds begin(const CdLagrange& /*stepper*/) override { return {.energies = true}; }
  void observe(const CdLagrange& stepper) override;
  void save(SavedState& saved) override {
    if (rank_of(run_.comm) == 0) ledger_.save(saved);
  }
  void load(const SavedState& saved) override { ledger_.load(saved); }
  void report(RunStatistics& statistics) override;
  Phase phase() const override { return Phase::energy; }

 private:
  ObservedRun run_;
  EnergyLedger ledger_;
};

}  // namespace

void EnergyWatch::observe(const CdLagrange& stepper) {
  EnergyBalance& energy = run_.solver.stepper().energy();
  const ClosedLine closed =
      close_line(run_.comm, run_.model, stepper.state(), run_.solver.contact(), energy);
  run_.solver.note_energies(energy.closed_steps() - 1, closed.energies, closed.round_off);
  ledger_.add(closed.line);
}

void EnergyWatch::report(RunStatistics& statistics) {
  statistics.energy = ledger_.last();
  statistics.energy_residual = run_.solver.stepper().energy().relative_residual();
  on_rank0(run_.comm, [&] {
    write_energy(run_.scene.output + "/energy.csv", ledger_.lines(), run_.scene.csv_digits);
  });
}

std::unique_ptr<Observer> make_energy_watch(const ObservedRun& run) {
  return std::make_unique<EnergyWatch>(run);
}

}  // namespace pounding
