#include "dynamics/structure_step.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "stiffness/stiffness.h"

namespace pounding {
namespace structure_step_test {

constexpr double time_step = 1e-3;
constexpr double round_off = 4e-15;
const std::array<double, 3> ground{0.7, -1.9, 0.4};

/// What a dof is in a system put together for a test.
enum class Kind { translations, six, lone, damped };

/// Nodes of the given kinds in a row, with masses that differ from node to node.
LinearSystem nodes_in_a_row(const std::vector<Kind>& kinds) {
  LinearSystem system;
  system.damping = {0.3, 4e-5};
  system.gravity = {0, 0.1, -9.81};
  std::vector<double> rates;
  for (const Kind kind : kinds) {
    const double mass = 2 + 0.37 * static_cast<double>(system.lumped_mass.size());
    const int count = kind == Kind::six ? 6 : kind == Kind::lone ? 1 : 3;
    for (int c = 0; c < count; ++c) {
      system.lumped_mass.push_back(c < 3 ? mass : 0.1 * mass * c);
      const int direction = kind == Kind::lone ? 1 : c;
      system.direction.push_back(static_cast<std::int8_t>(direction < 3 ? direction : -1));
      rates.push_back(kind == Kind::damped ? 50.0 + c : 0.0);
    }
  }
  for (const double mass : system.lumped_mass) system.inverse_mass.push_back(1 / mass);
  const auto n = static_cast<PetscInt>(rates.size());
  if (std::ranges::find(kinds, Kind::damped) != kinds.end()) {
    MatHandle matrix;
    POUNDING_PETSC(MatCreateSeqAIJ(PETSC_COMM_SELF, n, n, 1, nullptr, matrix.out()));
    for (PetscInt i = 0; i < n; ++i) {
      POUNDING_PETSC(
          MatSetValue(matrix.get(), i, i, rates[static_cast<std::size_t>(i)], INSERT_VALUES));
    }
    POUNDING_PETSC(MatAssemblyBegin(matrix.get(), MAT_FINAL_ASSEMBLY));
    POUNDING_PETSC(MatAssemblyEnd(matrix.get(), MAT_FINAL_ASSEMBLY));
    system.extra_damping = std::make_unique<stiffness::AssembledStiffness>(std::move(matrix));
  }
  return system;
}

LinearSystem coordinates(std::size_t count) {
  LinearSystem system;
  system.damping = {0.3, 4e-5};
  system.gravity = {0, 0.1, -9.81};
  system.generalised = std::make_unique<GeneralisedCoordinates>();
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<double>(i);
    system.lumped_mass.push_back(1 + 0.01 * x);
    system.inverse_mass.push_back(1 / system.lumped_mass.back());
    system.generalised->influence[0].push_back(std::cos(x));
    system.generalised->influence[1].push_back(std::sin(2 * x));
    system.generalised->influence[2].push_back(1 / (1 + x));
  }
  return system;
}

/// The same system with uniform damping in place of Rayleigh's.
LinearSystem filtered(LinearSystem system, int filters = 3) {
  system.damping = {};
  system.uniform_damping = fit_uniform_damping(0.05, 1, 100, filters);
  system.uniform_damping->reference = 2;
  return system;
}

std::vector<double> random_values(std::size_t count, unsigned seed, double size) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<double> values(count);
  for (double& value : values) value = uniform(generator);
  return values;
}

/// A step of a system whose stiffness is not asked for: q and K v- are random.
struct Case {
  LinearSystem system;
  StructureState state;
  std::vector<double> force;
  std::vector<double> stiffness_velocity;
  bool first = false;

