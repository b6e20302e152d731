#include "system/load_shapes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "common/error.h"
#include "common/parallel.h"
#include "system/admissible_motions.h"

namespace pounding {
namespace {

/// Loads of a structure with the forces that `fill` gives them; null if there is none.
template <typename Fill>
std::shared_ptr<const LoadShapes> make_shapes(const SceneLoads& loads, int s, Fill&& fill) {
  auto shapes = std::make_shared<LoadShapes>();
  for (std::size_t l = 0; l < loads.nodal.size(); ++l) {
    if (loads.nodal[l].structure != s) continue;
    LoadShape& shape = shapes->loads.emplace_back();
    shape.load = l;
    shape.before_start = loads.before_start[l];
    shape.total_force = loads.nodal[l].force;
    fill(loads.nodal[l], shape);
  }
  return shapes->loads.empty() ? nullptr : shapes;
}

/// Part of the largest value by which a start may miss a motion that a rigid body admits.
constexpr double off_body = 1e-9;

std::vector<double> start_field(const Vector3& of_all, const std::vector<NodalValue>& of_some,
                                const LinearSystem& system, const Mesh& mesh) {
  std::vector<double> field(system.lumped_mass.size(), 0.0);
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (system.direction[i] >= 0) field[i] = of_all[static_cast<std::size_t>(system.direction[i])];
  }
  for (const NodalValue& value : of_some) {
    const LocalIndex dof = mesh.owned_dof(value.node, value.component);
    if (dof >= 0) field[static_cast<std::size_t>(dof)] = value.value;
  }
  return field;
}

/// Largest difference from the motion that rigid bodies and ties make of a field, over its largest
/// value, on all ranks.
double distance_from_admissible(const AdmissibleMotions& admissible, const LinearSystem& system,
                                const std::vector<double>& field) {
  std::vector<double> admitted = field;
  admissible.to_coordinates(admitted);
  admissible.to_motion(admitted);
  std::array<double, 2> largest{0, 0};
  for (std::size_t i = 0; i < field.size(); ++i) {
    largest[0] = std::max(largest[0], std::abs(admitted[i] - field[i]));
    largest[1] = std::max(largest[1], std::abs(field[i]));
  }
  reduce_over_ranks(system.comm, MPI_MAX, largest);
  return largest[1] > 0 ? largest[0] / largest[1] : 0;
}

}  // namespace

void LoadShapes::add_at_rest(std::vector<double>& force) const {
  for (const LoadShape& shape : loads) {
    for (std::size_t k = 0; k < shape.dofs.size(); ++k) {
      force[static_cast<std::size_t>(shape.dofs[k])] += shape.before_start * shape.force[k];
    }
  }
}

Vector3 LoadShapes::total_at_rest() const {
  Vector3 total{0, 0, 0};
  for (const LoadShape& shape : loads) {
    for (std::size_t d = 0; d < 3; ++d) total[d] += shape.before_start * shape.total_force[d];
  }
  return total;
}

std::shared_ptr<const LoadShapes> shape_loads(const SceneLoads& loads, int s, const Mesh& mesh) {
  return make_shapes(loads, s, [&](const NodalLoad& load, LoadShape& shape) {
    std::vector<std::pair<LocalIndex, double>> here;
    for (const NodalValue& force : load.forces) {
      const LocalIndex dof = mesh.owned_dof(force.node, force.component);
      if (dof >= 0) here.emplace_back(dof, force.value);
    }
    std::ranges::sort(here);
    for (const auto& [dof, value] : here) {
      shape.dofs.push_back(dof);
      shape.force.push_back(value);
    }
  });
}

std::shared_ptr<const LoadShapes> shape_reduced_loads(const SceneLoads& loads, int s,
                                                      std::span<const double> parts, bool owner) {
  const auto count = std::ranges::count(loads.nodal, s, &NodalLoad::structure);
  const std::size_t size = count == 0 ? 0 : parts.size() / static_cast<std::size_t>(count);
  std::size_t first = 0;
  return make_shapes(loads, s, [&](const NodalLoad& /*load*/, LoadShape& shape) {
    if (!owner) return;
    const std::span<const double> own = parts.subspan(first, size);
    shape.force.assign(own.begin(), own.end());
    shape.dofs.resize(size);
    std::iota(shape.dofs.begin(), shape.dofs.end(), LocalIndex{0});
    first += size;
  });
}

std::shared_ptr<const StartState> shape_start(const NodalStart& start, const LinearSystem& system,
                                              const Mesh& mesh) {
  if (start.empty()) return nullptr;
  auto state = std::make_shared<StartState>();
  state->displacement = start_field(system.initial_displacement, start.displacement, system, mesh);
  state->velocity = start_field(system.initial_velocity, start.velocity, system, mesh);
  if (system.rigid_bodies.empty()) return state;
  const AdmissibleMotions admissible(system, AdmissibleMotions::Alone::as_is);
  for (const std::vector<double>* field : {&state->displacement, &state->velocity}) {
    if (distance_from_admissible(admissible, system, *field) <= off_body) continue;
    throw UserError("structure " + system.name +
                    ": nodes of a rigid group or a tie are to start otherwise than it moves; look "
                    "at -" +
                    system.name + "_initial_state and the initial_velocity of its groups");
  }
  return state;
}

std::shared_ptr<const StartState> shape_reduced_start(std::span<const double> parts,
                                                      std::span<const double> masses, bool owner) {
  if (parts.empty()) return nullptr;
  auto state = std::make_shared<StartState>();
  const std::size_t size = parts.size() / 2;
  for (std::size_t i = 0; owner && i < size; ++i) {
    state->displacement.push_back(parts[i] / masses[i]);
    state->velocity.push_back(parts[size + i] / masses[i]);
  }
  return state;
}

}  // namespace pounding
