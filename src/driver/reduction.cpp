#include "driver/reduction.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>

#include "common/error.h"
#include "common/hash.h"
#include "common/parallel.h"
#include "contact/slide_watch.h"
#include "mesh/mesh.h"
#include "output/modal_basis_file.h"
#include "system/build_system.h"
#include "system/finite_element_system.h"

namespace pounding {
namespace {

/// Where a run asks for the motion of a structure: contacts, along and across their normals, and
/// probes.
ModalRequest request_of(const Scene& scene, int s, const Interface& interface,
                        std::span<const ResolvedProbe> probes) {
  const ModalModel& modal = *scene.structures[static_cast<std::size_t>(s)].modal;
  ModalRequest request{modal.modes, modal.candidates, modal.cutoff, modal.attachment, {}, {}};
  std::set<TracePoint> known;
  const auto add = [&](std::span<const Constraint> rows, std::vector<TracePoint>& points) {
    for (const Constraint& row : rows) {
      for (const ConstraintTerm& term : row.terms) {
        const TracePoint point{term.node, term.component};
        if (term.structure == s && known.insert(point).second) {
          points.push_back(point);
        }
      }
    }
  };
  add(interface.constraints, request.contact_points);
  add(tangential_rows(interface.constraints), request.other_points);
  for (const ResolvedProbe& probe : probes) {
    for (std::size_t k = 0; probe.structure == s && k < probe.nodes.size(); ++k) {
      for (int d = 0; d < 3; ++d) {
        request.other_points.push_back({probe.nodes[k], d});
      }
    }
  }
  return request;
}

std::string hash_of(std::span<const TracePoint> points) {
  Hash hash;
  for (const TracePoint& point : points) {
    hash.add(static_cast<double>(point.node));
    hash.add(static_cast<double>(point.component));
  }
  return hash.text();
}

std::string hash_of(const GlobalMesh& mesh) {
  Hash hash;
  hash.add_all(mesh.coordinates);
  hash.add_all(mesh.components);
  for (const ElementSet& set : mesh.regions) {
    hash.add(set.group);
    hash.add(static_cast<double>(set.type));
    hash.add_all(set.connectivity);
  }
  return hash.text();
}

/// Materials, sections and whatever else makes element matrices.
std::string hash_of(const std::vector<Region>& regions) {
  Hash hash;
  for (const Region& region : regions) {
    const ElementProperties p = element_properties(region);
    hash.add(region.group);
    hash.add(static_cast<double>(region.element));
    hash.add_all(std::array{p.young, p.poisson, p.density, p.area, p.inertia_y, p.inertia_z,
                            p.torsion, p.thickness, p.rotary_inertia_factor, p.mass});
    hash.add_all(p.z_axis);
    hash.add_all(p.rotary_inertia);
    hash.add_all(p.stiffness);
  }
  return hash.text();
}

/// Matrices from files: which they are, how large, how old.
std::string hash_of_matrices(const std::string& folder) {
  Hash hash;
  hash.add(folder);
  for (const char* name : {"stiffness.mtx", "stiffness.petsc", "mass.mtx", "mass.petsc"}) {
    std::error_code absent;
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    const auto size = std::filesystem::file_size(file, absent);
    const auto time = std::filesystem::last_write_time(file, absent);
    if (!absent) {
      hash.add(static_cast<double>(size));
      hash.add(static_cast<double>(time.time_since_epoch().count()));
    }
  }
  return hash.text();
}

/// Rank 0.
BasisKey key_of(const Structure& structure, const GlobalMesh& mesh, const ModalRequest& request) {
  Hash clamp;
  clamp.add_all(mesh.free_components);
  Hash vectors;
  vectors.add_all(
      std::array{static_cast<double>(request.modes), request.cutoff, request.attachment ? 1. : 0.});
  if (request.candidates > request.modes) {
    vectors.add(static_cast<double>(request.candidates));
  }
  return {{"mesh", hash_of(mesh)},
          {"elements", hash_of(structure.regions)},
          {"matrices", hash_of_matrices(structure.matrices)},
          {"clamp", clamp.text()},
          {"number of vectors", vectors.text()},
          {"contact points", hash_of(request.contact_points)},
          {"probe points", hash_of(request.other_points)}};
}

/// Runs `work` on a file; what goes wrong is the user's.
void with_file(const Structure& structure, const std::function<void()>& work) {
  try {
    work();
  } catch (const std::runtime_error& error) {
    throw UserError("option -" + structure.name + "_modal_basis " + error.what() +
                    "; give another file");
  }
}

/// The basis in the structure's file, if there is one that belongs to it. Rank 0.
std::optional<ModalBasis> stored_basis(const Structure& structure, const BasisKey& key) {
  const std::string& path = structure.modal->basis_file;
  StoredBasis stored;
  with_file(structure, [&] {
    if (std::filesystem::exists(path)) {
      stored = read_modal_basis(path, key);
    } else if (!std::ofstream(path + ".new")) {
      throw std::runtime_error(path + ": cannot be written");
    } else {
      std::filesystem::remove(path + ".new");
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

/// One structure on its way to a basis.
struct Reduction {
  int structure = 0;
  int worker = -1;  ///< rank that computes the basis; -1: it was in the file
  ModalRequest request;
  BasisKey key;  ///< rank 0
  Mesh mesh;     ///< all of it on the worker
  ModalBasis basis;
};

void compute(const Structure& structure, Profile& profile, Reduction& reduction) {
  reduction.mesh.comm = MPI_COMM_SELF;
  std::optional<LinearSystem> system;
  {
    const ScopedTimer timer(profile, Phase::assembly);
    Structure unscaled = structure;
    unscaled.mass_scaling = 0;  // the coordinates are scaled, not the elements
    system = build_system(unscaled, reduction.mesh);
  }
  const ScopedTimer timer(profile, Phase::modes);
  reduction.basis = compute_modal_basis(*system, reduction.mesh, reduction.request);
}

/// Sends the whole mesh to the worker.
void bring_mesh(MPI_Comm comm, const Structure& structure, std::span<const GlobalMesh> meshes,
                Reduction& reduction) {
  const GlobalMesh& mesh = meshes[static_cast<std::size_t>(reduction.structure)];
  Partition partition;
  if (rank_of(comm) == 0) {
    partition = partition_meshes({&mesh, 1}, {}, size_of(comm), {&reduction.worker, 1});
  }
  reduction.mesh = distribute_mesh(comm, structure.name, mesh, partition, 0);
}

}  // namespace

std::vector<int> owners_of_reduced(MPI_Comm comm, const Scene& scene) {
  const auto count = static_cast<int>(std::ranges::count_if(
      scene.structures, [](const Structure& structure) { return structure.modal.has_value(); }));
  const int block = (count + size_of(comm) - 1) / size_of(comm);
  std::vector<int> owners;
  int reduced = 0;
  for (const Structure& structure : scene.structures) {
    owners.push_back(structure.modal ? reduced++ / block : -1);
  }
  return owners;
}

std::vector<std::optional<ModalBasis>> find_bases(MPI_Comm comm, const Scene& scene,
                                                  std::span<const GlobalMesh> meshes,
                                                  const Interface& interface,
                                                  std::span<const ResolvedProbe> probes,
                                                  Profile& profile) {
  const auto structure_of = [&](const Reduction& r) -> const Structure& {
    return scene.structures[static_cast<std::size_t>(r.structure)];
  };
  std::vector<Reduction> reductions;
  int next_worker = 0;
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    if (!scene.structures[s].modal) {
      continue;
    }
    Reduction& reduction = reductions.emplace_back();
    reduction.structure = static_cast<int>(s);
    reduction.request = request_of(scene, reduction.structure, interface, probes);
    int stored = 0;
    on_rank0(comm, [&] {
      if (!scene.structures[s].modal->basis_file.empty()) {
        reduction.key = key_of(scene.structures[s], meshes[s], reduction.request);
        if (auto basis = stored_basis(scene.structures[s], reduction.key)) {
          reduction.basis = std::move(*basis);
          stored = 1;
        }
      }
    });
    MPI_Bcast(&stored, 1, MPI_INT, 0, comm);
    if (stored == 0) {
      reduction.worker = next_worker++ % size_of(comm);
      bring_mesh(comm, scene.structures[s], meshes, reduction);
    }
  }
  on_every_rank(comm, [&] {
    for (Reduction& reduction : reductions) {
      if (reduction.worker == rank_of(comm)) {
        compute(structure_of(reduction), profile, reduction);
      }
    }
  });
  std::vector<std::optional<ModalBasis>> bases(scene.structures.size());
  for (Reduction& reduction : reductions) {
    broadcast_basis(comm, std::max(reduction.worker, 0), reduction.basis);
    const Structure& structure = structure_of(reduction);
    if (reduction.worker >= 0 && !structure.modal->basis_file.empty()) {
      on_rank0(comm, [&] {
        with_file(structure, [&] {
          write_modal_basis(structure.modal->basis_file, reduction.key, reduction.basis);
        });
      });
    }
    bases[static_cast<std::size_t>(reduction.structure)] = std::move(reduction.basis);
  }
  return bases;
}

}  // namespace pounding
