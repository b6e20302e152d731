#include "driver/build_model.h"

#include <algorithm>

#include "checks/warnings.h"
#include "common/error.h"
#include "common/parallel.h"
#include "common/progress.h"
#include "driver/mesh_pieces.h"
#include "driver/modal_bases.h"
#include "driver/whole_meshes.h"
#include "modal/reduced_system.h"
#include "model/separation.h"
#include "model/start_at_rest.h"
#include "model/switched_modes.h"
#include "model/time_step.h"
#include "observers/field_plan.h"
#include "observers/model_file.h"
#include "observers/storeys.h"
#include "report/report.h"
#include "scene/pool_reader.h"
#include "scene/soil_file.h"
#include "scene/soil_reader.h"
#include "scene/stiffness_factor.h"
#include "scene/support_reader.h"
#include "stability/stable_time_step.h"
#include "stability/step_target.h"
#include "system/load_shapes.h"

namespace pounding {
namespace {

/// A phase of the start-up of a structure.
Progress begin(MPI_Comm comm, const Scene& scene, const Structure& structure, const char* what) {
  return Progress(comm, structure.name + ": " + what, scene.progress_interval);
}

/// Shares the content of the file of a structure's soil, which rank 0 has. Collective.
void share_fit(MPI_Comm comm, Soil& soil) {
  if (soil.table.empty()) return;
  if (!soil.fitted) soil.fitted.emplace();
  broadcast_values(comm, 0, soil.fitted->parts, soil.fitted->misfits, soil.fitted->mats);
}

/// Shares the findings of rank 0 in the whole meshes. Collective.
void share_findings(MPI_Comm comm, Scene& scene, WholeMeshes& whole,
                    const ContactsKnown& contacts_known, Model& model) {
  pass_shared_findings(whole, model,
                       [&](auto&... values) { broadcast_values(comm, 0, values...); });
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    Structure& structure = scene.structures[s];
    fill_pools(whole.pools[s], structure);
    if (!structure.soil) continue;
    share_fit(comm, *structure.soil);
    lay_foundation(whole.mats[s], structure);
  }
  if (contacts_known) contacts_known(model.interface);
}

/// Rank 0 reads the meshes, finds the faces in contact, and sends every rank its part.
void share_meshes(MPI_Comm comm, Scene& scene, Profile& profile,
                  const ContactsKnown& contacts_known, WholeMeshes& whole, Model& model) {
  {
    const ScopedTimer timer(profile, Phase::mesh);
    on_rank0(comm, [&] { whole = read_whole_meshes(comm, scene, model, whole.splits); });
    share_findings(comm, scene, whole, contacts_known, model);
  }
  const ScopedTimer timer(profile, Phase::partition);
  const Progress progress(comm, "partition", scene.progress_interval);
  Partition partition;
  on_rank0(comm,
           [&] { partition = cut_meshes(scene, whole.meshes, model.interface, size_of(comm)); });
  model.partition_imbalance = partition.imbalance;
  model.partition_edge_cut = partition.edge_cut;
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    if (!scene.export_matrices.empty()) model.node_tags.push_back(whole.meshes[s].node_tags);
    model.meshes.push_back(distribute_mesh(comm, scene.structures[s].name, whole.meshes[s],
                                           partition, static_cast<int>(s)));
  }
}

/// Every rank reads its piece of meshes that were cut before.
void read_meshes(MPI_Comm comm, Scene& scene, Profile& profile, const ContactsKnown& contacts_known,
                 WholeMeshes& whole, Model& model) {
  std::string identity;
  {
    const ScopedTimer timer(profile, Phase::mesh);
    on_rank0(comm, [&] {
      CommonPiece common = read_common_piece(scene, size_of(comm), model);
      whole = std::move(common.whole);
      std::ranges::for_each(scene.structures, read_soil_file);
      identity = common.identity;
    });
    broadcast(comm, identity);
    share_findings(comm, scene, whole, contacts_known, model);
  }
  const ScopedTimer timer(profile, Phase::partition);
  const Progress progress(comm, "pieces of meshes", scene.progress_interval);
  std::vector<MeshParcel> parcels;
  on_every_rank(comm, [&] { parcels = read_mesh_piece(scene, rank_of(comm), identity); });
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    model.meshes.push_back(
        join_parcel(comm, scene.structures[s].name, std::move(parcels[s]), whole.meshes[s]));
  }
}

