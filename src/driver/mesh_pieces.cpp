#include "driver/mesh_pieces.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "common/byte_stream.h"
#include "common/error.h"
#include "common/hash.h"
#include "common/parallel.h"
#include "common/progress.h"
#include "common/version.h"
#include "io/file_seal.h"
#include "io/new_file.h"
#include "observers/run_statistics.h"
#include "report/provenance.h"
#include "report/report.h"

namespace pounding {
namespace {

namespace fs = std::filesystem;

constexpr const char* common_kind = "pounding mesh pieces 7";
constexpr const char* piece_kind = "pounding mesh piece 2";

std::string common_path(const Scene& scene) {
  return scene.mesh_pieces + "/common.piece";
}

std::string piece_path(const Scene& scene, int rank) {
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "/piece-%05d.bin", rank);
  return scene.mesh_pieces + name.data();
}

[[noreturn]] void refuse_pieces(const Scene& scene, const std::string& why) {
  throw UserError("option -mesh_pieces " + scene.mesh_pieces + ": " + why);
}

/// Things that meshes are made of, and the value of each.
using Ingredients = std::vector<std::pair<std::string, std::string>>;

fs::path folder_of_mesh(const Structure& structure) {
  return fs::absolute(structure.mesh).parent_path();
}

/// Everything on which the pieces depend but the number of ranks. `opened`: the files that Gmsh
/// opened for each structure, by their paths from its mesh.
Ingredients ingredients_of(const Scene& scene,
                           const std::vector<std::vector<std::string>>& opened) {
  Ingredients list{{"program", std::string(program_version()) + " (" + program_commit() + ")"}};
  for (const auto& [name, value] : scene.mesh_options) list.emplace_back("option " + name, value);
  const auto add = [&](const std::string& what, const std::string& file) {
    if (!file.empty()) list.emplace_back(what, digest_of_file(file).sha256);
  };
  for (const Structure& structure : scene.structures) {
    add("mesh of " + structure.name, structure.mesh);
    if (structure.soil) add("soil table of " + structure.name, structure.soil->table);
    add("initial state of " + structure.name, structure.initial_state);
  }
  add("motion_incoherent", scene.motion_incoherent);
  for (const Contact& contact : scene.contacts) {
    add("survey of " + contact.name, contact.gap.survey);
  }
  for (std::size_t s = 0; s < std::min(opened.size(), scene.structures.size()); ++s) {
    const Structure& structure = scene.structures[s];
    for (const std::string& name : opened[s]) {
      const std::string file = (folder_of_mesh(structure) / name).string();
      std::error_code failure;
      list.emplace_back(name + ", of which the mesh of " + structure.name + " is made",
                        fs::is_regular_file(file, failure) ? digest_of_file(file).sha256 : "gone");
    }
  }
  return list;
}

/// The first thing that one list has and the other has not; empty if there is none.
std::string difference(const Ingredients& one, const Ingredients& other) {
  for (const auto& [from, in] : {std::pair(&one, &other), std::pair(&other, &one)}) {
    for (const auto& each : *from) {
      if (std::ranges::find(*in, each) == in->end()) return each.first;
    }
  }
  return "";
}

/// Identity of a cut: the sources of the pieces and the number of ranks.
std::string identity_of(const Ingredients& ingredients, int ranks) {
  Hash hash;
  hash.add(ranks);
  for (const auto& [name, value] : ingredients) {
    hash.add(name, value);
  }
  return hash.text();
}

struct Head {
  std::string kind = common_kind;
  std::int32_t ranks = 0;
  std::vector<std::vector<std::string>> opened;  ///< by Gmsh, of each structure: from its mesh
  Ingredients ingredients;

