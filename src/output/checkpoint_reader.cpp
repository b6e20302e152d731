#include <algorithm>
#include <cmath>
#include <optional>

#include "common/facts.h"
#include "common/parallel.h"
#include "io/hdf5_reader.h"
#include "io/schema.h"
#include "mesh/node_table.h"
#include "output/checkpoint.h"
#include "output/checkpoint_format.h"
#include "output/file_blocks.h"

namespace pounding {
namespace {

namespace format = checkpoint_format;

const std::string option = "option -restart ";

/// This rank's parts out of rank 0's table of shape (ranks that wrote it, `columns`): its own row
/// if as many ranks wrote it, else the column sums on rank 0 and zeros elsewhere.
std::vector<double> scatter_parts(MPI_Comm comm, const std::vector<double>& table,
                                  std::size_t columns) {
  std::vector<double> rows;
  if (rank_of(comm) == 0) {
    rows.assign(columns * static_cast<std::size_t>(size_of(comm)), 0.0);
    if (table.size() == rows.size()) {
      rows = table;
    } else {
      for (std::size_t i = 0; i < table.size(); ++i) rows[i % columns] += table[i];
    }
  }
  const int count = static_cast<int>(columns);
  std::vector<double> mine(columns);
  MPI_Scatter(rows.data(), count, MPI_DOUBLE, mine.data(), count, MPI_DOUBLE, 0, comm);
  return mine;
}

/// This rank's `count` values out of rank 0's of all ranks, rank after rank.
std::vector<double> scatter_owned(MPI_Comm comm, const std::vector<double>& all,
                                  std::size_t count) {
  const std::vector<int> counts = gather_rows(comm, std::vector<int>{static_cast<int>(count)});
  const std::vector<int> offsets = starts_of(counts);
  std::vector<double> mine(count);
  MPI_Scatterv(all.data(), counts.data(), offsets.data(), MPI_DOUBLE, mine.data(),
               static_cast<int>(count), MPI_DOUBLE, 0, comm);
  return mine;
}

using Options = std::map<std::string, std::string>;

/// A file that was written by the program. Rank 0 looks at it, every rank reads its part of what
/// nodes have. The methods are collective.
class CheckpointReader {
 public:
  CheckpointReader(MPI_Comm comm, const std::string& path) : comm_(comm), path_(path) {
    on_root([&] {
      file_.emplace(path, Hdf5Reader::Kind::sealed);
      if (!is_checkpoint()) refuse("an HDF5 file, but not a checkpoint");
      require_schema();
    });
  }

  void check_options(const Options& options) {
    on_root([&] {
      Options written;
      for (const std::string& line : file_->strings("options")) {
        const std::size_t colon = line.find(": ");
        written[line.substr(0, colon)] =
            colon == std::string::npos ? std::string() : line.substr(colon + 2);
      }
      for (const auto& [name, value] : options) {
        const auto before = written.find(name);
        if (before == written.end()) refuse("written without the option -" + name + " " + value);
        refuse_if(before->second != value, "written with -" + name + " " + before->second +
                                               ", now it is " + value +
                                               "; give the same or start anew");
      }
      for (const auto& [name, value] : written) {
        refuse_if(!options.contains(name),
                  "written with -" + name + " " + value + ", now it is not there");
      }
    });
  }

  void check_motion(const RunIdentity& identity) {
    on_root([&] {
      const double before = file_->number("/", "time_step");
      refuse_if(before != identity.time_step,
                sentence("written with the time step {:.17g} s, now it is {:.17g} s; give "
                         "-time_step {:.17g}",
                         {before, identity.time_step, before}));
      refuse_if(file_->text("/", "ground_motion") != identity.ground_motion,
                "written under another ground motion or other loads; give the same or start anew");
      const double frequency = file_->number("/", "beam_frequency");
      refuse_if(frequency != identity.beam_frequency,
                sentence("its beams were made for spectra up to {} Hz, now they would be for {} "
                         "Hz; give -spectra_frequencies that end there",
                         {frequency, identity.beam_frequency}));
    });
  }

