#include "driver/modal_bases.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <numeric>
#include <set>

#include "common/error.h"
#include "common/parallel.h"
#include "driver/whole_meshes.h"
#include "interactions/pairing/interface.h"
#include "io/new_file.h"
#include "modal/modal_basis_file.h"
#include "modal/shifted_solver.h"
#include "model/switched_modes.h"
#include "scene/stiffness_factor.h"
#include "statics/assembled_statics.h"
#include "system/finite_element_system.h"
#include "system/links.h"
#include "system/load_shapes.h"
#include "system/mass_scaling.h"
#include "system/matrix_system.h"

namespace pounding {
namespace {

/// Components of nodes of one structure, each once over all lists.
class PointList {
 public:
  explicit PointList(int structure) : structure_(structure) {}

  void add(const TracePoint& point, std::vector<TracePoint>& points) {
    if (known_.insert(point).second) points.push_back(point);
  }

  void add(std::span<const interactions::Constraint> rows, std::vector<TracePoint>& points) {
    for (const interactions::Constraint& row : rows) {
      for (const interactions::ConstraintTerm& term : row.terms) {
        if (term.structure == structure_) add({term.node, term.component}, points);
      }
    }
  }

 private:
  int structure_;
  std::set<TracePoint> known_;
};

/// The first `components` components of nodes.
void add_node_points(std::span<const GlobalIndex> nodes, int components,
                     std::vector<TracePoint>& points) {
  for (const GlobalIndex node : nodes) {
    for (int c = 0; c < components; ++c) points.push_back({node, c});
  }
}

void add_contact_points(const interactions::Interface& interface, int s, PointList& list,
                        ModalRequest& request) {
  list.add(interface.constraints, request.contact_points);
  std::vector<interactions::Constraint> across =
      interactions::tangential_rows(interface.constraints);
  const auto smooth =
      std::stable_partition(across.begin(), across.end(),
                            [](const interactions::Constraint& row) { return row.friction > 0; });
  list.add({across.begin(), smooth}, request.contact_points);
  list.add({smooth, across.end()}, request.other_points);
  list.add(interface.watched, request.other_points);
  for (const interactions::SlidingFaces::Node& node : interface.sliding.nodes) {
    for (int d = 0; node.structure == s && d < 3; ++d) {
      list.add({node.node, d}, request.other_points);
    }
  }
}

/// Ends of links, of sections that yield and of the springs of waves. Rank 0 knows them alone,
/// which has the mesh.
void add_link_points(MPI_Comm comm, const Structure& structure, const GlobalMesh& mesh,
                     PointList& list, ModalRequest& request) {
  std::vector<TracePoint> links;
  std::vector<TracePoint> sections;
  std::vector<TracePoint> waves;
  if (rank_of(comm) == 0) {
    links = link_points(structure, mesh);
    sections = section_points(structure, mesh);
    waves = wave_points(structure, mesh);
  }
  broadcast_values(comm, 0, links, sections, waves);
  for (const TracePoint& point : sections) list.add(point, request.yielding_points);
  for (const TracePoint& point : links) list.add(point, request.other_points);
  for (const TracePoint& point : waves) list.add(point, request.shown_points);
}

/// Options of structure `s`, its loads and its start, and the places where a run asks for
/// its motion: contacts, along and across their normals, probes, links, forces, the bases of its
/// storeys, and every node for its fields. `mesh` is read on rank 0 only. Collective.
ModalRequest modal_request(MPI_Comm comm, const Scene& scene, std::size_t s, const GlobalMesh& mesh,
                           const Model& model) {
  const Structure& structure = scene.structures[s];
  const auto number = static_cast<int>(s);
  ModalRequest request;
  const ModalModel& modal = *structure.basis();
  const bool switched = structure.switched.has_value();
  request.switched_part = modal.switched_part;
  request.modes = modal.modes;
  request.candidates = modal.candidates;
  request.cutoff = modal.cutoff;
  request.attachment = modal.attachment;
  request.residual =
      modal.residual &&
      (!scene.supports.empty() || std::ranges::any_of(scene.motion, [](const auto& component) {
        return component.has_value();
      }));
  request.patches = modal.patches;
  if (scene.preload || switched) request.gravity = structure.gravity;
  PointList list(number);
  add_contact_points(model.interface, number, list, request);
  for (const ResolvedProbe& probe : model.probes) {
    if (probe.structure == number) add_node_points(probe.nodes, 3, request.other_points);
  }
  add_link_points(comm, structure, mesh, list, request);
  if (scene.fields_interval > 0 || switched) {
    std::vector<GlobalIndex> all(static_cast<std::size_t>(model.meshes[s].global_nodes));
    std::iota(all.begin(), all.end(), GlobalIndex{0});
    add_node_points(all, switched ? 6 : 3, request.shown_points);
  }
  for (const ResolvedForce& force : model.forces) {
    if (force.structure == number) add_node_points(force.nodes, 6, request.shown_points);
  }
  for (const ResolvedProbe& end : std::span(model.recorded).subspan(model.probes.size())) {
    if (end.structure == number) add_node_points(end.nodes, 6, request.shown_points);
  }
  for (const ResolvedProbe& base : model.storey_bases) {
    if (base.structure == number) add_node_points(base.nodes, 3, request.shown_points);
  }
  const SceneLoads loads = model.scene_loads();
  for (std::size_t l = 0; l < loads.nodal.size(); ++l) {
    if (loads.nodal[l].structure != number) continue;
    request.loads.push_back(loads.nodal[l]);
    request.loads_at_rest.push_back(loads.before_start[l]);
  }
  request.start = model.starts[s];
  request.supports.assign(model.support_columns().begin(), model.support_columns().end());
  request.start_displacement = structure.initial_displacement;
  request.start_velocity = structure.initial_velocity;
  return request;
}

/// A full matrix in the generalised coordinates is nothing that a step takes.
void forbid_damping_matrix(const Structure& structure) {
  if (structure.matrices.empty()) return;
  const std::string path = matrix_file(structure.matrices, "damping");
  refuse_if(!path.empty(), "option -" + structure.name + "_matrices " + structure.matrices + ": " +
                               path + " would be lost with -" + structure.name +
                               (structure.switched ? "_model switched" : "_model modal") +
                               "; take the file away and give -" + structure.name +
                               "_modal_damping or _damping, or -" + structure.name + "_model full");
}

/// Runs an action on a file; its errors become the user's.
void with_file(const Structure& structure, const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    throw UserError("option -" + structure.name + "_modal_basis " + error.what() +
                    "; give another file");
  }
}

/// The basis in the structure's file, if there is one that belongs to it. Rank 0.
std::optional<ModalBasis> stored_basis(const Structure& structure, const BasisKey& key,
                                       const ModalRequest& request) {
  const std::string& path = structure.modal->basis_file;
  StoredBasis stored;
  with_file(structure, [&] {
    if (std::filesystem::exists(path)) {
      stored = read_modal_basis(path, key, request);
    } else {
      NewFile(path + ".new");  // goes again
    }
  });
  if (stored.basis) {
    std::printf("structure %s: modal basis from %s\n", structure.name.c_str(), path.c_str());
  } else if (!stored.differs.empty()) {
    std::printf("structure %s: the modal basis in %s is of another model (%s): computed anew\n",
                structure.name.c_str(), path.c_str(), stored.differs.c_str());
  }
  return stored.basis;
}

/// Ranks that follow each other and compute a basis together.
struct Workers {
  int first = 0;
  int count = 0;
  MPI_Comm comm = MPI_COMM_NULL;  ///< of these ranks, elsewhere null

