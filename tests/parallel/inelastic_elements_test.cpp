#include "interactions/inelastic_elements.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "common/parallel.h"
#include "dynamics/cd_lagrange.h"
#include "modal/modal_analysis.h"
#include "scene/uniform_damping.h"
#include "stability/stable_time_step.h"
#include "support/built_system.h"
#include "support/scaled_structure.h"
#include "system/each_element.h"
#include "system/law_forces.h"

namespace pounding {
namespace inelastic_elements_test {

using interactions::ElementLaw;
using interactions::InelasticElements;
using testing_support::build_system;
using testing_support::BuiltSystem;
using testing_support::DampedStructure;

/// f = K (u - p), so g = -K p, p following u so that sqrt((u - p)^T K (u - p)) stays at most
/// `strength`: an element that is elastic up to there and then flows, known to no room of the
/// program.
class FlowingElement final : public ElementLaw {
 public:
  FlowingElement(const Structure& structure, const Mesh& mesh, int region, double strength)
      : strength_(strength) {
    for_each_element(
        structure, mesh,
        [&](const ElementBlock& block, std::size_t) { return block.region == region; },
        [&](const ElementBlock&, std::size_t, const ElementLayout& layout,
            const stiffness::ElementWork& work) {
          size_ = layout.size();
          const auto* const begin = work.stiffness.data();
          stiffness_.insert(stiffness_.end(), begin, begin + size_ * size_);
        });
    MPI_Allreduce(MPI_IN_PLACE, &size_, 1, MPI_UNSIGNED_LONG, MPI_MAX, mesh.comm);
  }

  std::size_t memory_size() const override { return size_; }
  Response respond(std::size_t element, std::span<const double> displacement,
                   std::span<double> memory, std::span<double> force) const override {
    std::vector<double> elastic(size_);
    const auto stretch = [&] {
      for (std::size_t i = 0; i < size_; ++i) elastic[i] = displacement[i] - memory[i];
    };
    stretch();
    if (const double norm = std::sqrt(product(element, elastic, elastic)); norm > strength_) {
      for (std::size_t i = 0; i < size_; ++i) memory[i] += (1 - strength_ / norm) * elastic[i];
      stretch();
    }
    const double* const k = &stiffness_[element * size_ * size_];
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t j = 0; j < size_; ++j) force[i] -= k[i * size_ + j] * memory[j];
    }
    return {product(element, elastic, memory) / 2, true};
  }

 private:
  /// a . K b.
  double product(std::size_t element, std::span<const double> a, std::span<const double> b) const {
    const double* const k = &stiffness_[element * size_ * size_];
    double sum = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t j = 0; j < size_; ++j) sum += a[i] * k[i * size_ + j] * b[j];
    }
    return sum;
  }

  double strength_;
  std::size_t size_ = 0;
  std::vector<double> stiffness_;  ///< shape (elements, size, size)
};

/// Bricks of three materials on springs, some of scaled mass.
DampedStructure thrown_body(bool uniform) {
  DampedStructure damped = testing_support::scaled_structure(3);
  damped.structure.initial_velocity = {0.4, -0.1, 0.2};
  damped.structure.initial_displacement = {1e-5, 0, 0};
  for (Region& region : damped.structure.regions) {
    if (region.element != ElementType::hex8) continue;
    region.damping.reset();
  }
  if (uniform) {
    damped.structure.damping = {0, 0};
    damped.structure.uniform_damping = fit_uniform_damping(0.04, 1, 200, 5);
  }
  return damped;
}

