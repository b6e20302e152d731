#include "output/checkpoint.h"

#include <cmath>
#include <filesystem>
#include <unistd.h>

#include <gtest/gtest.h>

#include "common/error.h"
#include "common/parallel.h"
#include "common/petsc.h"
#include "mesh/node_table.h"
#include "output/file_blocks.h"
#include "support/box_mesh.h"

namespace pounding {
namespace checkpoint_test {

namespace fs = std::filesystem;

const LinearSystem full;  // a model whose dofs are components of nodes

/// A box whose nodes rotate from the middle on and are clamped at one end.
GlobalMesh mixed_box(double length = 3) {
  GlobalMesh global = testing_support::box_mesh({0, 0, 0}, {length, 1, 1}, {9, 2, 2});
  for (std::size_t node = 0; node < global.node_tags.size(); ++node) {
    if (global.coordinates[3 * node] > length / 2) {
      global.free_components[node] = 0x3f;
    }
  }
  testing_support::clamp(global, "x_min");
  return global;
}

Mesh distribute(MPI_Comm comm, const GlobalMesh& global) {
  Partition partition;
  if (rank_of(comm) == 0) {
    partition = partition_meshes({&global, 1}, {}, size_of(comm));
  }
  return distribute_mesh(comm, "box", global, partition, 0);
}

/// A value that tells node and component, on the owned dofs of any partition.
std::vector<double> labels(const Mesh& mesh, double offset) {
  std::vector<double> values(static_cast<std::size_t>(mesh.owned_dofs));
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    for (int component = 0; component < 6; ++component) {
      const LocalIndex dof = mesh.dof(node, component);
      if (dof >= 0) {
        const auto number = static_cast<double>(mesh.file_node[static_cast<std::size_t>(node)]);
        values[static_cast<std::size_t>(dof)] = offset + number + 0.1 * component;
      }
    }
  }
  return values;
}

class CheckpointFile : public ::testing::Test {
 protected:
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const int ranks = size_of(comm);
  const int rank = rank_of(comm);
  const RunIdentity identity{{{"end", "2"}, {"mesh", "box: of \"brick\""}}, 1e-3, "0123"};

  CheckpointFile() {
    std::string name = "pounding-checkpoint-" + std::to_string(getpid());
    broadcast(comm, name);
    folder_ = fs::temp_directory_path() / name;
    fs::create_directories(folder_);
    MPI_Barrier(comm);
  }
  ~CheckpointFile() override {
    MPI_Barrier(comm);
    if (rank == 0) {
      fs::remove_all(folder_);
    }
  }

  std::string path() const { return folder_ / "checkpoint.h5"; }

  /// Every rank has sums, rank 1 (or the only one) a table of its own, all of them another one.
  void write(const Mesh& mesh) const {
    SavedState saved;
    saved.put_dofs(0, "displacement", labels(mesh, 0));
    saved.put_dofs(0, "velocity", labels(mesh, 1000));
    saved.put_sums("energy", std::vector<double>{1.0 + rank, 10.0 * rank, 0.5});
    saved.put("of_all", {static_cast<double>(rank)});
    if (rank == std::min(1, ranks - 1)) {
      saved.put("of_one", std::vector<double>{1, 2, 3, 4}, 2);
    }
    saved.put("empty", {}, 3);
    write_checkpoint(comm, path(), identity, {&mesh, 1}, {&full, 1}, saved);
  }

  std::string refusal(const RunIdentity& other, const Mesh& mesh) const {
    try {
      read_checkpoint(comm, path(), other, {&mesh, 1}, {&full, 1});
    } catch (const UserError& error) {
      return error.what();
    }
    return "accepted";
  }

