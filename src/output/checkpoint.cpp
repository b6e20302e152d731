#include "output/checkpoint.h"

#include <cmath>
#include <optional>

#include "common/error.h"
#include "common/parallel.h"
#include "io/hdf5_file.h"
#include "io/new_file.h"
#include "io/schema.h"
#include "mesh/node_table.h"
#include "output/checkpoint_format.h"
#include "output/file_blocks.h"

namespace pounding {
namespace checkpoint_format {

std::function<void()> for_user(const std::string& prefix, const std::function<void()>& work) {
  return [&] {
    try {
      work();
    } catch (const std::exception& error) {
      throw UserError(prefix + error.what());
    }
  };
}

std::vector<double> basis_check(const LinearSystem& system) {
  const GeneralisedCoordinates& coordinates = *system.generalised;
  std::vector<double> sums(system.owned_dofs(), 0.0);
  const std::size_t places = coordinates.rows.empty() ? 0 : coordinates.row_of.size();
  for (std::size_t i = 0; i < sums.size(); ++i) {
    for (std::size_t d = 0; d < 3; ++d) {
      sums[i] += coordinates.influence[d][i] / (system.total_mass * static_cast<double>(d + 1));
    }
    for (std::size_t p = 0; p < places; ++p) {
      sums[i] += coordinates.rows[p * sums.size() + i] * std::sqrt(static_cast<double>(p + 1));
    }
  }
  return sums;
}

}  // namespace checkpoint_format

namespace {

namespace format = checkpoint_format;

/// A file in the making on rank 0, where others have their places to fill in the end; every method
/// is collective.
class CheckpointWriter {
 public:
  CheckpointWriter(MPI_Comm comm, const std::string& path) : comm_(comm), path_(path) {
    on_root([&] { file_.emplace(path_ + ".new", Hdf5File::Kind::sealed); });
  }

  void write_identity(const RunIdentity& identity) {
    on_root([&] {
      file_->write_attribute("/", "format", format::name);
      schema::write(*file_, schema::checkpoint);
      file_->write_attribute("/", "time_step", identity.time_step);
      file_->write_attribute("/", "ground_motion", identity.ground_motion);
      file_->write_attribute("/", "beam_frequency", identity.beam_frequency);
      std::vector<std::string> lines;
      for (const auto& [name, value] : identity.options) lines.push_back(name + ": " + value);
      file_->write_strings("options", lines);
    });
  }

  void write_structure(int structure, const Mesh& mesh, const LinearSystem& system,
                       const SavedState& saved) {
    const std::string folder = format::folder(mesh);
    reserve(folder + "/coordinates", {&mesh, 3, nullptr});
    if (system.generalised) {
      write_table(folder + "/basis_check", 0, gathered(comm_, format::basis_check(system)));
    }
    const std::size_t columns = component_columns(mesh);
    for (const auto& [key, values] : saved.dofs()) {
      const std::string name = folder + "/" + key.second;
      if (key.first == structure && system.generalised) {
        write_table(name, 0, gathered(comm_, values));
      } else if (key.first == structure) {
        reserve(name, {&mesh, columns, &values});
      }
    }
    on_root([&] {
      const GlobalIndex dofs = system.generalised ? system.global_dofs : mesh.global_dofs;
      file_->write_attribute(folder, "dofs", static_cast<double>(dofs));
      file_->write_attribute(folder, "elements", static_cast<double>(format::element_count(mesh)));
    });
  }

  void write_tables(const SavedState& saved) {
    std::map<std::string, SavedState::Table> tables;  // the lowest rank's where several have one
    for_each_rank(comm_, saved.tables(), [&](int, auto& own) { tables.merge(own); });
    on_root([&] {
      for (const auto& [name, table] : tables) {
        file_->write_array("tables/" + name, table.columns, table.values);
      }
    });
    for (const auto& [name, parts] : saved.sums()) {
      write_table("sums/" + name, parts.size(), gathered(comm_, parts));
    }
  }

  /// Every rank fills its places, and the file is on the disk under its final name.
  void finish() {
    on_root([&] { file_->let_others_write(); });
    broadcast_array(comm_, offsets_);
    fill();
    on_root([&] {
      file_->close();
      file_->move_to(path_);
    });
  }

 private:
  /// A dataset with a row per node of a structure, in file order.
  struct NodeTable {
    const Mesh* mesh;
    std::size_t columns;
    const std::vector<double>* values;  ///< over owned dofs; null: coordinates
  };

  void reserve(const std::string& name, const NodeTable& table) {
    on_root([&] {
      const auto nodes = static_cast<std::size_t>(table.mesh->global_nodes);
      offsets_.push_back(file_->reserve(name, {nodes, table.columns}));
    });
    tables_.push_back(table);
  }

  void fill() {
    std::optional<OffsetFile> file;
    on_every_rank([&] { file.emplace(path_ + ".new", OffsetFile::Access::write); });
    std::optional<FileBlocks> blocks;
    for (std::size_t i = 0; i < tables_.size(); ++i) {
      const auto& [mesh, columns, values] = tables_[i];
      if (i == 0 || mesh != tables_[i - 1].mesh) blocks.emplace(*mesh);
      std::vector<double> block(columns * blocks->count());
      if (values == nullptr) {
        blocks->to_file(format::owned_coordinates(*mesh), columns, block);
      } else {
        blocks->to_file(node_rows(*mesh, *values, columns), columns, block);
      }
      const auto before = static_cast<std::int64_t>(columns * sizeof(double)) * blocks->first();
      on_every_rank([&] { file->write(offsets_[i] + before, block); });
    }
    on_every_rank([&] { file->sync(); });
  }

  void on_every_rank(const std::function<void()>& work) {
    pounding::on_every_rank(comm_, format::for_user(failure, work));
  }
  void on_root(const std::function<void()>& work) {
    on_rank0(comm_, format::for_user(failure, work));
  }
  void write_table(const std::string& name, std::size_t columns, const std::vector<double>& table) {
    on_root([&] { file_->write_array(name, columns, table); });
  }

  static constexpr const char* failure = "the checkpoint cannot be written: ";

  MPI_Comm comm_;
  std::string path_;
  std::optional<Hdf5File> file_;  ///< rank 0
  std::vector<NodeTable> tables_;
  std::vector<std::int64_t> offsets_;  ///< of the tables, in the file [bytes]
};

}  // namespace

void write_checkpoint(MPI_Comm comm, const std::string& path, const RunIdentity& identity,
                      std::span<const Mesh> meshes, std::span<const LinearSystem> systems,
                      const SavedState& saved) {
  CheckpointWriter writer(comm, path);
  writer.write_identity(identity);
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    writer.write_structure(static_cast<int>(s), meshes[s], systems[s], saved);
  }
  writer.write_tables(saved);
  writer.finish();
}

}  // namespace pounding
