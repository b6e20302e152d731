#include "ensemble/member_scene.h"

#include <algorithm>
#include <limits>

#include "common/error.h"
#include "dynamics/batch_step.h"
#include "modal/reduced_system.h"
#include "model/start_at_rest.h"
#include "model/time_step.h"
#include "scene/law_kinds.h"
#include "scene/stiffness_factor.h"
#include "scene/support_reader.h"
#include "stability/stable_time_step.h"
#include "stiffness/element_stiffness.h"
#include "system/load_shapes.h"

namespace pounding {
namespace {

void refuse_scene_if(bool wrong, const std::string& what, const std::string& remedy) {
  refuse_if(wrong, "option -ensemble: " + what + "; " + remedy);
}

/// Elements have the numbers of all members: no factor on their stiffness, nor on damping that
/// others than the whole structure have.
void require_shared_elements(const Structure& structure, const MemberTable& table) {
  const auto refuse_column = [&](const char* option, const char* why) {
    const std::string column = structure.name + option;
    if (std::ranges::count(table.columns, column) == 0) return;
    throw UserError("column " + column + ": structure " + structure.name + " is at full order" +
                    why +
                    "; make an ensemble for each factor, which its scene gives, or single runs");
  };
  refuse_column("_stiffness_factor", ", and its elements are those of all members");
  const bool own = std::ranges::any_of(structure.regions, [](const Region& region) {
    return region.damping || region.damping_factor != 1 || follows_law(region);
  });
  if (own) refuse_column("_damping_factor", ", and some of its groups are damped by themselves");
}

/// Springs and dashpots of waves make up for the damping that their structure gives them.
void require_shared_waves(const Structure& structure, const MemberTable& table) {
  const std::string column = structure.name + "_damping_factor";
  const bool braked = structure.uniform_damping || (!structure.modal && structure.damping.beta > 0);
  if (!braked || std::ranges::count(table.columns, column) == 0 ||
      !std::ranges::any_of(structure.pools, &Pool::is_tank)) {
    return;
  }
  throw UserError("column " + column + ": springs and dashpots of the waves of structure " +
                  structure.name +
                  " make up for its damping; make an ensemble for each factor, which its scene "
                  "gives, or single runs");
}

/// Modes that a factor on the stiffness of the elements would turn are not those of all members.
void require_shared_modes(const Scene& scene, const MemberTable& table) {
  for (const Structure& structure : scene.structures) {
    if (!structure.modal) require_shared_elements(structure, table);
    require_shared_waves(structure, table);
    const std::string column = structure.name + "_stiffness_factor";
    if (structure.scales_as_a_whole() || std::ranges::count(table.columns, column) == 0) continue;
    throw UserError(
        "column " + column + ": the modes of structure " + structure.name + " hold its " +
        (structure.soil      ? "soil"
         : structure.p_delta ? "forces at rest (p_delta)"
                             : "waves") +
        " as well; make an ensemble for each factor, which its scene gives, or single runs");
  }
}

/// The columns of the supports' motion are those of all members.
void require_same_columns(const Scene& scene, const Scene& member) {
  for (std::size_t s = 0; s < scene.supports.size(); ++s) {
    for (std::size_t c = 0; c < 6; ++c) {
      const std::size_t axis = axis_of_motion(c);
      const bool moves = moves_otherwise(member.supports[s], c, member.motion[axis].has_value());
      if (moves == moves_otherwise(scene.supports[s], c, scene.motion[axis].has_value())) continue;
      throw UserError("support " + scene.supports[s].name + " has a motion of its own (" +
                      std::string(motion_names[c]) + ") " +
                      (moves ? "here and not in the scene" : "in the scene and not here") +
                      "; give the scene and every member one, or none");
    }
  }
}

/// System of a structure of a member at full order, which has the operators of all.
LinearSystem full_system(const Structure& structure, const LinearSystem& shared) {
  LinearSystem system = shared;
  system.damping = structure.damping;
  if (system.uniform_damping) {
    const double reference = system.uniform_damping->reference;
    system.uniform_damping = structure.uniform_damping;
    system.uniform_damping->reference = reference;
  }
  return system;
}

/// Limits of the time step of a structure at full order; `shared`: that of the ensemble's scene.
StructureLimits full_limits(const LinearSystem& system, const Building& shared) {
  if (system.has_extra_damping()) return shared.limits;
  const LargestFrequency& largest = shared.limits.largest;
  return {largest, stable_time_step(system.damping, largest.omega_max, system.stiffening())};
}

/// Part of a member's model without motion: systems and limits of its structures, gaps.
Model member_structures(const MemberScene& member, const EnsembleModel& shared) {
  const Scene& scene = member.scene;
  Model model;
  model.interface.constraints = shared.model->interface.constraints;
  model.interface.watched = shared.model->interface.watched;
  model.interface.soil = shared.model->interface.soil;
  model.interface.model_size = shared.model->interface.model_size;
  model.forces = shared.model->forces;
  const std::vector<interactions::GivenGap> gaps(scene.contacts.begin(), scene.contacts.end());
  for (auto* const rows : {&model.interface.constraints, &model.interface.watched}) {
    for (interactions::Constraint& row : *rows) set_gap(scene, gaps, row);
  }
  model.time_step = shared.model->time_step;
  model.steps = shared.model->steps;
  model.buildings.resize(shared.bases.size());
  model.systems.resize(shared.bases.size());
  for (std::size_t s = 0; s < shared.bases.size(); ++s) {
    const Structure& structure = scene.structures[s];
    Building& building = model.buildings[s];
    building.structure = &structure;
    building.mesh = &shared.model->meshes[s];
    building.system = &model.systems[s];
    if (shared.bases[s]) {
      building.basis = shared.bases[s];
      scale_stiffness(member.stiffness_factors[s], *building.basis);
      model.systems[s] = build_reduced_system(MPI_COMM_SELF, 0, structure, *building.mesh,
                                              *building.basis, shared.model->support_columns());
      model.systems[s].loads = shape_reduced_loads(shared.model->scene_loads(), static_cast<int>(s),
                                                   building.basis->load_parts, true);
      model.systems[s].start =
          shape_reduced_start(building.basis->start_parts, model.systems[s].lumped_mass, true);
      building.limits =
          limits_of(structure, model.systems[s], *building.mesh, building.basis_or_null(), {});
    } else {
      const Building& common = shared.model->buildings[s];
      model.systems[s] = full_system(structure, shared.model->systems[s]);
      building.modal = common.modal;
      building.limits = full_limits(model.systems[s], common);
    }
    building.energy_margin =
        energy_margin_of(structure, model.systems[s], *building.mesh, building.basis_or_null(),
                         building.limits, model.time_step, {});
  }
  return model;
}

}  // namespace

void require_ensemble_scene(const Scene& scene) {
  for (const Contact& contact : scene.contacts) {
    refuse_scene_if(contact.sliding != 0,
                    "the pairs of contact " + contact.name + " are found anew",
                    "leave -" + contact.name + "_sliding out");
  }
  for (const ForceItem& force : scene.forces) {
    refuse_scene_if(force.of_elements(), "forces " + force.name + " are those of elements",
                    "leave them out of -forces: members keep reactions, storeys and cuts");
  }
  refuse_scene_if(!scene.equipment.empty(), "equipment is set beside its floors' spectra",
                  "give -equipment none");
  refuse_scene_if(scene.certificate.window > 0, "-fidelity_window is about single runs",
                  "leave it out");
  refuse_scene_if(!scene.loops.empty(), "loops are recorded", "give -loops none");
  refuse_scene_if(scene.fields_interval > 0, "fields are written", "give -fields_interval 0");
  refuse_scene_if(!scene.restart.empty(), "-restart continues single runs",
                  "leave it out: an ensemble goes on by itself in its folder");
  refuse_scene_if(scene.probes.empty(), "there is nothing to record", "give -probes");
  refuse_scene_if(scene.allow_unstable, "-allow_unstable is for single runs", "leave it out");
}

MemberScene read_member(const Scene& shared, const OptionsDatabase& scene, const MemberTable& table,
                        std::size_t member) {
  try {
    ReadScene read = read_scene(member_options(scene, table, member));
    require_shared_modes(read.scene, table);
    require_same_columns(shared, read.scene);
    for (std::size_t s = 0; s < read.stiffness_factors.size(); ++s) {
      scale_stiffness(read.stiffness_factors[s], read.scene.structures[s]);
    }
    read.scene.progress_interval = std::numeric_limits<double>::infinity();
    read.scene.keeps_matrices = true;
    return {table.place(member), std::move(read.scene), std::move(read.stiffness_factors)};
  } catch (const UserError& error) {
    throw UserError(table.place(member) + error.what());
  }
}

bool EnsembleModel::steps_alone(std::size_t structure) const {
  const LinearSystem& system = model->systems[structure];
  if (system.generalised) return false;
  if (system.mass_is_coupled() || system.has_extra_damping() || !system.laws.empty()) return true;
  const auto* const product =
      dynamic_cast<const stiffness::ElementStiffness*>(system.stiffness.get());
  if (product == nullptr) return true;
  const stiffness::ElementKinds& kinds = product->kinds();
  return kinds.bricks + kinds.rectangles > kinds.general + kinds.beams + kinds.other;
}

void EnsembleModel::multiply_together() {
  elements.resize(bases.size());
  for (std::size_t s = 0; s < elements.size(); ++s) {
    if (bases[s] || steps_alone(s)) continue;
    const Building& building = model->buildings[s];
    elements[s] =
        std::make_unique<stiffness::BatchStiffness>(building.full_order(), *building.mesh);
  }
}

double EnsembleModel::memory() const {
  double bytes = 0;
  for (std::size_t s = 0; s < bases.size(); ++s) {
    if (bases[s]) continue;
    bytes += BatchStep::memory_per_dof(model->systems[s]) * model->systems[s].owned_dofs();
    if (!steps_alone(s)) bytes += stiffness::BatchStiffness::memory(model->meshes[s]);
  }
  return bytes;
}

void lay_foundations(const Scene& scene, MemberScene& member) {
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    const std::vector<Region>& regions = scene.structures[s].regions;
    for (std::size_t r = 0; r < regions.size(); ++r) {
      if (!regions[r].foundation && !regions[r].of_water) continue;
      member.scene.structures[s].regions[r] = regions[r];
    }
  }
}

