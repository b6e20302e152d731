#include "dynamics/state.h"

#include <string>

#include "common/memory.h"
#include "common/parallel.h"
#include "system/load_shapes.h"

namespace pounding {
namespace {

/// Times that a motion of dofs without mass is renewed, a twentieth of the change being left.
constexpr int renewals = 12;

/// Brings dofs without mass to where they are at rest between the others: S v = 0 in their rows,
/// by (M + S) v = M v_before there, M being lent.
template <typename Field>
void let_follow(const LinearSystem& system, Field& field) {
  if (system.condensed.empty() || !system.coupled_mass) return;
  const CoupledMass& mass = *system.coupled_mass;
  std::vector<double> momentum(field.size());
  std::vector<double> x(mass.field_size());
  for (int i = 0; i < renewals; ++i) {
    for (std::size_t k = 0; k < field.size(); ++k) momentum[k] = system.lumped_mass[k] * field[k];
    mass.take(momentum.data(), x.data());
    mass.solve(x.data());
    mass.put(x.data(), momentum.data());
    for (const LocalIndex dof : system.condensed) field[dof] = momentum[dof];
  }
}

}  // namespace

StateVectors::StateVectors(const LinearSystem& system, StructureState& state)
    : displacement_(wrap_vector(system, state.displacement)),
      velocity_(wrap_vector(system, state.velocity)) {
  const auto name = [&](const VecHandle& vector, const char* what) {
    POUNDING_PETSC(PetscObjectSetName(reinterpret_cast<PetscObject>(vector.get()),
                                      (system.name + " " + what).c_str()));
  };
  name(displacement_, "displacement");
  name(velocity_, "velocity");
}

Vec StateVectors::renewed(Vec vector) {
  double* values = nullptr;
  POUNDING_PETSC(VecGetArrayWrite(vector, &values));
  POUNDING_PETSC(VecRestoreArrayWrite(vector, &values));
  return vector;
}

State::State(std::span<const LinearSystem> systems, std::size_t support_columns)
    : supports{std::vector<double>(support_columns, 0.0),
               std::vector<double>(support_columns, 0.0)} {
  for (const LinearSystem& system : systems) {
    const std::size_t dofs = system.lumped_mass.size();
    const std::vector<double> extra_force(system.has_extra_damping() ? dofs : 0, 0.0);
    const std::vector<double> inelastic_force(system.inelastic.size(), 0.0);
    structures.push_back(
        {zeros_on_large_pages(dofs), zeros_on_large_pages(dofs), extra_force, inelastic_force});
    StructureState& structure = structures.back();
    if (system.uniform_damping) {
      const std::size_t held = any_damped_about_rest(system) ? 1 : 0;
      for (std::size_t i = 0; i < system.uniform_damping->filters.size() + held; ++i) {
        structure.filtered.push_back(zeros_on_large_pages(dofs));
      }
    }
    for (std::size_t i = 0; system.start && i < dofs; ++i) {
      structure.displacement[i] += system.start->displacement[i];
      structure.velocity[i] += system.start->velocity[i];
    }
    for (std::size_t d = 0; !system.start && d < 3; ++d) {
      const std::vector<double> iota = system.influence(static_cast<int>(d));
      for (std::size_t i = 0; i < iota.size(); ++i) {
        structure.displacement[i] += iota[i] * system.initial_displacement[d];
        structure.velocity[i] += iota[i] * system.initial_velocity[d];
      }
    }
    let_follow(system, structure.displacement);
    let_follow(system, structure.velocity);
    for (std::size_t i = 0; i < system.rest_displacement.size(); ++i) {
      structure.displacement[i] += system.rest_displacement[i];
    }
  }
}

void State::keep(const StateKeeper& state) {
  std::int64_t made = step - 1;  // the last one
  state.numbers("step", made);
  step = made + 1;
  if (!supports.displacement.empty()) {
    state.table("support_displacement", supports.displacement);
    state.table("support_velocity", supports.velocity);
  }
  for (std::size_t s = 0; s < structures.size(); ++s) {
    state.dofs(s, "displacement", structures[s].displacement);
    state.dofs(s, "velocity", structures[s].velocity);
    for (std::size_t i = 0; i < structures[s].filtered.size(); ++i) {
      state.dofs(s, "filter_" + std::to_string(i + 1), structures[s].filtered[i]);
    }
  }
}

bool damped_about_rest(const LinearSystem& system) {
  return system.uniform_damping && !system.uniform_damping->filters.empty() &&
         !system.rest_displacement.empty();
}

bool any_damped_about_rest(const LinearSystem& system) {
  return on_any_rank(system.comm, damped_about_rest(system));
}

std::vector<double> stiffness_times(const LinearSystem& system, const std::vector<double>& w) {
  std::vector<double> result(w.size());
  stiffness::StoredForces store(result.data());
  system.stiffness->apply({w.data(), w.data(), 0}, store);
  return result;
}

std::vector<double> rest_forces(const LinearSystem& system) {
  if (!any_damped_about_rest(system)) return {};
  return stiffness_times(system, system.rest_displacement);
}

double rest_work(const std::vector<double>& forces, const LinearSystem& system,
                 const StructureState& state, double time_step) {
  double sum = 0;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const double mean = state.displacement[i] - time_step / 2 * state.velocity[i];
    sum += forces[i] * (system.rest_displacement[i] / 2 - mean);
  }
  return sum;
}

}  // namespace pounding