  void read_structure(int structure, const Mesh& mesh, const LinearSystem& system,
                      SavedState& saved) {
    const std::string folder = format::folder(mesh);
    const GlobalIndex dofs = system.generalised ? system.global_dofs : mesh.global_dofs;
    on_root([&] {
      check_count(mesh, "nodes", file_->shape(folder + "/coordinates").rows, mesh.global_nodes);
      check_count(mesh, "free dofs", file_->number(folder, "dofs"), dofs);
      check_count(mesh, "elements", file_->number(folder, "elements"), format::element_count(mesh));
    });
    FileBlocks blocks(mesh);
    check_coordinates(folder, mesh, blocks);
    if (system.generalised) check_basis(folder, system);
    const std::size_t columns = system.generalised ? 0 : component_columns(mesh);
    for (const std::string& name : names(folder)) {
      if (name == "coordinates" || name == "basis_check") continue;
      const std::string place = folder + "/" + name;
      saved.put_dofs(structure, name,
                     system.generalised ? read_coordinates(place, system)
                                        : read_nodes(place, mesh, columns, blocks));
    }
  }

  void check_basis(const std::string& folder, const LinearSystem& system) {
    const std::vector<double> now = gathered(comm_, format::basis_check(system));
    on_root([&] {
      const std::vector<double> written = file_->array(folder + "/basis_check");
      double largest = 0;
      double difference = written.size() == now.size() ? 0 : 1e300;
      for (std::size_t i = 0; i < now.size() && written.size() == now.size(); ++i) {
        largest = std::max(largest, std::abs(now[i]));
        difference = std::max(difference, std::abs(now[i] - written[i]));
      }
      refuse_if(!(difference <= format::basis_tolerance * largest),
                "structure " + system.name +
                    " was in it with another modal basis; keep the basis " + "in a file, -" +
                    system.name + "_modal_basis");
    });
  }

  void read_tables(SavedState& saved) {
    std::map<std::string, SavedState::Table> tables;
    on_root([&] {
      for (const std::string& name : file_->names("tables")) {
        const std::string place = "tables/" + name;
        tables[name] = {file_->shape(place).columns, finite_array(place)};
      }
    });
    broadcast_values(comm_, 0, tables);
    for (const auto& [name, table] : tables) saved.put(name, table.values, table.columns);
    for (const std::string& name : names("sums")) {
      std::vector<double> table;
      std::uint64_t columns = 0;
      on_root([&] {
        table = finite_array("sums/" + name);
        columns = file_->shape("sums/" + name).columns;
        if (columns == 0) refuse("'sums/" + name + "' does not have one row per rank");
      });
      MPI_Bcast(&columns, 1, MPI_UINT64_T, 0, comm_);
      saved.put_sums(name, scatter_parts(comm_, table, columns));
    }
  }

 private:
  void on_root(const std::function<void()>& work) {
    on_rank0(comm_, format::for_user(option, work));
  }
  void on_every_rank(const std::function<void()>& work) {
    pounding::on_every_rank(comm_, format::for_user(option, work));
  }
  void refuse_if(bool wrong, const std::string& why) const {
    if (wrong) refuse(why);
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw std::runtime_error(path_ + ": " + why);
  }

  void require_schema() const {
    try {
      schema::require(*file_, schema::checkpoint);
    } catch (const std::runtime_error& error) {
      refuse(std::string("a checkpoint ") + error.what() +
             "; continue it with the program that wrote it, or start anew");
    }
  }

  /// A dataset without infinities and NaN.
  std::vector<double> finite_array(const std::string& place) const {
    std::vector<double> values = file_->array(place);
    require_finite(place, values, 0);
    return values;
  }

