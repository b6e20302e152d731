#include <filesystem>
#include <fstream>
#include <functional>
#include <unistd.h>

#include <gtest/gtest.h>

#include "common/error.h"
#include "modal/modal_basis_file.h"
#include "support/box_mesh.h"

/// A stored basis is taken only for the structure it was made for.
namespace pounding {
namespace basis_key_test {

namespace fs = std::filesystem;
using testing_support::box_mesh;
using testing_support::solid_structure;

class KeyOfBasis : public ::testing::Test {
 public:
  KeyOfBasis() : folder_(fs::temp_directory_path() / ("basis-key-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    for (const char* name : {"dofs.csv", "stiffness.mtx", "mass.petsc"}) {
      write(name, "0 0 0 1 2 3");
    }
    structure_.matrices = folder_;
    structure_.modal = ModalModel{};
    request_.modes = 7;
    request_.contact_points = {{3, 0}};
  }
  ~KeyOfBasis() override { fs::remove_all(folder_); }

  /// Keeps size and time of a file that is there.
  void write(const std::string& name, const std::string& text) const {
    const fs::path path = folder_ / name;
    const bool old = fs::exists(path);
    const auto time = old ? fs::last_write_time(path) : fs::file_time_type{};
    std::ofstream(path) << text;
    if (old) {
      fs::last_write_time(path, time);
    }
  }

  BasisKey key() const { return basis_key(structure_, mesh_, request_); }

  fs::path folder_;
  pounding::Structure structure_ = solid_structure("box", 30e9, 0.2, 2400);
  GlobalMesh mesh_ = box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  ModalRequest request_;
};

TEST_F(KeyOfBasis, ChangesWithEveryFile) {
  const BasisKey before = key();
  EXPECT_EQ(key(), before);
  for (const char* name : {"dofs.csv", "stiffness.mtx", "mass.petsc"}) {
    write(name, "0 0 0 1 2 4");
    EXPECT_NE(key().at("matrices"), before.at("matrices")) << name;
    write(name, "0 0 0 1 2 3");
    EXPECT_EQ(key(), before) << name;
  }
  fs::rename(folder_ / "mass.petsc", folder_ / "mass.mtx");
  EXPECT_EQ(key(), before);
  fs::remove(folder_ / "dofs.csv");
  EXPECT_THROW(key(), UserError);
}

TEST_F(KeyOfBasis, RefusesOneMatrixInTwoFiles) {
  write("mass.mtx", "0");
  EXPECT_THROW(key(), UserError);
}

TEST_F(KeyOfBasis, ChangesWithTheModel) {
  const BasisKey before = key();
  const auto changes = [&](const std::function<void(KeyOfBasis&)>& change, const char* what) {
    const Structure structure = structure_;
    const GlobalMesh mesh = mesh_;
    const ModalRequest request = request_;
    change(*this);
    const BasisKey after = key();
    for (const auto& [name, hash] : before) {
      EXPECT_EQ(after.at(name) == hash, name != what) << name << " for " << what;
    }
    structure_ = structure;
    mesh_ = mesh;
    request_ = request;
  };
  changes([](KeyOfBasis& k) { k.mesh_.coordinates[5] += 1e-12; }, "mesh");
  changes([](KeyOfBasis& k) { k.structure_.regions[0].material.young += 1; }, "elements");
  changes([](KeyOfBasis& k) { k.structure_.matrices.clear(); }, "matrices");
  changes([](KeyOfBasis& k) { k.request_.candidates = 9; }, "number of vectors");
  changes([](KeyOfBasis& k) { k.request_.attachment = false; }, "number of vectors");
  changes([](KeyOfBasis& k) { k.request_.contact_points[0].component = 1; }, "contact points");
  changes([](KeyOfBasis& k) { k.request_.other_points.push_back({4, 0}); }, "probe points");
}

}  // namespace basis_key_test
}  // namespace pounding
