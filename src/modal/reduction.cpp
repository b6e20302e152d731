#include "modal/reduction.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>

#include "common/error.h"
#include "common/parallel.h"
#include "interactions/pairing/tangential_rows.h"
#include "io/new_file.h"
#include "mesh/mesh.h"
#include "modal/basis_key.h"
#include "modal/buckling.h"
#include "modal/definiteness.h"
#include "modal/modal_basis_file.h"
#include "statics/equilibrium.h"
#include "statics/find_support_shapes.h"
#include "system/axial_forces.h"
#include "system/build_system.h"
#include "system/links.h"
#include "system/mass_scaling.h"
#include "system/matrix_system.h"
#include "system/start_state.h"

namespace pounding {
namespace {

/// Where a run asks for the motion of a structure: contacts, along and across their normals, probes
/// and links, and every node for its fields. Links are known on rank 0 alone, which has the mesh.
/// Collective.
ModalRequest request_of(MPI_Comm comm, const Scene& scene, int s, const GlobalMesh& mesh,
                        const interactions::Interface& interface,
                        std::span<const ResolvedProbe> probes,
                        std::span<const ResolvedForce> forces) {
  const ModalModel& modal = *scene.structures[s].modal;
  ModalRequest request;
  request.modes = modal.modes;
  request.candidates = modal.candidates;
  request.cutoff = modal.cutoff;
  request.attachment = modal.attachment;
  request.patches = modal.patches;
  if (scene.preload) request.gravity = scene.structures[s].gravity;
  std::set<TracePoint> known;
  const auto add = [&](std::span<const interactions::Constraint> rows,
                       std::vector<TracePoint>& points) {
    for (const interactions::Constraint& row : rows) {
      for (const interactions::ConstraintTerm& term : row.terms) {
        const TracePoint point{term.node, term.component};
        if (term.structure == s && known.insert(point).second) points.push_back(point);
      }
    }
  };
  add(interface.constraints, request.contact_points);
  std::vector<interactions::Constraint> across =
      interactions::tangential_rows(interface.constraints);
  const auto smooth = std::ranges::stable_partition(
      across, [](const interactions::Constraint& row) { return row.friction > 0; });
  add({across.begin(), smooth.begin()}, request.contact_points);
  add(smooth, request.other_points);
  for (const interactions::SlidingFaces::Node& node : interface.sliding.nodes) {
    for (int d = 0; node.structure == s && d < 3; ++d) {
      const TracePoint point{node.node, d};
      if (known.insert(point).second) request.other_points.push_back(point);
    }
  }
  for (const ResolvedProbe& probe : probes) {
    for (std::size_t k = 0; probe.structure == s && k < probe.nodes.size(); ++k) {
      for (int d = 0; d < 3; ++d) request.other_points.push_back({probe.nodes[k], d});
    }
  }
  std::vector<TracePoint> links;
  std::vector<TracePoint> sections;
  if (rank_of(comm) == 0) {
    links = link_points(scene.structures[s], mesh);
    sections = section_points(scene.structures[s], mesh);
  }
  broadcast_array(comm, links, 0);
  broadcast_array(comm, sections, 0);
  for (const TracePoint& point : sections) {
    if (known.insert(point).second) request.yielding_points.push_back(point);
  }
  for (const TracePoint& point : links) {
    if (known.insert(point).second) request.other_points.push_back(point);
  }
  if (scene.fields_interval > 0) {
    GlobalIndex nodes = mesh.node_count();
    MPI_Bcast(&nodes, 1, MPI_INT64_T, 0, comm);
    for (GlobalIndex node = 0; node < nodes; ++node) {
      for (int d = 0; d < 3; ++d) request.shown_points.push_back({node, d});
    }
  }
  for (const ResolvedForce& force : forces) {
    for (std::size_t k = 0; force.structure == s && k < force.nodes.size(); ++k) {
      for (int c = 0; c < 6; ++c) request.shown_points.push_back({force.nodes[k], c});
    }
  }
  return request;
}

/// A full matrix in the generalised coordinates is nothing that a step takes.
void forbid_damping_matrix(const Structure& structure) {
  if (structure.matrices.empty()) return;
  const std::string path = matrix_file(structure.matrices, "damping");
  if (!path.empty()) {
    throw UserError("option -" + structure.name + "_matrices " + structure.matrices + ": " + path +
                    " would be lost with -" + structure.name +
                    "_model modal; take the file away and give -" + structure.name +
                    "_modal_damping or _damping, or -" + structure.name + "_model full");
  }
}

/// Runs `work` on a file; its errors become the user's.
void with_file(const Structure& structure, const std::function<void()>& work) {
  try {
    work();
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
      stored = read_modal_basis(path, key, request.loads.size(), !request.start.empty());
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

/// Ranks that follow each other and compute a basis together; none where it was in its file.
struct Workers {
  int first = 0;
  int count = 0;
  MPI_Comm comm = MPI_COMM_NULL;  ///< of these ranks, elsewhere null

  bool hold(int rank) const { return rank >= first && rank < first + count; }
};

/// One structure on its way to a basis.
struct Reduction {
  int structure = 0;
  Workers workers;
  ModalRequest request;
  BasisKey key;  ///< rank 0
  Mesh mesh;     ///< all of it on the workers
  ModalBasis basis;
};

/// Chooses workers for one basis after the other, rank after rank, so that several are computed at
/// the same time.
class WorkerChoice {
 public:
  explicit WorkerChoice(MPI_Comm comm) : comm_(comm) {}

  /// Collective.
  Workers next(int wanted) {
    const int size = size_of(comm_);
    Workers workers{next_, std::min(wanted, size), MPI_COMM_NULL};
    if (workers.first + workers.count > size) workers.first = 0;
    next_ = (workers.first + workers.count) % size;
    const int colour = workers.hold(rank_of(comm_)) ? 0 : MPI_UNDEFINED;
    MPI_Comm_split(comm_, colour, rank_of(comm_), &workers.comm);
    return workers;
  }

 private:
  MPI_Comm comm_;
  int next_ = 0;
};

/// Gives the elements of a whole mesh their axial forces under the weight alone, without contacts.
LargestCompression turn_weight_with_columns(const Structure& structure, const LinearSystem& system,
                                            Mesh& mesh) {
  const Equilibrium rest = find_equilibrium(mesh.comm, {&system, 1}, {&mesh, 1},
                                            interactions::Interface{}, {}, SolverChoice::automatic);
  return set_axial_forces(structure, rest.displacement[0], mesh);
}

void compute(const Structure& structure, std::span<const SupportColumn> columns,
             const SceneLoads& loads, Profile& profile, Reduction& reduction) {
  reduction.mesh.comm = reduction.workers.comm;
  std::optional<LinearSystem> system;
  {
    const ScopedTimer timer(profile, Phase::assembly);
    Structure unscaled = structure;
    unscaled.mass_scaling = 0;  // the coordinates are scaled, not the elements
    const auto build = [&] {
      system = build_system(unscaled, reduction.mesh);
      system->loads = shape_loads(loads, reduction.structure, reduction.mesh);
      system->start = shape_start(reduction.request.start, *system, reduction.mesh);
    };
    build();
    if (structure.p_delta) {
      const LargestCompression largest =
          turn_weight_with_columns(unscaled, *system, reduction.mesh);
      build();
      require_no_buckling(structure, reduction.mesh, *system, largest);
    }
  }
  const ScopedTimer timer(profile, Phase::modes);
  require_passive_matrices(structure, *system);
  system->supports =
      find_support_shapes(structure, reduction.mesh, *system, columns, SolverChoice::automatic);
  reduction.basis = compute_modal_basis(*system, reduction.mesh, reduction.request);
}

/// The whole mesh shared out among the workers. Rank 0.
Partition share_out(const Structure& structure, const GlobalMesh& mesh, const Workers& workers,
                    int ranks) {
  if (workers.count == 1) return partition_meshes({&mesh, 1}, {}, ranks, {&workers.first, 1});
  Structure unscaled = structure;
  unscaled.mass_scaling = 0;
  const std::vector<NodeCluster> clusters = coupled_nodes(unscaled, mesh, 0);
  Partition partition = partition_meshes({&mesh, 1}, {}, workers.count, {}, clusters);
  partition.parts = ranks;
  for (int& owner : partition.element_owner[0]) owner += workers.first;
  for (int& owner : partition.node_owner[0]) owner += workers.first;
  return partition;
}

/// Sends the whole mesh to the workers.
void bring_mesh(MPI_Comm comm, const Structure& structure, std::span<const GlobalMesh> meshes,
                Reduction& reduction) {
  const GlobalMesh& mesh = meshes[reduction.structure];
  Partition partition;
  on_rank0(comm, [&] { partition = share_out(structure, mesh, reduction.workers, size_of(comm)); });
  reduction.mesh = distribute_mesh(comm, structure.name, mesh, partition, 0);
}

}  // namespace

std::vector<int> owners_of_reduced(int ranks, const Scene& scene) {
  const auto count = static_cast<int>(std::ranges::count_if(
      scene.structures, [](const Structure& structure) { return structure.modal.has_value(); }));
  const int block = (count + ranks - 1) / ranks;
  std::vector<int> owners;
  int reduced = 0;
  for (const Structure& structure : scene.structures) {
    owners.push_back(structure.modal ? reduced++ / block : -1);
  }
  return owners;
}

std::vector<std::optional<ModalBasis>> find_bases(
    MPI_Comm comm, const Scene& scene, std::span<const GlobalMesh> meshes,
    const interactions::Interface& interface, std::span<const ResolvedProbe> probes,
    std::span<const ResolvedForce> forces, std::span<const ResolvedProbe> storey_bases,
    std::span<const SupportColumn> columns, const SceneLoads& loads,
    std::span<const NodalStart> starts, Profile& profile) {
  const auto structure_of = [&](const Reduction& r) -> const Structure& {
    return scene.structures[r.structure];
  };
  std::vector<Reduction> reductions;
  WorkerChoice choice(comm);
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    if (!scene.structures[s].modal) continue;
    Reduction& reduction = reductions.emplace_back();
    reduction.structure = static_cast<int>(s);
    reduction.request =
        request_of(comm, scene, reduction.structure, meshes[s], interface, probes, forces);
    for (std::size_t l = 0; l < loads.nodal.size(); ++l) {
      if (loads.nodal[l].structure != reduction.structure) continue;
      reduction.request.loads.push_back(loads.nodal[l]);
      reduction.request.loads_at_rest.push_back(loads.before_start[l]);
    }
    reduction.request.start = starts[s];
    reduction.request.start_displacement = scene.structures[s].initial_displacement;
    reduction.request.start_velocity = scene.structures[s].initial_velocity;
    for (const ResolvedProbe& base : storey_bases) {
      for (std::size_t k = 0; base.structure == reduction.structure && k < base.nodes.size(); ++k) {
        for (int d = 0; d < 3; ++d) reduction.request.shown_points.push_back({base.nodes[k], d});
      }
    }
    int stored = 0;
    on_rank0(comm, [&] {
      forbid_damping_matrix(scene.structures[s]);
      if (!scene.structures[s].modal->basis_file.empty()) {
        reduction.key = basis_key(scene.structures[s], meshes[s], reduction.request);
        if (auto basis = stored_basis(scene.structures[s], reduction.key, reduction.request)) {
          reduction.basis = std::move(*basis);
          stored = 1;
        }
      }
    });
    MPI_Bcast(&stored, 1, MPI_INT, 0, comm);
    if (stored == 0) {
      reduction.workers = choice.next(scene.structures[s].modal->ranks);
      bring_mesh(comm, scene.structures[s], meshes, reduction);
    }
  }
  on_every_rank(comm, [&] {
    for (Reduction& reduction : reductions) {
      if (reduction.workers.hold(rank_of(comm))) {
        compute(structure_of(reduction), columns, loads, profile, reduction);
      }
    }
  });
  std::vector<std::optional<ModalBasis>> bases(scene.structures.size());
  for (Reduction& reduction : reductions) {
    if (reduction.workers.comm != MPI_COMM_NULL) MPI_Comm_free(&reduction.workers.comm);
    broadcast_basis(comm, reduction.workers.first, reduction.basis);
    const Structure& structure = structure_of(reduction);
    if (reduction.workers.count > 0 && !structure.modal->basis_file.empty()) {
      on_rank0(comm, [&] {
        with_file(structure, [&] {
          write_modal_basis(structure.modal->basis_file, reduction.key, reduction.basis);
        });
      });
    }
    bases[reduction.structure] = std::move(reduction.basis);
  }
  return bases;
}

}  // namespace pounding
