#include "ensemble/member_scene.h"

#include <algorithm>
#include <limits>

#include "common/error.h"
#include "driver/time_step.h"
#include "modal/reduced_system.h"
#include "stability/structure_limits.h"

namespace pounding {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& remedy) {
  throw UserError("option -ensemble: " + what + "; " + remedy);
}

void require_reduced(const Structure& structure) {
  const std::string option = "-" + structure.name;
  if (!structure.modal) {
    refuse("structure " + structure.name + " is not reduced",
           "give " + option + "_model modal and " + option +
               "_modal_vectors, or make single runs (run/sweep)");
  }
  const auto law = std::ranges::find_if(structure.regions, [](const Region& region) {
    return follows_law(region) ||
           std::ranges::any_of(region.dashpot, [](double rate) { return rate > 0; });
  });
  if (law != structure.regions.end() || structure.soil || !structure.absorbing.empty()) {
    refuse("structure " + structure.name + " has " +
               (law != structure.regions.end() ? "links (group " + law->group + ")"
                                               : std::string("soil or absorbing faces")) +
               ", which are stepped one run at a time",
           "make single runs (run/sweep)");
  }
}

void require_plain_contact(const Contact& contact) {
  if (contact.sliding > 0) {
    refuse("the pairs of contact " + contact.name + " are found anew",
           "leave -" + contact.name + "_sliding out");
  }
  if (contact.filler) {
    refuse("the joint of contact " + contact.name + " is filled",
           "leave -" + contact.name + "_filler out, or make single runs");
  }
}

}  // namespace

void require_ensemble_scene(const Scene& scene) {
  for (const Structure& structure : scene.structures) require_reduced(structure);
  for (const Contact& contact : scene.contacts) require_plain_contact(contact);
  if (!scene.supports.empty()) refuse("supports move on their own", "leave -supports out");
  if (scene.motion_from_below) {
    refuse("the motion enters from below", "give -motion_input base");
  }
  if (scene.preload) refuse("the run starts at rest under its weight", "give -preload none");
  if (!scene.forces.empty()) refuse("forces are recorded", "give -forces none");
  if (!scene.loops.empty()) refuse("loops are recorded", "give -loops none");
  if (scene.fields_interval > 0) refuse("fields are written", "give -fields_interval 0");
  if (!scene.restart.empty()) {
    refuse("-restart continues single runs",
           "leave it out: an ensemble goes on by itself in its folder");
  }
  if (scene.probes.empty()) refuse("there is nothing to record", "give -probes");
  if (scene.allow_unstable) refuse("-allow_unstable is for single runs", "leave it out");
}

MemberScene read_member(const OptionsDatabase& scene, const MemberTable& table,
                        std::size_t member) {
  try {
    ReadScene read = read_scene(member_options(scene, table, member));
    return {table.place(member), std::move(read.scene), std::move(read.stiffness_factors)};
  } catch (const UserError& error) {
    throw UserError(table.place(member) + error.what());
  }
}

StepLimits member_limits(const MemberScene& member, const std::vector<ModalBasis>& bases) {
  const Scene& scene = member.scene;
  StepLimits limits;
  for (std::size_t s = 0; s < bases.size(); ++s) {
    ModalBasis basis = bases[s];
    scale_stiffness(member.stiffness_factors[s], basis);
    limits.stable = std::min(limits.stable, stable_time_step(scene.structures[s], basis));
    limits.resolved = faster(limits.resolved, resolved_motion_of(scene.structures[s], basis,
                                                                 scene.spectra.frequencies.back()));
  }
  return limits;
}

double member_gap(const Scene& scene, const interactions::Constraint& row,
                  const interactions::GapShare& share) {
  const std::vector<double>& gap = scene.contacts[row.contact].gap.values;
  return gap.empty() ? row.geometric_gap : interactions::given_gap(gap, share);
}

Model member_model(const MemberScene& member, const EnsembleModel& shared) {
  const Scene& scene = member.scene;
  Model model;
  try {
    model.motion = std::make_unique<GroundMotion>(scene.motion, scene.resampling);
  } catch (const UserError& error) {
    throw UserError(member.place + error.what());
  }
  model.interface.constraints = shared.model->interface.constraints;
  model.interface.model_size = shared.model->interface.model_size;
  for (std::size_t row = 0; row < model.interface.constraints.size(); ++row) {
    interactions::Constraint& constraint = model.interface.constraints[row];
    constraint.initial_gap = member_gap(scene, constraint, shared.gap_shares[row]);
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
    building.basis = shared.bases[s];
    scale_stiffness(member.stiffness_factors[s], *building.basis);
    model.systems[s] =
        build_reduced_system(MPI_COMM_SELF, 0, structure, *building.mesh, *building.basis);
    building.limits =
        limits_of(structure, model.systems[s], *building.mesh, building.basis_or_null(), {});
    building.energy_margin =
        energy_margin_of(structure, model.systems[s], *building.mesh, building.basis_or_null(),
                         building.limits, model.time_step, {});
  }
  return model;
}

}  // namespace pounding
