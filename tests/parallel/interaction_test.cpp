#include "interactions/interaction.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "common/parallel.h"
#include "dynamics/cd_lagrange.h"
#include "laws/yield_law.h"
#include "stability/stable_time_step.h"
#include "support/mast.h"

namespace pounding {
namespace interaction_test {

constexpr double yield_force = 2e3;  // [N]
constexpr double spring = 1e6;       // [N/m]

/// Yielding springs from the translations of every node of one structure to the ground: forces by
/// u_n and a history, which are no part of K and are known to no room of the program.
class YieldingGround final : public interactions::Interaction {
 public:
  YieldingGround(const Mesh& mesh, const LinearSystem& system, double time_step)
      : inverse_mass_(system.inverse_mass), time_step_(time_step), before_(0) {
    for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
      for (int c = 0; c < 3; ++c) {
        if (mesh.dof(node, c) >= 0) dofs_.push_back(mesh.dof(node, c));
      }
    }
    before_ = interactions::Before(dofs_.size());
    memory_.assign(law_.memory_size() * dofs_.size(), 0.0);
    force_.assign(dofs_.size(), 0.0);
    velocity_.assign(dofs_.size(), 0.0);
  }

  void attach(std::span<interactions::SteppedStructure* const> structures) override {
    structures[0]->watch(dofs_, true);
  }
  void begin(const interactions::Step& step) override {
    step.structures[0]->remember(dofs_, before_);
  }
  void push(const interactions::Step& step) override {
    for (std::size_t k = 0; k < dofs_.size(); ++k) {
      const double trial = std::abs(law_.trial(before_.displacement[k], memory(k)));
      const double kept = trial > law_.capacity() ? law_.capacity() / trial : 1;
      law_.yield(before_.displacement[k], kept, memory(k));
      force_[k] = law_.force(0, before_.displacement[k], 0, memory(k));
      const auto dof = static_cast<std::size_t>(dofs_[k]);
      velocity_[k] = step.structures[0]->velocity()[dof] -
                     step.share() * time_step_ * inverse_mass_[dof] * force_[k];
    }
    step.structures[0]->correct(dofs_, before_, velocity_);
  }
  void finish(const interactions::Step& step) override {
    interactions::LedgerPart& ledger = *step.ledger[0];
    for (std::size_t k = 0; k < dofs_.size(); ++k) {
      const double now = before_.displacement[k];
      const double before = now - time_step_ * before_.velocity[k];
      const auto dof = static_cast<std::size_t>(dofs_[k]);
      const double after = now + time_step_ * step.structures[0]->velocity()[dof];
      const double held = law_.energy(before, now, memory(k));
      ledger.link_energy_before += held;
      law_.remember(before, now, after, step.share(), memory(k));
      const double kept = law_.energy(now, after, memory(k)) - held;
      ledger.link_loss += force_[k] * (after - before) / 2 - kept;
    }
  }
  void keep(const StateKeeper& state) override { state.table("yielding ground", memory_); }

  /// Springs of this rank that have yielded.
  int yielded() const {
    int count = 0;
    for (std::size_t k = 0; k < dofs_.size(); ++k) count += law_.has_yielded(memory(k)) ? 1 : 0;
    return count;
  }

 private:
  std::span<double> memory(std::size_t k) {
    return {&memory_[law_.memory_size() * k], law_.memory_size()};
  }
  std::span<const double> memory(std::size_t k) const {
    return {&memory_[law_.memory_size() * k], law_.memory_size()};
  }

  interactions::YieldLaw law_{spring, 0.1, yield_force};
  const std::vector<double>& inverse_mass_;
  double time_step_;
  std::vector<LocalIndex> dofs_;
  interactions::Before before_;
  std::vector<double> memory_;
  std::vector<double> force_;
  std::vector<double> velocity_;
};

/// A mast that is thrown sideways.
testing_support::Mast thrown_mast() {
  return testing_support::build_mast({0, 0, 0}, {1, 0.5, 0});
}

double time_step_of(const testing_support::Mast& mast) {
  return 0.3 * stable_time_step(Rayleigh{}, mast.built.system.element_frequency_bound);
}

/// The stepper of a mast on such ground.
struct OnGround {
  Profile profile;
  GroundMotion still{{}, Resampling::linear};
  CdLagrange stepper;
  YieldingGround& ground;

  explicit OnGround(const testing_support::Mast& mast)
      : stepper(PETSC_COMM_WORLD, {&mast.built.system, 1}, still, time_step_of(mast), profile),
        ground(stepper.add(std::make_unique<YieldingGround>(mast.built.mesh, mast.built.system,
                                                            time_step_of(mast)))) {}
  /// Sum of u^2 over all ranks after some steps.
  double run(int steps) {
    for (int n = 0; n < steps; ++n) stepper.step(false, false);
    double square = 0;
    for (const double u : stepper.state().structures[0].displacement) square += u * u;
    MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
    return square;
  }
};

TEST(Interaction, ThatNoRoomKnowsYieldsAndClosesTheLedger) {
  const testing_support::Mast mast = thrown_mast();
  OnGround run(mast);
  EnergyBalance& energy = run.stepper.energy();
  std::vector<StructureEnergy> energies(1);
  double lost = 0;
  for (int n = 0; n < 4000; ++n) {
    const bool counted = n > 1 && n % 40 == 0;
    run.stepper.step(false, counted);
    if (!counted) continue;
    const EnergyLine line = energy.line(energies);
    EXPECT_GE(line.rows[ledger_row("link_loss")], lost - 1e-9 * energy.largest_term()) << n;
    lost = line.rows[ledger_row("link_loss")];
    energy.note(line);
  }
  int yielded = run.ground.yielded();
  MPI_Allreduce(MPI_IN_PLACE, &yielded, 1, MPI_INT, MPI_SUM, PETSC_COMM_WORLD);
  EXPECT_GT(yielded, 0);
  EXPECT_GT(lost, 0.1 * energy.largest_term());
  EXPECT_LT(energy.relative_residual(), 1e-12);
}

TEST(Interaction, GivesOneMotionOnAnyRanks) {
  const testing_support::Mast mast = thrown_mast();
  constexpr double of_one_rank = 1.0898403641672343e-3;
  EXPECT_NEAR(OnGround(mast).run(500), of_one_rank, 1e-12 * of_one_rank);
}

TEST(Interaction, GoesOnFromWhatItSaved) {
  const testing_support::Mast mast = thrown_mast();
  OnGround whole(mast);
  whole.run(300);
  SavedState saved;
  whole.stepper.keep(StateKeeper::to(saved));
  OnGround continued(mast);
  continued.stepper.keep(StateKeeper::from(saved));
  EXPECT_EQ(whole.run(300), continued.run(300));
  EXPECT_EQ(whole.ground.yielded(), continued.ground.yielded());
}

}  // namespace interaction_test
}  // namespace pounding