  explicit Case(LinearSystem given, bool is_first = false)
      : system(std::move(given)), first(is_first) {
    const std::size_t n = system.lumped_mass.size();
    state = {random_values(n, 1, 1e-2), random_values(n, 2, 0.5), {}};
    stiffness_velocity = random_values(n, 3, 1e6);
    if (system.extra_damping) state.extra_force = random_values(n, 4, 30);
    if (!system.inelastic.empty()) state.inelastic_force = random_values(n, 20, 1e4);
    for (std::size_t i = 0; i < system.inelastic.size(); ++i) {
      if (system.inelastic[i] == 0) state.inelastic_force[i] = 0;
    }
    if (system.uniform_damping) {
      for (unsigned k = 0; k < system.uniform_damping->filters.size(); ++k) {
        state.filtered.push_back(random_values(n, 6 + k, 1e4));
      }
    }
    force = random_values(n, 5, 1e4);
  }
  double duration() const { return first ? time_step / 2 : time_step; }
};

/// Of K u and of inelastic elements.
double resisting_force(const Case& given, std::size_t i) {
  return given.force[i] +
         (given.state.inelastic_force.empty() ? 0 : given.state.inelastic_force[i]);
}

/// f of uniform damping at a dof, the memories of its filters brought one step on: the trapezoidal
/// rule for dW/dt = omega (Q - W), of which a memory holds all but the last Q.
double reference_force(const Case& given, std::size_t i, StructureState& state) {
  const double q = resisting_force(given, i);
  if (!given.system.uniform_damping) return q;
  const UniformDamping& damping = *given.system.uniform_damping;
  double f = q;
  for (std::size_t k = 0; k < damping.filters.size(); ++k) {
    const auto& [weight, rate] = damping.filters[k];
    double& memory = state.filtered[k][i];
    const double c = time_step * rate / 2;
    const double w = memory + c / (1 + c) * q;
    memory = (w + c * (q - w)) / (1 + c);
    f += weight * (q - w);
  }
  return damping.at_rest() * f;
}

/// The scheme of cd_lagrange.h in ten lines, dof by dof, and its sums.
StepSums take_reference_step(const Case& given, StructureState& state) {
  const LinearSystem& system = given.system;
  StepSums sums;
  for (std::size_t i = 0; i < state.velocity.size(); ++i) {
    const double u = state.displacement[i], v = state.velocity[i], m = system.lumped_mass[i];
    const double x = state.extra_force.empty() ? 0 : state.extra_force[i];
    double ground_rate = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      ground_rate += system.influence(static_cast<int>(d))[i] * (ground[d] - system.gravity[d]);
    }
    const double f = reference_force(given, i, state);
    const double rate = (f + x) / m + system.damping.alpha * v + ground_rate;
    const double after = v - given.duration() * rate;
    const double stiffness_velocity = given.stiffness_velocity[i];
    const double now = given.force[i] - system.damping.beta * stiffness_velocity;  // K u_n
    sums.kinetic_before += m * v * v;
    sums.strain_before += u * (now - time_step * stiffness_velocity);
    sums.strain_back += (u - time_step * v) * now;
    sums.displacement_mass += m * u * u;
    sums.stiffness_before += v * stiffness_velocity;
    sums.stiffness_work += given.force[i] * (after + v);
    sums.mass_sum += m * (after + v) * (after + v);
    sums.device += x * (after + v);
    sums.filtered += (f - resisting_force(given, i)) * (after + v);
    for (std::size_t d = 0; d < 3; ++d) {
      sums.momentum[d] += system.influence(static_cast<int>(d))[i] * m * (after + v);
    }
    state.velocity[i] = after;
    state.displacement[i] = u + time_step * after;
  }
  return sums;
}

/// `pieces`: dofs per range in which the forces are handed over; 0: all at once.
StepSums take_step(Case& given, std::size_t pieces, bool with_energies = true) {
  StructureStep<double> step(std::array{&given.system}, given.state, time_step);
  step.begin(given.duration(), ground,
             {with_energies ? given.stiffness_velocity.data() : nullptr, false});
  const std::size_t n = given.force.size();
  const std::size_t length = pieces == 0 ? n : pieces;
  for (std::size_t i = 0; i < n; i += length) {
    step.receive(static_cast<LocalIndex>(i), static_cast<LocalIndex>(std::min(n, i + length)),
                 &given.force[i]);
  }
  step.complete();
  return step.sums(0);
}