/// The stepper of such a body.
struct BodyRun {
  BodyRun(bool inelastic, bool uniform, double strength)
      : damped(thrown_body(uniform)),
        built(build_system(damped.mesh, damped.structure)),
        time_step(0.5 *
                  stable_time_step(built.system.damping, built.system.element_frequency_bound *
                                                             std::sqrt(built.system.stiffening()))),
        laws(mark(inelastic, strength)),
        stepper(PETSC_COMM_WORLD, {&built.system, 1}, still, time_step, profile) {
    if (!inelastic) return;
    stepper.add(std::make_unique<InelasticElements>(0, built.mesh, built.system, time_step, laws));
  }
  /// Laws of two of the materials if any, whose dofs the system then knows.
  std::vector<interactions::RegionLaw> mark(bool inelastic, double strength) {
    std::vector<interactions::RegionLaw> found;
    for (std::size_t r = 0; inelastic && r < damped.structure.regions.size(); ++r) {
      const Region& own = damped.structure.regions[r];
      if (own.element != ElementType::hex8 || own.group == "part0") continue;
      const auto region = static_cast<int>(r);
      found.push_back({region, std::make_unique<FlowingElement>(damped.structure, built.mesh,
                                                                region, strength)});
    }
    built.system.inelastic = dofs_of_laws(found, false, built.mesh);
    return found;
  }
  /// The ledger after some steps.
  EnergyLine run(int steps) {
    EnergyLine line;
    std::vector<StructureEnergy> energies(1);
    for (int n = 0; n < steps; ++n) {
      const bool counted = n > 1 && n % 10 == 9;
      stepper.step(false, counted);
      if (!counted) continue;
      line = stepper.energy().line(energies);
      stepper.energy().note(line);
      EXPECT_GE(line.rows[ledger_row("plastic_loss")],
                lost - 1e-12 * stepper.energy().largest_term())
          << n;
      lost = line.rows[ledger_row("plastic_loss")];
    }
    return line;
  }
  double squares() const {
    double sum = 0;
    for (const double u : stepper.state().structures[0].displacement) sum += u * u;
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
    return sum;
  }

  DampedStructure damped;
  BuiltSystem built;
  double time_step;
  double lost = -1;
  std::vector<interactions::RegionLaw> laws;
  Profile profile;
  GroundMotion still{{}, Resampling::linear};
  CdLagrange stepper;
};

TEST(InelasticElements, AreLinearOnesWhileTheyAreElastic) {
  for (const bool uniform : {false, true}) {
    BodyRun linear(false, uniform, 0);
    BodyRun marked(true, uniform, 1e30);
    ASSERT_EQ(linear.time_step, marked.time_step);
    const EnergyLine expected = linear.run(400);
    const EnergyLine line = marked.run(400);
    const auto& u = linear.stepper.state().structures[0].displacement;
    const auto& v = marked.stepper.state().structures[0].displacement;
    const double scale = std::sqrt(linear.squares());
    ASSERT_GT(scale, 1e-5);
    for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(u[i], v[i], 1e-11 * scale) << i;
    const double most = linear.stepper.energy().largest_term();
    EXPECT_NEAR(line.strain, expected.strain, 1e-10 * most);
    EXPECT_NEAR(line.kinetic, expected.kinetic, 1e-10 * most);
    EXPECT_NEAR(line.rows[ledger_row("damping_loss")], expected.rows[ledger_row("damping_loss")],
                1e-10 * most);
    EXPECT_NEAR(line.rows[ledger_row("plastic_loss")], 0, 1e-12 * most);
    EXPECT_LT(marked.stepper.energy().relative_residual(), 1e-12);
  }
}

TEST(InelasticElements, AreAtTheirStiffestForTheStableStep) {
  const BodyRun linear(false, false, 0);
  const BodyRun marked(true, false, 1);
  EXPECT_EQ(linear.built.system.element_frequency_bound,
            marked.built.system.element_frequency_bound);
  const double all = largest_frequency(linear.built.system, linear.built.mesh).omega_max;
  EXPECT_NEAR(largest_frequency(marked.built.system, marked.built.mesh).omega_max / all, 1, 1e-9);
}

TEST(InelasticElements, CloseTheLedgerWhereTheyFlow) {
  for (const bool uniform : {false, true}) {
    BodyRun marked(true, uniform, 2);
    const EnergyLine line = marked.run(600);
    EXPECT_GT(line.rows[ledger_row("plastic_loss")], 0.01 * marked.stepper.energy().largest_term());
    EXPECT_LT(marked.stepper.energy().relative_residual(), 1e-12);
  }
}

TEST(InelasticElements, MoveAlikeOnAnyRanks) {
  constexpr double of_one_rank = 1.3779114879708663e-08;
  BodyRun marked(true, false, 2);
  marked.run(300);
  EXPECT_NEAR(marked.squares(), of_one_rank, 1e-11 * of_one_rank);
}

TEST(InelasticElements, GoOnFromWhatTheySaved) {
  BodyRun whole(true, true, 2);
  whole.run(200);
  SavedState saved;
  whole.stepper.keep(StateKeeper::to(saved));
  BodyRun continued(true, true, 2);
  continued.stepper.keep(StateKeeper::from(saved));
  whole.run(200);
  continued.run(200);
  EXPECT_EQ(whole.squares(), continued.squares());
}

}  // namespace inelastic_elements_test
}  // namespace pounding