  /// `values`: whole rows of a dataset, from row `first` on.
  void require_finite(const std::string& place, std::span<const double> values,
                      std::size_t first) const {
    const auto bad = std::ranges::find_if(values, [](double v) { return !std::isfinite(v); });
    if (bad == values.end()) return;
    const std::size_t columns = std::max<std::size_t>(1, file_->shape(place).columns);
    refuse("'" + place + "' holds " + std::to_string(*bad) + " in row " +
           std::to_string(first + static_cast<std::size_t>(bad - values.begin()) / columns + 1) +
           "; the file was changed");
  }

  /// Rows of a dataset per node of this rank's block.
  std::vector<double> read_block(const std::string& place, const FileBlocks& blocks) {
    std::vector<double> block;
    on_every_rank([&] {
      if (!file_) file_.emplace(path_);
      block = file_->rows(place, static_cast<std::size_t>(blocks.first()), blocks.count());
      require_finite(place, block, static_cast<std::size_t>(blocks.first()));
    });
    return block;
  }

  void check_coordinates(const std::string& folder, const Mesh& mesh, FileBlocks& blocks) {
    const std::string place = folder + "/coordinates";
    check_rows(place, 3, mesh.global_nodes, "node");
    std::vector<double> now(3 * blocks.count());
    blocks.to_file(format::owned_coordinates(mesh), 3, now);
    const std::vector<double> written = read_block(place, blocks);
    on_every_rank([&] {
      refuse_if(written != now,
                "structure " + mesh.structure + " has its nodes elsewhere: another mesh");
    });
  }

  std::vector<double> read_nodes(const std::string& place, const Mesh& mesh, std::size_t columns,
                                 FileBlocks& blocks) {
    check_rows(place, columns, mesh.global_nodes, "node");
    const std::vector<double> block = read_block(place, blocks);
    std::vector<double> rows(columns * static_cast<std::size_t>(mesh.owned_nodes));
    blocks.to_owners(block, columns, rows);
    return dof_values(mesh, rows, columns);
  }

  std::vector<double> read_coordinates(const std::string& place, const LinearSystem& system) {
    check_rows(place, 0, system.global_dofs, "generalised coordinate");
    std::vector<double> values;
    on_root([&] { values = finite_array(place); });
    return scatter_owned(comm_, values, system.lumped_mass.size());
  }

  void check_rows(const std::string& place, std::size_t columns, GlobalIndex rows, const char* of) {
    on_root([&] {
      const Hdf5Reader::Shape shape = file_->shape(place);
      refuse_if(shape.columns != columns || static_cast<GlobalIndex>(shape.rows) != rows,
                "'" + place + "' does not have one row per " + of);
    });
  }

  bool is_checkpoint() const {
    try {
      return file_->text("/", "format") == format::name;
    } catch (const std::exception&) {
      return false;
    }
  }

  template <typename Found>
  void check_count(const Mesh& mesh, const char* what, Found found, GlobalIndex now) const {
    refuse_if(static_cast<GlobalIndex>(found) != now,
              "structure " + mesh.structure + " has " +
                  std::to_string(static_cast<GlobalIndex>(found)) + " " + what + " in it, now " +
                  std::to_string(now) + ": another mesh");
  }

  /// Names of a group, on every rank.
  std::vector<std::string> names(const std::string& group) {
    std::vector<std::string> result;
    on_root([&] { result = file_->names(group); });
    broadcast_values(comm_, 0, result);
    return result;
  }

  MPI_Comm comm_;
  std::string path_;
  std::optional<Hdf5Reader> file_;  ///< on rank 0, which found it sound, then where it is read
};

}  // namespace

void check_checkpoint(MPI_Comm comm, const std::string& path, const Options& options) {
  CheckpointReader(comm, path).check_options(options);
}

SavedState read_checkpoint(MPI_Comm comm, const std::string& path, const RunIdentity& identity,
                           std::span<const Mesh> meshes, std::span<const LinearSystem> systems) {
  CheckpointReader reader(comm, path);
  reader.check_options(identity.options);
  reader.check_motion(identity);
  SavedState saved(option + path);
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    reader.read_structure(static_cast<int>(s), meshes[s], systems[s], saved);
  }
  reader.read_tables(saved);
  return saved;
}

}  // namespace pounding