void expect_close(double value, double expected, double scale) {
  EXPECT_NEAR(value, expected, round_off * std::max(scale, std::abs(expected)));
}

void expect_reference_step(LinearSystem system, bool first, std::size_t pieces = 0) {
  Case given(std::move(system), first);
  StructureState expected = given.state;
  const StepSums reference = take_reference_step(given, expected);
  const StepSums sums = take_step(given, pieces);
  for (std::size_t i = 0; i < expected.velocity.size(); ++i) {
    expect_close(given.state.velocity[i], expected.velocity[i], 20);
    expect_close(given.state.displacement[i], expected.displacement[i], 0.1);
    for (std::size_t k = 0; k < expected.filtered.size(); ++k) {
      expect_close(given.state.filtered[k][i], expected.filtered[k][i], 1e4);
    }
  }
  const auto n = static_cast<double>(expected.velocity.size());
  expect_close(sums.kinetic_before, reference.kinetic_before, 100 * n);
  expect_close(sums.strain_before, reference.strain_before, 100 * n);
  expect_close(sums.strain_back, reference.strain_back, 100 * n);
  expect_close(sums.displacement_mass, reference.displacement_mass, n);
  expect_close(sums.stiffness_before, reference.stiffness_before, 1e7 * n);
  expect_close(sums.stiffness_work, reference.stiffness_work, 1e5 * n);
  expect_close(sums.mass_sum, reference.mass_sum, 1e3 * n);
  expect_close(sums.device, reference.device, 1e3 * n);
  expect_close(sums.filtered, reference.filtered, 1e5 * n);
  for (std::size_t d = 0; d < 3; ++d) {
    expect_close(sums.momentum[d], reference.momentum[d], 1e3 * n);
  }
}

TEST(StructureStep, MovesNodesOfEveryKindAsTheSchemeDoes) {
  for (int count = 1; count <= 13;
       ++count) {  // vectors of 4 in patterns of 12 dofs, and what is left
    for (const bool first : {false, true}) {
      expect_reference_step(nodes_in_a_row(std::vector<Kind>(count, Kind::translations)), first);
      expect_reference_step(nodes_in_a_row(std::vector<Kind>(count, Kind::six)), first);
      expect_reference_step(nodes_in_a_row(std::vector<Kind>(count, Kind::lone)), first);
      expect_reference_step(nodes_in_a_row(std::vector<Kind>(count, Kind::damped)), first);
      expect_reference_step(coordinates(static_cast<std::size_t>(count)), first);
    }
  }
}

TEST(StructureStep, MovesAMixtureOfNodesAsTheSchemeDoes) {
  const std::vector<Kind> kinds{Kind::translations, Kind::translations, Kind::damped,
                                Kind::six,          Kind::six,          Kind::lone,
                                Kind::translations, Kind::six,          Kind::damped,
                                Kind::damped,       Kind::six,          Kind::translations};
  expect_reference_step(nodes_in_a_row(kinds), false);
  expect_reference_step(nodes_in_a_row(kinds), true);
}

/// Elements with a law of their own hold some dofs of two thirds of the nodes.
LinearSystem yielding(LinearSystem system) {
  for (std::size_t i = 0; i < system.lumped_mass.size(); ++i) {
    system.inelastic.push_back(i % 9 < 4 ? 1 : 0);
  }
  return system;
}

TEST(StructureStep, AddsTheForcesOfInelasticElements) {
  const std::vector<Kind> mixture{Kind::translations, Kind::translations, Kind::damped,
                                  Kind::six,          Kind::lone,         Kind::translations,
                                  Kind::translations, Kind::six,          Kind::six};
  for (const bool first : {false, true}) {
    for (const std::size_t pieces : {0, 3}) {
      for (int count = 1; count <= 13; ++count) {
        for (const Kind kind : {Kind::translations, Kind::lone, Kind::damped}) {
          expect_reference_step(yielding(nodes_in_a_row(std::vector<Kind>(count, kind))), first,
                                pieces);
          expect_reference_step(filtered(yielding(nodes_in_a_row(std::vector<Kind>(count, kind)))),
                                first, pieces);
        }
      }
    }
    expect_reference_step(yielding(nodes_in_a_row(mixture)), first);
    expect_reference_step(filtered(yielding(nodes_in_a_row(mixture))), first);
    for (int count = 1; count <= 13; ++count) {
      expect_reference_step(yielding(nodes_in_a_row(std::vector<Kind>(count, Kind::six))), first);
    }
  }
}