  static void members(auto& self, auto& stream) {
    stream(self.kind, self.ranks, self.opened, self.ingredients);
  }
};

/// Passes the common piece behind its head, in either direction.
void pass_common(auto& stream, auto& whole, auto& model) {
  for (auto& mesh : whole.meshes) NodeMarks::members(mesh, stream);
  pass_shared_findings(whole, model, stream);
  for (auto& building : model.buildings) {
    stream(building.findings, building.absorbing, building.spread);
  }
  stream(model.interface.reports, model.interface.warnings, model.warnings,
         model.partition_imbalance, model.partition_edge_cut);
}

/// Writes a sealed file. Throws UserError.
void write_sealed(const std::string& path, const std::function<void(ByteWriter&)>& write) {
  NewFile file(path);
  file.write(std::array<char, seal_size>{});
  const WriteBytes bytes = [&](std::span<const char> values) { file.write(values); };
  ByteWriter writer(bytes);
  write(writer);
  file.close();
  seal_file(path);
}

/// Reads a sealed file. Throws UserError where it is missing, damaged or none.
void read_sealed(const Scene& scene, const std::string& path,
                 const std::function<void(ByteReader&)>& read) {
  if (std::error_code failure; !fs::is_regular_file(path, failure)) {
    refuse_pieces(scene, path + " is not there; cut the meshes first (-write_mesh_pieces RANKS)");
  }
  const auto damaged = [&](const std::string& why) {
    refuse_pieces(scene, why + "; cut the meshes anew (-write_mesh_pieces RANKS)");
  };
  try {
    check_seal(path);
  } catch (const std::runtime_error& error) {
    damaged(error.what());
  }
  std::ifstream file(path, std::ios::binary);
  file.seekg(seal_size);
  const ReadBytes bytes = [&](std::span<char> values) {
    file.read(values.data(), static_cast<std::streamsize>(values.size()));
    if (!file) throw std::runtime_error("it cannot be read");
  };
  ByteReader reader(bytes, fs::file_size(path) - seal_size);
  try {
    read(reader);
  } catch (const UserError&) {
    throw;
  } catch (const std::exception& error) {
    damaged(path + ": no piece of a mesh, or a damaged one (" + error.what() + ")");
  }
}

/// Removes an earlier cut, its common piece first, so that no half of one is taken for a whole.
void remove_pieces(const Scene& scene) {
  fs::remove(common_path(scene));
  for (const fs::directory_entry& entry : fs::directory_iterator(scene.mesh_pieces)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("piece-") && name.ends_with(".bin")) fs::remove(entry.path());
  }
}

/// Free dofs of a whole mesh.
std::size_t dofs_of(const GlobalMesh& mesh) {
  std::size_t dofs = 0;
  for (const std::uint8_t mask : mesh.free_components) dofs += component_count(mask);
  return dofs;
}

/// Cuts the meshes and writes all files. Rank 0.
void cut_and_write(const Scene& scene, const WholeMeshes& whole, Model& model) {
  const int ranks = scene.write_mesh_pieces;
  std::size_t elements = 0;
  for (const GlobalMesh& mesh : whole.meshes) {
    for (const ElementSet& set : mesh.regions) elements += set.tags.size();
  }
  refuse_if(static_cast<std::size_t>(ranks) > elements,
            "option -write_mesh_pieces " + std::to_string(ranks) +
                ": more than the meshes have elements, " + std::to_string(elements) +
                "; give fewer pieces");
  const Partition partition = cut_meshes(scene, whole.meshes, model.interface, ranks);
  model.partition_imbalance = partition.imbalance;
  model.partition_edge_cut = partition.edge_cut;
  Head head{common_kind, ranks, {}, {}};
  for (const Building& building : model.buildings) {
    std::vector<std::string>& files = head.opened.emplace_back(building.findings.files.opened);
    const fs::path folder = folder_of_mesh(scene.structures[head.opened.size() - 1]);
    for (std::string& file : files) file = fs::absolute(file).lexically_relative(folder).string();
  }
  head.ingredients = ingredients_of(scene, head.opened);
  const std::string identity = identity_of(head.ingredients, ranks);
  std::vector<std::unique_ptr<MeshCutter>> cutters;
  for (std::size_t s = 0; s < whole.meshes.size(); ++s) {
    cutters.push_back(
        std::make_unique<MeshCutter>(whole.meshes[s], partition, static_cast<int>(s)));
  }
  fs::create_directories(scene.mesh_pieces);
  remove_pieces(scene);
  double bytes = 0;
  for (int rank = 0; rank < ranks; ++rank) {
    bytes += write_mesh_piece(scene, rank, identity,
                              [&](std::size_t s) { return cutters[s]->parcel(rank); });
  }
  const std::string fresh = common_path(scene) + ".new";
  write_sealed(fresh, [&](ByteWriter& stream) {
    stream(head);
    pass_common(stream, whole, std::as_const(model));
  });
  std::error_code failure;
  fs::rename(fresh, common_path(scene), failure);
  refuse_if(failure.value() != 0,
            common_path(scene) + ": could not be written (" + failure.message() + ")");
  print(partition_facts(model));
  std::printf("pieces: %d in %s, %.4g MB, for runs on as many ranks with -mesh_pieces %s\n", ranks,
              scene.mesh_pieces.c_str(), bytes / 1e6, scene.mesh_pieces.c_str());
}

}  // namespace