  bool hold(int rank) const { return rank >= first && rank < first + count; }
};

/// One structure on its way to a basis.
struct Reduction {
  std::size_t s = 0;    ///< its number
  Structure structure;  ///< without scaled mass: the coordinates are scaled, not the elements
  ModalRequest request;
  BasisKey key;  ///< rank 0
  Workers workers;
  Mesh mesh;         ///< all of it on the workers
  ModalBasis basis;  ///< rank 0, if it was in its file; on the workers once it is computed
  int stored = 0;    ///< whether it was in its file
};

/// `count` ranks of which the rank that has the structure is one. Collective.
Workers workers_of(MPI_Comm comm, int owner, int count) {
  Workers workers;
  workers.count = std::min(count, size_of(comm));
  workers.first = std::min(owner, size_of(comm) - workers.count);
  const int colour = workers.hold(rank_of(comm)) ? 0 : MPI_UNDEFINED;
  MPI_Comm_split(comm, colour, rank_of(comm), &workers.comm);
  return workers;
}

/// A whole mesh shared out among several workers. Rank 0.
Partition share_out(const Structure& structure, const GlobalMesh& mesh, const Workers& workers,
                    int ranks) {
  const std::vector<NodeCluster> clusters = coupled_nodes(structure, mesh, 0);
  Partition partition = partition_meshes({&mesh, 1}, {}, workers.count, {}, clusters);
  partition.parts = ranks;
  for (int& owner : partition.element_owner[0]) owner += workers.first;
  for (int& owner : partition.node_owner[0]) owner += workers.first;
  return partition;
}

/// Mesh of a structure on its workers: one has all of it, unless the ranks have shared it out,
/// several share it out.
Mesh mesh_of_workers(MPI_Comm comm, const GlobalMesh& whole, const Mesh& owners,
                     const Reduction& reduction) {
  Mesh mesh;
  const bool shared_out = reduction.structure.switched && size_of(comm) > 1;
  if (reduction.workers.count == 1 && !shared_out) {
    if (reduction.workers.hold(rank_of(comm))) mesh = owners;
  } else {
    Partition partition;
    on_rank0(comm, [&] {
      partition = share_out(reduction.structure, whole, reduction.workers, size_of(comm));
    });
    mesh = distribute_mesh(comm, reduction.structure.name, whole, partition, 0);
  }
  mesh.comm = reduction.workers.comm;
  return mesh;
}

/// Looks for a basis in its file; one that is not there gets workers and their mesh. Collective.
void prepare(MPI_Comm comm, const GlobalMesh& whole, int owner, const Model& model,
             Reduction& reduction) {
  const Structure& structure = reduction.structure;
  on_rank0(comm, [&] {
    forbid_damping_matrix(structure);
    if (structure.modal->basis_file.empty()) return;
    reduction.key = basis_key(structure, whole, reduction.request);
    if (auto basis = stored_basis(structure, reduction.key, reduction.request)) {
      reduction.basis = std::move(*basis);
      reduction.stored = 1;
    }
  });
  MPI_Bcast(&reduction.stored, 1, MPI_INT, 0, comm);
  if (reduction.stored != 0) return;
  reduction.workers = workers_of(comm, owner, structure.modal->ranks);
  reduction.mesh = mesh_of_workers(comm, whole, model.meshes[reduction.s], reduction);
}

/// The structure with (1 + d) / 2 of the stiffness of each region whose damping has a factor d;
/// nothing where none has. Collective over the workers.
std::optional<LinearSystem> with_damping_factors(const Model& model, const Reduction& reduction) {
  const auto has_factor = [](const Region& region) { return region.damping_factor != 1; };
  if (std::ranges::none_of(reduction.structure.regions, has_factor)) return std::nullopt;
  Structure structure = reduction.structure;
  for (Region& region : structure.regions) {
    scale_stiffness((1 + region.damping_factor) / 2, region);
  }
  return assemble_structure(model, reduction.s, structure, reduction.mesh,
                            StiffnessMethod::assembled, false);
}

/// The structure at full order, with the axial forces that its columns have under its weight and
/// loads alone, without contacts; then its basis. Collective over the workers.
void compute(const Model& model, Profile& profile, Reduction& reduction) {
  const Structure& structure = reduction.structure;
  Mesh& mesh = reduction.mesh;
  LinearSystem system;
  std::optional<LargestCompression> compression;
  {
    const ScopedTimer timer(profile, Phase::assembly);
    const auto assemble = [&] {
      return assemble_structure(model, reduction.s, structure, mesh, StiffnessMethod::assembled,
                                false);
    };
    system = assemble();
    if (structure.p_delta) {
      const Equilibrium rest =
          find_equilibrium(mesh.comm, {&system, 1}, {&mesh, 1}, {}, {}, SolverChoice::automatic);
      compression = set_axial_forces(structure, rest.displacement[0], mesh);
      system = assemble();
    }
  }
  const ScopedTimer timer(profile, Phase::modes);
  require_stable(structure, mesh, system, compression);
  follow_supports(model, structure, mesh, SolverChoice::automatic, system);
  const std::optional<LinearSystem> damping = with_damping_factors(model, reduction);
  if (damping) reduction.request.damping = &*damping;
  if (structure.switched) prepare_switched(mesh, system, reduction.request);
  reduction.basis = compute_modal_basis(system, mesh, reduction.request);
  reduction.basis.load_parts.resize(reduction.request.loads.size() * reduction.basis.size());
}

}  // namespace

