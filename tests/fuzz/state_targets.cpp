#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>

#include "common/error.h"
#include "common/petsc.h"
#include "driver/mesh_pieces.h"
#include "ensemble/ensemble_file.h"
#include "fuzz/target.h"
#include "io/file_seal.h"
#include "io/matrix_market.h"
#include "mesh/mesh.h"
#include "mesh/partition.h"
#include "modal/modal_basis_file.h"
#include "output/checkpoint.h"
#include "support/box_mesh.h"
#include "system/matrix_system.h"

namespace pounding::fuzz {
namespace {

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// A box of two bricks on one rank, clamped at one end, and a system whose dofs are those of its
/// nodes.
struct BoxModel {
  Mesh mesh;
  LinearSystem system;
};
using Box = std::shared_ptr<const BoxModel>;

Box make_box() {
  GlobalMesh global = testing_support::box_mesh({0, 0, 0}, {2, 1, 1}, {2, 1, 1});
  testing_support::clamp(global, "x_min");
  const Partition partition = partition_meshes({&global, 1}, {}, 1);
  auto box = std::make_shared<BoxModel>();
  box->mesh = distribute_mesh(MPI_COMM_SELF, "box", global, partition, 0);
  return box;
}

const RunIdentity& identity() {
  static const RunIdentity identity{{{"end", "2"}, {"mesh", "box.msh"}}, 1e-3, "0123"};
  return identity;
}

std::string checkpoint_seed(const BoxModel& box, const std::string& folder) {
  SavedState saved;
  const std::vector<double> values(static_cast<std::size_t>(box.mesh.owned_dofs), 0.5);
  for (const char* name : {"displacement", "velocity"}) {
    saved.put_dofs(0, name, values);
  }
  saved.put_sums("energy", std::vector<double>{1, 2, 3});
  saved.put("step", {1000});
  saved.put("impacts", std::vector<double>{0, 1, 2, 3, 4, 5}, 3);
  const std::string path = folder + "/seed.h5";
  write_checkpoint(MPI_COMM_SELF, path, identity(), {&box.mesh, 1}, {&box.system, 1}, saved);
  return content_of(path);
}

/// What a run asks of the state that it continues from.
void read_state(const BoxModel& box, const std::string& path) {
  seal_file(path);
  check_checkpoint(MPI_COMM_SELF, path, identity().options);
  const SavedState saved =
      read_checkpoint(MPI_COMM_SELF, path, identity(), {&box.mesh, 1}, {&box.system, 1});
  std::vector<double> values(static_cast<std::size_t>(box.mesh.owned_dofs));
  std::vector<double> sums(3);
  saved.get_dofs(0, "displacement", values);
  saved.get_dofs(0, "velocity", values);
  saved.get_sums("energy", sums);
  saved.integer("step");
  saved.table("impacts", 3);
}

const BasisKey& key() {
  static const BasisKey key{{"mesh", "0123"}, {"contact points", "4567"}};
  return key;
}

std::string basis_seed(const std::string& folder) {
  ModalBasis basis;
  basis.modes = 2;
  basis.attachment_vectors = 1;
  basis.mode_numbers = {1, 2, 0};
  basis.full_dofs = 24;
  basis.total_mass = 10;
  basis.mass = 8;
  basis.squared_frequency = {1, 4, 9};
  basis.participation.assign(18, 0.1);
  basis.points = {{3, 0}, {3, 1}};
  basis.rows.assign(6, 0.2);
  const std::string path = folder + "/seed.h5";
  write_modal_basis(path, key(), basis);
  return content_of(path);
}

/// What is said of a basis becomes a UserError in the program.
void read_basis(const std::string& path, Random&) {
  try {
    seal_file(path);
    read_modal_basis(path, key());
  } catch (const std::runtime_error& error) {
    throw UserError(error.what());
  }
}

/// A scene of one structure whose piece lies in a folder.
Scene scene_in_pieces(const std::string& folder) {
  Scene scene;
  scene.mesh_pieces = folder;
  scene.structures.resize(1);
  scene.structures[0].regions.resize(1);
  return scene;
}

std::string piece_seed(const std::string& folder) {
  GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {2, 1, 1}, {2, 1, 1});
  testing_support::clamp(mesh, "x_min");
  const Partition partition = partition_meshes({&mesh, 1}, {}, 2);
  const MeshCutter cutter(mesh, partition, 0);
  write_mesh_piece(scene_in_pieces(folder), 0, "cut",
                   [&](std::size_t) { return cutter.parcel(0); });
  return content_of(folder + "/piece-00000.bin");
}

void read_piece(const std::string& path, Random&) {
  seal_file(path);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  for (MeshParcel& parcel : read_mesh_piece(scene_in_pieces(folder), 0, "cut")) {
    join_parcel(MPI_COMM_SELF, "box", std::move(parcel), NodeMarks{});
  }
}

/// Three members of a scene with one contact.
const EnsembleLayout& layout() {
  static const MemberTable table{
      "members.csv", {"motion_level", "joint_gap"}, {2, 3, 4}, {"1", "0.1", "2", "", "1", "0.2"}};
  static const EnsembleLayout layout{&table,       {"top x", "top y"},
                                     {0.02, 0.05}, {1, 2, 4},
                                     {"joint"},    {0},
                                     {1, 2, 3},    {"option a 1", "columns", "member 1"},
                                     {"bridge"}};
  return layout;
}

std::string ensemble_seed(const std::string& folder) {
  const std::string path = folder + "/seed-ensemble.h5";
  EnsembleFile::prepare(path, layout());
  const EnsembleFile file(path, layout());
  MemberResult result = file.read(0);
  for (const auto values :
       {&MemberResult::spectra, &MemberResult::episodes, &MemberResult::displacement}) {
    std::ranges::fill(result.*values, 0.5);
  }
  EnsembleFile(path, layout()).write(1, result);
  return content_of(path);
}

/// What a run that goes on asks of its file.
void read_ensemble(const std::string& path, Random&) {
  seal_file(path, open_bytes(path));
  EnsembleFile::refuse_another(path, layout());
  const EnsembleFile file(path, layout());
  file.damaged();
  const std::vector<bool> done = file.done();
  for (std::size_t m = 0; m < done.size(); ++m) {
    if (done[m]) file.read(m);
  }
}

std::string binary_seed(const std::string& folder) {
  const std::string path = folder + "/seed.petsc";
  MatHandle matrix;
  POUNDING_PETSC(MatCreateSeqAIJ(PETSC_COMM_SELF, 4, 4, 4, nullptr, matrix.out()));
  for (PetscInt row = 0; row < 4; ++row) {
    for (PetscInt column = 0; column < 4; ++column) {
      POUNDING_PETSC(MatSetValue(matrix.get(), row, column, row == column ? 4 : -1, INSERT_VALUES));
    }
  }
  POUNDING_PETSC(MatAssemblyBegin(matrix.get(), MAT_FINAL_ASSEMBLY));
  POUNDING_PETSC(MatAssemblyEnd(matrix.get(), MAT_FINAL_ASSEMBLY));
  PetscViewer viewer = nullptr;
  POUNDING_PETSC(PetscViewerBinaryOpen(PETSC_COMM_SELF, path.c_str(), FILE_MODE_WRITE, &viewer));
  POUNDING_PETSC(MatView(matrix.get(), viewer));
  POUNDING_PETSC(PetscViewerDestroy(&viewer));
  return content_of(path);
}

void read_entries(const std::string& path, Random&) {
  double sum = 0;
  read_matrix(path, [&](const MatrixEntry& entry) { sum += entry.value; });
}

/// A folder of matrices of the box, one file of which is the seed: its places, or its mass.
struct Matrices {
  std::string folder;
  std::string places;
  std::string mass;
  Structure structure;
  Box box;