TEST(StructureStep, FiltersTheForceOfDofsOfEveryKind) {
  const std::vector<Kind> mixture{Kind::translations, Kind::damped, Kind::six, Kind::lone,
                                  Kind::translations, Kind::six,    Kind::six};
  for (const bool first : {false, true}) {
    for (const int filters : {1, 3, 8}) {
      for (int count = 1; count <= 5; ++count) {
        for (const Kind kind : {Kind::translations, Kind::six, Kind::lone, Kind::damped}) {
          expect_reference_step(filtered(nodes_in_a_row(std::vector<Kind>(count, kind)), filters),
                                first);
        }
        expect_reference_step(filtered(coordinates(count), filters), first);
      }
      expect_reference_step(filtered(nodes_in_a_row(mixture), filters), first);
    }
  }
}

TEST(StructureStep, FiltersOfAStructureAtRestPassItsForceAsItIs) {
  Case given(filtered(nodes_in_a_row(std::vector<Kind>(5, Kind::translations))), true);
  const UniformDamping& damping = *given.system.uniform_damping;
  for (std::size_t k = 0; k < 3; ++k) {
    const double c = time_step * damping.filters[k].rate / 2;
    for (std::size_t i = 0; i < given.force.size(); ++i) {
      given.state.filtered[k][i] = given.force[i] / (1 + c);
    }
  }
  const std::vector<double> before = given.state.velocity;
  take_step(given, 0);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double load = ground[i % 3] - given.system.gravity[i % 3];
    const double force = damping.at_rest() * given.force[i] * given.system.inverse_mass[i];
    expect_close(given.state.velocity[i], before[i] - time_step / 2 * (force + load), 20);
  }
}

TEST(StructureStep, DoesNotDependOnTheRangesInWhichForcesCome) {
  for (const Kind kind : {Kind::translations, Kind::six}) {
    const std::size_t node = kind == Kind::six ? 6 : 3;
    Case whole(nodes_in_a_row(std::vector<Kind>(40, kind)));
    take_step(whole, 0);
    for (const std::size_t nodes : {1, 3, 4, 7}) {
      Case parts(nodes_in_a_row(std::vector<Kind>(40, kind)));
      take_step(parts, nodes * node);
      EXPECT_EQ(parts.state.velocity, whole.state.velocity);
      EXPECT_EQ(parts.state.displacement, whole.state.displacement);
    }
  }
}

TEST(StructureStep, MovesTheSameWithoutEnergies) {
  Case with(nodes_in_a_row(std::vector<Kind>(9, Kind::six)));
  Case without(nodes_in_a_row(std::vector<Kind>(9, Kind::six)));
  const StepSums all = take_step(with, 0, true);
  const StepSums fewer = take_step(without, 0, false);
  EXPECT_EQ(with.state.velocity, without.state.velocity);
  EXPECT_EQ(all.mass_sum, fewer.mass_sum);
  EXPECT_GT(all.kinetic_before, 0);
  EXPECT_EQ(fewer.kinetic_before, 0);
}