StepLimits member_limits(const MemberScene& member, const EnsembleModel& shared) {
  const Scene& scene = member.scene;
  const double last = scene.spectra.frequencies.back();
  StepLimits limits;
  for (std::size_t s = 0; s < shared.bases.size(); ++s) {
    if (!shared.bases[s]) {
      const Building& common = shared.model->buildings[s];
      const LinearSystem system = full_system(scene.structures[s], shared.model->systems[s]);
      limits.stable = std::min(limits.stable, full_limits(system, common).stable_time_step);
      limits.resolved = faster(limits.resolved, resolved_motion_of(common, last));
      continue;
    }
    ModalBasis basis = *shared.bases[s];
    scale_stiffness(member.stiffness_factors[s], basis);
    limits.stable = std::min(limits.stable, stable_time_step(scene.structures[s], basis));
    limits.resolved = faster(limits.resolved, resolved_motion_of(scene.structures[s], basis, last));
  }
  if (interactions::has_fillers(shared.model->interface) || !shared.model->interface.soil.empty()) {
    limit_by_fillers(
        filler_limit(MPI_COMM_SELF, scene, member_structures(member, shared), shared.model->meshes),
        last, limits);
  }
  limit_by_loads(scene, shared.model->load_histories.get(), limits);
  return limits;
}

double set_gap(const Scene& scene, std::span<const interactions::GivenGap> gaps,
               interactions::Constraint& row) {
  const Contact& contact = scene.contacts[row.contact];
  const double gap = gaps[row.contact].of(row);
  row.initial_gap = gap;
  if (contact.filler || contact.is_elastic()) interactions::fill_joint(contact, row);
  return gap;
}

Model member_model(const MemberScene& member, const EnsembleModel& shared) {
  const Scene& scene = member.scene;
  try {
    Model model = member_structures(member, shared);
    read_histories(scene, model);
    Profile profile;
    put_at_rest(MPI_COMM_SELF, scene, shared.model->meshes, profile, model);
    find_start_gaps(scene, model);
    return model;
  } catch (const UserError& error) {
    throw UserError(member.place + error.what());
  }
}

}  // namespace pounding