  Matrices(Box of, const std::string& parent) : folder(parent + "/matrices"), box(std::move(of)) {
    std::filesystem::create_directories(folder);
    structure = testing_support::solid_structure("box", 30e9, 0.2, 2400);
    structure.matrices = folder;
    const char* const components[] = {"ux", "uy", "uz"};
    std::ostringstream rows;
    std::ostringstream diagonal;
    std::ostringstream stiffness;
    const Mesh& mesh = box->mesh;
    rows << "x,y,z,component\n";
    const int count = static_cast<int>(mesh.owned_dofs);
    diagonal << "%%MatrixMarket matrix coordinate real general\n"
             << count << " " << count << " " << count << "\n";
    stiffness << "%%MatrixMarket matrix coordinate real symmetric\n"
              << count << " " << count << " " << count << "\n";
    int number = 0;
    for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
      for (int c = 0; c < 3; ++c) {
        if (mesh.dof(node, c) >= 0) {
          const Vector3 x = mesh.position(node);
          ++number;
          rows << x[0] << "," << x[1] << "," << x[2] << "," << components[c] << "\n";
          diagonal << number << " " << number << " 100.5\n";
          stiffness << number << " " << number << " 1e9\n";
        }
      }
    }
    places = rows.str();
    mass = diagonal.str();
    write("dofs.csv", places);
    write("mass.mtx", mass);
    write("stiffness.mtx", stiffness.str());
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder + "/" + name, std::ios::binary) << text;
  }

  /// Builds the box with one of its files taken from `path`.
  void build_with(const std::string& name, const std::string& path,
                  const std::string& sound) const {
    write(name, content_of(path));
    try {
      build_matrix_system(structure, box->mesh);
    } catch (...) {
      write(name, sound);
      throw;
    }
    write(name, sound);
  }
};

}  // namespace