/// Every rank gets its part of the meshes. Bases of reduced structures come from the whole ones.
void build_meshes(MPI_Comm comm, Scene& scene, std::span<const double> stiffness_factors,
                  Profile& profile, const ContactsKnown& contacts_known, int splits, Model& model) {
  const std::size_t count = scene.structures.size();
  WholeMeshes whole{std::vector<GlobalMesh>(count), std::vector<MatOutline>(count),
                    std::vector<std::vector<PoolOutline>>(count), splits};
  (scene.mesh_pieces.empty() ? share_meshes : read_meshes)(comm, scene, profile, contacts_known,
                                                           whole, model);
  for (const Mesh& mesh : model.meshes) {
    if (mesh.global_dofs > 0) continue;
    throw UserError("structure " + mesh.structure +
                    ": every node is clamped, nothing can move; look at -" + mesh.structure +
                    "_clamp");
  }
  if (scene.dry_run && scene.write_model) write_model(comm, scene, model);
  model.storey_bases = find_storey_bases(comm, scene, model);
  const Progress progress(comm, "modal bases", scene.progress_interval);
  find_bases(comm, scene, whole.meshes, profile, model);
  for (std::size_t s = 0; s < count; ++s) {
    if (!model.buildings[s].basis) continue;
    scale_stiffness(stiffness_factors[s], *model.buildings[s].basis);
    scale_stiffness(stiffness_factors[s], scene.structures[s]);  // forces are of its elements
  }
}

/// Whether the damping of a structure refers to its first frequency.
bool keeps_first_mode(const Structure& structure) {
  return structure.uniform_damping && structure.uniform_damping->reference == 0;
}

EigenvalueEffort effort_of(const Scene& scene, Progress& progress) {
  EigenvalueEffort effort;
  effort.tolerance = scene.omega_max_tolerance;
  effort.report = [&progress](int products) {
    progress.at(std::to_string(products) + " products with the stiffness");
  };
  return effort;
}

void find_energy_margins(MPI_Comm comm, const Scene& scene, Model& model) {
  for (Building& building : model.buildings) {
    Progress progress = begin(comm, scene, *building.structure, "energy margin");
    building.energy_margin = energy_margin_of(*building.structure, *building.system, *building.mesh,
                                              building.basis_or_null(), building.limits,
                                              model.time_step, effort_of(scene, progress));
  }
}

/// Whether a structure at full order gets stiffness from its forces at rest; a reduced one has it
/// in its basis.
bool leans(const Structure& structure) {
  return structure.p_delta && !structure.modal;
}

/// System of a structure in the coordinates of its basis.
void build_reduced(MPI_Comm comm, const Scene& scene, std::size_t s, Model& model) {
  const Structure& structure = scene.structures[s];
  Building& building = model.buildings[s];
  LinearSystem& system = model.systems[s];
  building.modal = modes_of_basis(*building.basis, scene.modes);
  building.mode_gaps = modes_at_contacts(comm, model, s);  // before its rows go into the system
  system = build_reduced_system(comm, owners_of_reduced(size_of(comm), scene)[s], structure,
                                model.meshes[s], *building.basis, model.support_columns());
  system.loads = shape_reduced_loads(model.scene_loads(), static_cast<int>(s),
                                     building.basis->load_parts, system.owned_dofs() > 0);
  system.start =
      shape_reduced_start(building.basis->start_parts, system.lumped_mass, system.owned_dofs() > 0);
  building.limits = limits_of(structure, system, model.meshes[s], building.basis_or_null(), {});
}

/// Assembles a structure at full order, with the design of its step if that has a target.
void assemble(MPI_Comm comm, const Scene& scene, std::size_t s, Profile& profile, Model& model) {
  const Structure& wanted = scene.structures[s];
  Building& building = model.buildings[s];
  if (wanted.step_target) {
    Progress progress = begin(comm, scene, wanted, "time step target");
    building.design =
        design_for_target(wanted, model.meshes[s], scene.stiffness, effort_of(scene, progress));
  }
  const ScopedTimer timer(profile, Phase::assembly);
  const Progress progress = begin(comm, scene, wanted, "assembly");
  const bool with_matrix = scene.modes > 0 || keeps_first_mode(building.full_order()) ||
                           scene.preload || !scene.export_matrices.empty() ||
                           stands_on_moving_support(scene, wanted);
  model.systems[s] = assemble_structure(model, s, building.full_order(), model.meshes[s],
                                        scene.stiffness, with_matrix);
}