void write_mesh_pieces(MPI_Comm comm, Scene& scene, Profile& profile) {
  Model model;
  model.buildings.resize(scene.structures.size());
  on_rank0(comm, [&] { try_folder("mesh_pieces", scene.mesh_pieces); });
  WholeMeshes whole;
  {
    const ScopedTimer timer(profile, Phase::mesh);
    on_rank0(comm, [&] { whole = read_whole_meshes(comm, scene, model); });
  }
  {
    const ScopedTimer timer(profile, Phase::partition);
    on_rank0(comm, [&] {
      const Progress progress(comm, "partition", scene.progress_interval);
      cut_and_write(scene, whole, model);
    });
  }
  std::size_t dofs = 0;
  for (const GlobalMesh& mesh : whole.meshes) dofs += dofs_of(mesh);
  if (rank_of(comm) == 0) print(warning_facts(model.warnings));
  const PhaseReport phases = report_phases(comm, profile, dofs);
  if (rank_of(comm) == 0) print(phase_facts(phases));
}

double write_mesh_piece(const Scene& scene, int rank, const std::string& identity,
                        const std::function<MeshParcel(std::size_t)>& parcel_of) {
  const std::string path = piece_path(scene, rank);
  write_sealed(path, [&](ByteWriter& stream) {
    stream(std::string(piece_kind), identity);
    for (std::size_t s = 0; s < scene.structures.size(); ++s) {
      stream(parcel_of(s));
    }
  });
  return static_cast<double>(fs::file_size(path));
}

CommonPiece read_common_piece(const Scene& scene, int ranks, Model& model) {
  const std::size_t count = scene.structures.size();
  CommonPiece common;
  common.whole.meshes.resize(count);
  read_sealed(scene, common_path(scene), [&](ByteReader& stream) {
    Head head;
    stream(head);
    if (head.kind != common_kind) throw std::runtime_error("another format");
    const Ingredients now = ingredients_of(scene, head.opened);
    const std::string differ = difference(head.ingredients, now);
    if (!differ.empty()) {
      refuse_pieces(scene, "the pieces are of another model (" + differ +
                               "); cut the meshes anew (-write_mesh_pieces " +
                               std::to_string(ranks) + ")");
    }
    if (head.ranks != ranks) {
      refuse_pieces(scene, "the meshes are cut for " + std::to_string(head.ranks) +
                               " ranks, and this run has " + std::to_string(ranks) +
                               "; run it on " + std::to_string(head.ranks) +
                               ", or cut them anew (-write_mesh_pieces " + std::to_string(ranks) +
                               ")");
    }
    common.identity = identity_of(now, ranks);
    pass_common(stream, common.whole, model);
  });
  return common;
}

std::vector<MeshParcel> read_mesh_piece(const Scene& scene, int rank, const std::string& identity) {
  std::vector<MeshParcel> parcels(scene.structures.size());
  read_sealed(scene, piece_path(scene, rank), [&](ByteReader& stream) {
    std::string kind;
    std::string cut;
    stream(kind, cut);
    if (kind != piece_kind || cut != identity) throw std::runtime_error("of another cut");
    for (MeshParcel& parcel : parcels) {
      stream(parcel);
      check_parcel(parcel, scene.structures[&parcel - parcels.data()].regions.size());
    }
  });
  return parcels;
}

}  // namespace pounding