/// Eight runs that differ in their ground's motion and state, of which member 5 is the case.
void expect_member_of_batch(LinearSystem system) {
  Case alone(std::move(system));
  constexpr std::size_t member = 5;
  const std::size_t n = alone.force.size();
  StateOf<BatchValue> state;
  std::vector<BatchValue> force;
  const auto spread = [&](const std::vector<double>& from, std::vector<BatchValue>& to) {
    to.assign(from.size(), BatchValue{});
    for (std::size_t i = 0; i < from.size(); ++i) {
      for (std::size_t l = 0; l < batch_size; ++l) to[i][l] = from[i] * (l == member ? 1 : 1.7);
    }
  };
  spread(alone.state.displacement, state.displacement);
  spread(alone.state.velocity, state.velocity);
  spread(alone.state.extra_force, state.extra_force);
  spread(alone.state.inelastic_force, state.inelastic_force);
  for (const auto& memory : alone.state.filtered) spread(memory, state.filtered.emplace_back());
  spread(alone.force, force);
  std::array<BatchValue, 3> accelerations{};
  for (std::size_t d = 0; d < 3; ++d) {
    for (std::size_t l = 0; l < batch_size; ++l) accelerations[d][l] = l == member ? ground[d] : 9;
  }
  const std::vector<const LinearSystem*> systems(batch_size, &alone.system);
  StructureStep<BatchValue> step(systems, state, time_step);
  step.begin(time_step, accelerations, {});
  step.receive(0, static_cast<LocalIndex>(n), force.data());
  step.complete();
  const StepSums expected = take_step(alone, 0, false);
  const StepSums sums = step.sums(member);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(state.velocity[i][member], alone.state.velocity[i]);
    EXPECT_EQ(state.displacement[i][member], alone.state.displacement[i]);
  }
  expect_close(sums.mass_sum, expected.mass_sum, 1e3);
  expect_close(sums.stiffness_work, expected.stiffness_work, 1e5);
  expect_close(sums.filtered, expected.filtered, 1e5);
  expect_close(sums.device, expected.device, 1e3);
  for (std::size_t d = 0; d < 3; ++d) expect_close(sums.momentum[d], expected.momentum[d], 1e3);
}

TEST(StructureStep, RoundsAMemberOfABatchLikeARunByItself) {
  const std::vector<Kind> mixture{Kind::translations, Kind::translations, Kind::damped,
                                  Kind::six,          Kind::lone,         Kind::translations};
  const std::vector<Kind> plain(5, Kind::translations);
  expect_member_of_batch(nodes_in_a_row(plain));
  expect_member_of_batch(yielding(nodes_in_a_row(mixture)));
  expect_member_of_batch(filtered(yielding(nodes_in_a_row(mixture))));
  expect_member_of_batch(coordinates(7));
  expect_member_of_batch(filtered(coordinates(7)));
}

void expect_coupled_step(LinearSystem system) {
  NodeBlocks added;
  added.nodes = {{0, 6}, {6, 6}};
  NodeBlock diagonal{}, beside{};
  for (std::size_t c = 0; c < 6; ++c) {
    diagonal[7 * c] = 5;
    beside[7 * c] = -5;
  }
  added.blocks = {{{0, 0}, diagonal}, {{1, 0}, beside}, {{1, 1}, diagonal}};
  system.coupled_mass = std::make_unique<CoupledMass>(system.lumped_mass, added);
  Case given(std::move(system));
  const StructureState before = given.state;
  StructureState uncoupled = given.state;
  take_reference_step(given, uncoupled);
  const StepSums sums = take_step(given, 0);
  double added_kinetic = 0;
  for (std::size_t i = 0; i < 18; ++i) {
    // (M + S) (v+ - v-) = M (v_free - v-), where v_free is that of M alone.
    const auto change = [&](const StructureState& state, std::size_t dof) {
      return state.velocity[dof] - before.velocity[dof];
    };
    const double mass = given.system.lumped_mass[i];
    double impulse = mass * change(given.state, i);
    if (i < 12) {
      const std::size_t other = i < 6 ? i + 6 : i - 6;
      impulse += 5 * (change(given.state, i) - change(given.state, other));
      added_kinetic += 5 * before.velocity[i] * (before.velocity[i] - before.velocity[other]);
    }
    EXPECT_NEAR(impulse, mass * change(uncoupled, i), 1e-12);
    EXPECT_NEAR(given.state.displacement[i],
                before.displacement[i] + time_step * given.state.velocity[i], 1e-16);
  }
  EXPECT_NEAR(sums.added_kinetic_before, added_kinetic, 1e-13);
  double filtered_work = 0;
  StructureState filters = before;
  for (std::size_t i = 0; i < 18; ++i) {
    const double part = reference_force(given, i, filters) - given.force[i];
    filtered_work += part * (before.velocity[i] + given.state.velocity[i]);
  }
  EXPECT_NEAR(sums.filtered, filtered_work, 1e-12 * std::abs(filtered_work));
  EXPECT_EQ(sums.filtered != 0, given.system.uniform_damping.has_value());
}