/// System, modes and limits of a structure at full order.
void build_full(MPI_Comm comm, const Scene& scene, std::size_t s, Profile& profile, Model& model) {
  assemble(comm, scene, s, profile, model);
  const Mesh& mesh = model.meshes[s];
  Building& building = model.buildings[s];
  const Structure& structure = building.full_order();
  LinearSystem& system = model.systems[s];
  const bool keeps_first = keeps_first_mode(structure);
  const ScopedTimer timer(profile, Phase::modes);
  require_stable(structure, mesh, system, building.compression);
  {
    const Progress progress = begin(comm, scene, structure, "lowest modes");
    const bool with_shapes = scene.write_modes || !scene.contacts.empty();
    building.modal = lowest_modes(system, mesh, std::max(scene.modes, keeps_first ? 1 : 0),
                                  with_shapes, scene.modes_solver);
  }
  if (keeps_first) {
    system.uniform_damping->reference = reference_frequency(structure, building.modal);
  }
  {
    const Progress progress = begin(comm, scene, structure, "static responses to its supports");
    follow_supports(model, structure, mesh, scene.preload_solver, system);
  }
  building.modal.modes.resize(std::min<std::size_t>(building.modal.modes.size(), scene.modes));
  if (!scene.contacts.empty()) building.mode_gaps = modes_at_contacts(comm, model, s);
  if (!scene.write_modes) {
    for (Mode& mode : building.modal.modes) mode.shape = {};
  }
  if (scene.export_matrices.empty() && !scene.preload) system.stiffness->release_matrix();
  Progress progress = begin(comm, scene, structure, "largest frequency and stable time step");
  building.limits = limits_of(structure, system, mesh, nullptr, effort_of(scene, progress));
}

/// Axial forces of weight and loads at rest in structures that lean, which are assembled for it,
/// while the others are built.
void turn_weight_with_columns(MPI_Comm comm, const Scene& scene, Profile& profile, Model& model) {
  if (std::ranges::none_of(scene.structures, leans)) return;
  const ScopedTimer timer(profile, Phase::assembly);
  const Progress progress(comm, "static equilibrium for P-Delta", scene.progress_interval);
  const Equilibrium rest =
      find_equilibrium(comm, model.systems, model.meshes, model.interface,
                       rows_open_at_rest(scene, model.interface), scene.preload_solver);
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    if (!leans(scene.structures[s])) continue;
    model.buildings[s].compression =
        set_axial_forces(scene.structures[s], rest.displacement[s], model.meshes[s]);
  }
}

/// Builds systems, modes, equilibrium and time step on meshes that are there. Collective.
void build_structures(MPI_Comm comm, Scene& scene, Profile& profile, Model& model) {
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    const Structure& structure = scene.structures[s];
    Building& building = model.buildings[s];
    building.structure = &structure;
    building.mesh = &model.meshes[s];
    building.system = &model.systems[s];
    building.beams = beam_waves(comm, structure, model.meshes[s]);
    if (structure.modal) {
      build_reduced(comm, scene, s, model);
    } else if (leans(structure)) {
      assemble(comm, scene, s, profile, model);
    } else {
      build_full(comm, scene, s, profile, model);
    }
  }
  turn_weight_with_columns(comm, scene, profile, model);
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    if (leans(scene.structures[s])) build_full(comm, scene, s, profile, model);
  }
  put_at_rest(comm, scene, model.meshes, profile, model);
  give_modes(comm, scene, model);
  find_start_gaps(scene, model);
  on_rank0(comm, [&] { model.separations = find_separations(scene, model); });
  add_model_doubts(comm, scene, model);
  model.filler_time_step = filler_limit(comm, scene, model, model.meshes);
  choose_time_step(scene, step_limits(scene, model), model);
  const Doubts doubts(model.warnings);
  add_step_doubts(scene, model, doubts);
  doubts.add(check_fields(comm, scene, model));
}

}  // namespace

Model build_model(MPI_Comm comm, Scene& scene, std::span<const double> stiffness_factors,
                  Profile& profile, const ContactsKnown& contacts_known, int splits) {
  Model model;
  model.buildings.resize(scene.structures.size());
  model.systems.resize(scene.structures.size());
  on_every_rank(comm, [&] { read_histories(scene, model); });
  build_meshes(comm, scene, stiffness_factors, profile, contacts_known,
               scene.meshes.splits + splits, model);
  try {
    build_structures(comm, scene, profile, model);
  } catch (const UserError&) {
    // Doubts about the meshes may tell why, and would not be printed otherwise.
    if (rank_of(comm) == 0) print(warning_facts(model.warnings));
    throw;
  }
  const ScopedTimer timer(profile, Phase::modes);
  find_energy_margins(comm, scene, model);
  return model;
}

}  // namespace pounding