std::vector<Target> state_targets(const std::string& folder) {
  const Box box = make_box();
  const auto matrices = std::make_shared<const Matrices>(box, folder);
  const std::vector<std::string> market{
      "%%MatrixMarket matrix coordinate real general\n% a comment\n3 3 4\n1 1 2.5\n"
      "2 2 2.5\n3 3 1e3\n1 3 -1\n",
      "%%MatrixMarket matrix coordinate real symmetric\n3 3 4\n1 1 2.5\n2 2 2.5\n"
      "3 3 1e3\n3 1 -1\n",
      "%%MatrixMarket matrix array real general\n3 1\n1.5\n2.5\n3.5\n"};
  const std::vector<std::string> words{"%%MatrixMarket matrix coordinate real general\n",
                                       "symmetric",
                                       "array",
                                       "integer",
                                       "%",
                                       " ",
                                       "\r\n",
                                       "1 1 1\n"};
  std::vector<Target> targets;
  targets.push_back({"market", market, words, read_entries, "matrix.mtx"});
  targets.push_back({"binary", {binary_seed(folder)}, {}, read_entries, "matrix.petsc"});
  targets.push_back({"places",
                     {matrices->places},
                     {",", "ux", "rx", "#", "x,y,z", "\r"},
                     [matrices](const std::string& path, Random&) {
                       matrices->build_with("dofs.csv", path, matrices->places);
                     },
                     "places.csv"});
  targets.push_back({"mass",
                     {matrices->mass},
                     words,
                     [matrices](const std::string& path, Random&) {
                       matrices->build_with("mass.mtx", path, matrices->mass);
                     },
                     "mass.csv"});
  targets.push_back({"checkpoint",
                     {checkpoint_seed(*box, folder)},
                     {},
                     [box](const std::string& path, Random&) { read_state(*box, path); },
                     "checkpoint.h5",
                     true});
  targets.push_back({"basis", {basis_seed(folder)}, {}, read_basis, "basis.h5", true});
  targets.push_back({"ensemble", {ensemble_seed(folder)}, {}, read_ensemble, "ensemble.h5", true});
  targets.push_back({"piece", {piece_seed(folder)}, {}, read_piece, "piece-00000.bin"});
  return targets;
}

}  // namespace pounding::fuzz