TEST(StructureStep, SolvesForDofsOfCoupledMass) {
  expect_coupled_step(nodes_in_a_row(std::vector<Kind>(3, Kind::six)));
  expect_coupled_step(filtered(nodes_in_a_row(std::vector<Kind>(3, Kind::six))));
}

void expect_correction(bool with_filters) {
  const auto make = [&] {
    LinearSystem system = nodes_in_a_row({Kind::translations, Kind::damped, Kind::six});
    return Case(with_filters ? filtered(std::move(system)) : std::move(system));
  };
  Case given = make();
  const std::vector<LocalIndex> dofs{1, 4, 7};
  StructureState expected = given.state;
  StructureStep<double> step(std::array{&given.system}, given.state, time_step);
  interactions::Before before(dofs.size());
  step.watch(dofs, false);
  step.remember(0, dofs, before);
  step.begin(time_step, ground, {given.stiffness_velocity.data(), true});
  step.receive(6, 12, &given.force[6]);
  step.receive(0, 6, given.force.data());
  step.complete();
  std::vector<double> velocity;
  for (const LocalIndex dof : dofs) {
    velocity.push_back(given.state.velocity[static_cast<std::size_t>(dof)] + 0.25);
  }
  step.correct(0, dofs, before, velocity);
  // The reference: the forces that lead to these velocities act beside q.
  Case pushed = make();
  StructureState plain = expected;
  StepSums reference = take_reference_step(pushed, plain);
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    const auto i = static_cast<std::size_t>(dofs[k]);
    const double m = given.system.lumped_mass[i];
    const double free = plain.velocity[i], v = expected.velocity[i];
    const double after = free + 0.25;
    reference.mass_sum += m * ((after + v) * (after + v) - (free + v) * (free + v));
    reference.stiffness_work += 0.25 * given.force[i];
    reference.device += given.state.extra_force[i] * 0.25;
    StructureState filters = expected;
    const double acting = reference_force(pushed, i, filters);
    reference.filtered += 0.25 * (acting - given.force[i]);
    EXPECT_EQ(step.forces().at(dofs[k]).stiffness, given.force[i]);
    EXPECT_NEAR(step.forces().at(dofs[k]).acting, acting, 1e-11);
    reference.momentum[static_cast<std::size_t>(given.system.direction[i])] += m * 0.25;
    EXPECT_NEAR(given.state.velocity[i], after, 1e-13);
    EXPECT_NEAR(given.state.displacement[i], expected.displacement[i] + time_step * after, 1e-15);
  }
  const StepSums sums = step.sums(0);
  EXPECT_NEAR(sums.mass_sum, reference.mass_sum, 1e-10 * std::abs(reference.mass_sum));
  EXPECT_NEAR(sums.stiffness_work, reference.stiffness_work,
              1e-10 * std::abs(reference.stiffness_work));
  EXPECT_NEAR(sums.device, reference.device, 1e-10 * std::abs(reference.device));
  EXPECT_NEAR(sums.filtered, reference.filtered, 1e-10 * std::abs(reference.filtered));
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(sums.momentum[d], reference.momentum[d], 1e-9);
  }
}

TEST(StructureStep, CorrectsSumsAndStateForAnotherVelocity) {
  expect_correction(false);
  expect_correction(true);
}

}  // namespace structure_step_test
}  // namespace pounding