 private:
  fs::path folder_;
};

void expect_dofs(const SavedState& saved, const Mesh& mesh) {
  std::vector<double> values(static_cast<std::size_t>(mesh.owned_dofs));
  saved.get_dofs(0, "displacement", values);
  EXPECT_EQ(values, labels(mesh, 0));
  saved.get_dofs(0, "velocity", values);
  EXPECT_EQ(values, labels(mesh, 1000));
  EXPECT_EQ(saved.number("of_all"), 0);
  EXPECT_EQ(saved.table("of_one", 2), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_TRUE(saved.table("empty", 3).empty());
}

TEST_F(CheckpointFile, ComesBackOnTheSameRanks) {
  const Mesh mesh = distribute(comm, mixed_box());
  write(mesh);
  EXPECT_FALSE(fs::exists(path() + ".new"));
  check_checkpoint(comm, path(), identity.options);
  const SavedState saved = read_checkpoint(comm, path(), identity, {&mesh, 1}, {&full, 1});
  expect_dofs(saved, mesh);
  std::vector<double> sums(3);
  saved.get_sums("energy", sums);
  EXPECT_EQ(sums, (std::vector<double>{1.0 + rank, 10.0 * rank, 0.5}));
}

TEST_F(CheckpointFile, ComesBackOnOneRank) {
  write(distribute(comm, mixed_box()));
  const Mesh whole = distribute(MPI_COMM_SELF, mixed_box());
  const SavedState saved =
      read_checkpoint(MPI_COMM_SELF, path(), identity, {&whole, 1}, {&full, 1});
  expect_dofs(saved, whole);
  std::vector<double> sums(3);
  saved.get_sums("energy", sums);
  EXPECT_DOUBLE_EQ(sums[0], ranks * (ranks + 1) / 2.0);
  EXPECT_DOUBLE_EQ(sums[1], 10.0 * ranks * (ranks - 1) / 2.0);
  EXPECT_DOUBLE_EQ(sums[2], 0.5 * ranks);
}

TEST_F(CheckpointFile, OfOneRankComesBackOnAll) {
  if (rank == 0) {
    const Mesh whole = distribute(MPI_COMM_SELF, mixed_box());
    SavedState saved;
    saved.put_dofs(0, "velocity", labels(whole, 7));
    saved.put_sums("energy", std::vector<double>{3});
    write_checkpoint(MPI_COMM_SELF, path(), identity, {&whole, 1}, {&full, 1}, saved);
  }
  MPI_Barrier(comm);
  const Mesh mesh = distribute(comm, mixed_box());
  const SavedState saved = read_checkpoint(comm, path(), identity, {&mesh, 1}, {&full, 1});
  std::vector<double> values(static_cast<std::size_t>(mesh.owned_dofs));
  saved.get_dofs(0, "velocity", values);
  EXPECT_EQ(values, labels(mesh, 7));
  std::vector<double> sum(1);
  saved.get_sums("energy", sum);
  EXPECT_EQ(sum[0], rank == 0 ? 3 : 0);
}

TEST_F(CheckpointFile, OfAnotherSceneIsRefusedOnEveryRank) {
  const Mesh mesh = distribute(comm, mixed_box());
  write(mesh);
  const auto says = [&](const RunIdentity& other, const Mesh& now, const std::string& words) {
    const std::string message = refusal(other, now);
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_NE(message.find(path()), std::string::npos) << message;
  };
  EXPECT_EQ(refusal(identity, mesh), "accepted");
  RunIdentity other = identity;
  other.options["end"] = "3";
  says(other, mesh, "written with -end 2, now it is 3");
  other.options.erase("end");
  says(other, mesh, "written with -end 2, now it is not there");
  other = identity;
  other.options["more"] = "1";
  says(other, mesh, "written without the option -more 1");
  other = identity;
  other.time_step *= 1 + 1e-15;
  says(other, mesh, "written with the time step 0.001");
  other = identity;
  other.ground_motion = "4567";
  says(other, mesh, "another ground motion");
  says(identity, distribute(comm, mixed_box(3.1)), "structure box has its nodes elsewhere");
  GlobalMesh freer = mixed_box();
  freer.free_components[5] ^= 0x38;
  says(identity, distribute(comm, freer), "free dofs in it");
  says(identity, distribute(comm, testing_support::box_mesh({0, 0, 0}, {3, 1, 1}, {8, 2, 2})),
       "nodes in it");
}

TEST_F(CheckpointFile, ThatCannotBeWrittenIsReportedOnEveryRank) {
  const Mesh mesh = distribute(comm, mixed_box());
  EXPECT_THROW(write_checkpoint(comm, path() + "/nowhere.h5", identity, {&mesh, 1}, {&full, 1},
                                SavedState("here")),
               UserError);
}

TEST_F(CheckpointFile, TellsTheRowOfAValueThatCannotBe) {
  // A row of the last block: that of the last rank, which rank 0 does not read.
  const Mesh mesh = distribute(comm, mixed_box());
  SavedState saved("here");
  std::vector<double> values = labels(mesh, 0);
  const LocalIndex node = mesh.owned_node(mesh.global_nodes - 1);
  if (node >= 0) values[static_cast<std::size_t>(mesh.dof(node, 2))] = NAN;
  saved.put_dofs(0, "velocity", values);
  write_checkpoint(comm, path(), identity, {&mesh, 1}, {&full, 1}, saved);
  const std::string message = refusal(identity, mesh);
  EXPECT_NE(message.find("structures/box/velocity' holds nan in row " +
                         std::to_string(mesh.global_nodes) + ";"),
            std::string::npos)
      << message;
}

TEST(FileBlocks, RowsComeToTheirPlacesAndBack) {
  const Mesh mesh = distribute(PETSC_COMM_WORLD, mixed_box());
  FileBlocks blocks(mesh);
  GlobalIndex nodes = static_cast<GlobalIndex>(blocks.count());
  EXPECT_LE(nodes, (mesh.global_nodes + size_of(mesh.comm) - 1) / size_of(mesh.comm));
  MPI_Allreduce(MPI_IN_PLACE, &nodes, 1, MPI_INT64_T, MPI_SUM, mesh.comm);
  EXPECT_EQ(nodes, mesh.global_nodes);
  for (const std::size_t columns : {6, 3, 1, 6}) {  // one after the other: room is used again
    std::vector<double> owned;
    for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
      for (std::size_t c = 0; c < columns; ++c) {
        owned.push_back(static_cast<double>(mesh.file_node[node]) + 0.1 * static_cast<double>(c));
      }
    }
    std::vector<double> block(columns * blocks.count());
    blocks.to_file(owned, columns, block);
    for (std::size_t i = 0; i < block.size(); ++i) {
      EXPECT_EQ(block[i], static_cast<double>(blocks.first()) + static_cast<double>(i / columns) +
                              0.1 * static_cast<double>(i % columns));
    }
    std::vector<double> back(owned.size());
    blocks.to_owners(block, columns, back);
    EXPECT_EQ(back, owned);
  }
}

TEST(NodeTable, ColumnsFollowFromTheRotations) {
  EXPECT_EQ(component_columns(distribute(PETSC_COMM_WORLD, mixed_box())), 6u);
  EXPECT_EQ(component_columns(distribute(
                PETSC_COMM_WORLD, testing_support::box_mesh({0, 0, 0}, {3, 1, 1}, {9, 2, 2}))),
            3u);
}

TEST(NodeTable, RowsAreNodesInFileOrder) {
  const GlobalMesh global = mixed_box();
  const Mesh mesh = distribute(PETSC_COMM_WORLD, global);
  const std::vector<double> table = gather_by_node(mesh, labels(mesh, 1), 6);
  const std::vector<double> positions = gather_coordinates(mesh);
  if (rank_of(PETSC_COMM_WORLD) != 0) {
    EXPECT_TRUE(table.empty());
    EXPECT_TRUE(positions.empty());
    return;
  }
  EXPECT_EQ(positions, global.coordinates);
  ASSERT_EQ(table.size(), 6 * global.node_tags.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    const bool is_free = (global.free_components[i / 6] >> (i % 6) & 1) != 0;
    EXPECT_EQ(table[i],
              is_free ? 1 + static_cast<double>(i / 6) + 0.1 * static_cast<int>(i % 6) : 0);
  }
}

}  // namespace checkpoint_test
}  // namespace pounding