void find_bases(MPI_Comm comm, const Scene& scene, std::span<const GlobalMesh> meshes,
                Profile& profile, Model& model) {
  const std::vector<int> owners = owners_of_reduced(size_of(comm), scene);
  std::vector<Reduction> reductions;
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    if (scene.structures[s].basis() == nullptr) continue;
    Reduction& reduction = reductions.emplace_back();
    reduction.s = s;
    reduction.structure = scene.structures[s];
    reduction.structure.modal = *scene.structures[s].basis();
    reduction.structure.mass_scaling = 0;
    reduction.request = modal_request(comm, scene, s, meshes[s], model);
    const int owner = owners[s] < 0 ? static_cast<int>(s) % size_of(comm) : owners[s];
    prepare(comm, meshes[s], owner, model, reduction);
  }
  on_every_rank(comm, [&] {
    for (Reduction& reduction : reductions) {
      if (reduction.workers.hold(rank_of(comm))) compute(model, profile, reduction);
    }
  });
  for (Reduction& reduction : reductions) {
    if (reduction.workers.comm != MPI_COMM_NULL) MPI_Comm_free(&reduction.workers.comm);
    broadcast_values(comm, reduction.workers.first, reduction.basis);
    const std::string& file = reduction.structure.modal->basis_file;
    if (reduction.stored == 0 && !file.empty()) {
      on_rank0(comm, [&] {
        with_file(reduction.structure,
                  [&] { write_modal_basis(file, reduction.key, reduction.basis); });
      });
    }
    Building& building = model.buildings[reduction.s];
    (reduction.structure.switched ? building.open_basis : building.basis) =
        std::move(reduction.basis);
  }
}

LinearSystem assemble_structure(const Model& model, std::size_t s, const Structure& structure,
                                const Mesh& mesh, StiffnessMethod method, bool with_matrix) {
  LinearSystem system = build_system(structure, mesh, method, with_matrix);
  system.loads = shape_loads(model.scene_loads(), static_cast<int>(s), mesh);
  system.start = shape_start(model.starts[s], system, mesh);
  return system;
}

void require_stable(const Structure& structure, const Mesh& mesh, const LinearSystem& system,
                    const std::optional<LargestCompression>& compression) {
  require_passive_matrices(structure, system);
  if (compression) require_no_buckling(structure, mesh, system, *compression);
}

void follow_supports(const Model& model, const Structure& structure, const Mesh& mesh,
                     SolverChoice solver, LinearSystem& system) {
  system.supports = find_support_shapes(structure, mesh, system, model.support_columns(), solver);
  if (system.supports && system.links) system.links->find_trace(system, mesh);
}

}  // namespace pounding
