#include "driver/matrix_export.h"

#include <algorithm>
#include <filesystem>
#include <span>

#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "common/petsc.h"
#include "common/types.h"
#include "io/csv_file.h"
#include "io/matrix_market.h"
#include "io/new_file.h"
#include "system/damping_matrix.h"

namespace pounding {
namespace {

/// A free dof as it is in dofs.csv.
struct Dof {
  GlobalIndex node = 0;  ///< file order
  int component = 0;
  GlobalIndex number = 0;  ///< PETSc's
  Vector3 position{0, 0, 0};
  double mass = 0;
  std::size_t label = 0;  ///< among the labels
};

/// Uniform damping, which no matrix holds.
void write_filters(const std::string& folder, const LinearSystem& system) {
  if (!system.uniform_damping) return;
  const UniformDamping& damping = *system.uniform_damping;
  CsvFile file(folder + "uniform_damping.csv");
  file.comment(sentence(
      "in place of K: s G K, G = 1 + sum weight i omega / (rate + i omega), s = {:.17g}; rate in "
      "rad/s",
      {damping.at_rest()}));
  file.header("weight,rate");
  for (const DampingFilter& filter : damping.filters) file.row("", {filter.weight, filter.rate});
  file.close();
}

/// One structure's files; on rank 0 it knows all dofs.
class Export {
 public:
  Export(MPI_Comm comm, const Scene& scene, const Model& model, std::size_t structure)
      : comm_(comm), scene_(scene), model_(model), structure_(structure) {
    const Mesh& mesh = model.meshes[structure];
    std::vector<Dof> mine;
    for_each_owned_dof(mesh, [&](LocalIndex dof, LocalIndex node, int c) {
      mine.push_back({mesh.file_node[node], c, mesh.dof_global(node, c), mesh.position(node),
                      model.systems[structure].lumped_mass[dof]});
    });
    dofs_ = gathered(comm, std::move(mine));
    gather_labels();
    for (std::size_t i = 0; i < dofs_.size(); ++i) dofs_[i].label = i;
    std::ranges::sort(dofs_, {}, [](const Dof& dof) { return std::pair(dof.node, dof.component); });
    place_.resize(dofs_.size());
    for (std::size_t i = 0; i < dofs_.size(); ++i) {
      place_[dofs_[i].number] = static_cast<PetscInt>(i);
    }
  }

  void write() {
    const LinearSystem& system = model_.systems[structure_];
    const std::string folder = scene_.export_matrices + "/" + system.name + "/";
    on_rank0(comm_, [&] {
      std::error_code failure;
      require_no_link(scene_.export_matrices + "/" + system.name);
      std::filesystem::create_directories(folder, failure);
      refuse_if(failure.value() != 0, "option -export_matrices " + scene_.export_matrices +
                                          ": the folder cannot be created or written");
      write_dofs(folder);
      write_influence(folder);
      write_loads(folder);
      write_contact(folder);
      write_probes(folder);
    });
    write_square(folder + "stiffness.mtx", "stiffness, N/m and so on", system.stiffness->matrix());
    on_rank0(comm_, [&] { write_filters(folder, system); });
    const MatHandle damping =
        damping_matrix(scene_.structures[structure_], model_.meshes[structure_], system);
    if (damping.get() != nullptr) {
      write_square(folder + "damping.mtx", "damping beside alpha M + beta K, N s/m and so on",
                   damping.get());
    }
  }

 private:
  PetscInt size() const { return static_cast<PetscInt>(dofs_.size()); }

  /// Labels of the nodes: those of imported matrices, in the order of the ranks, else the numbers
  /// in the mesh file; none where the mesh came in pieces. Collective.
  void gather_labels() {
    labels_ = gathered(comm_, model_.systems[structure_].node_labels);
    if (!labels_.empty() || model_.node_tags.empty()) return;
    for (const Dof& dof : dofs_) {
      labels_.push_back(std::to_string(model_.node_tags[structure_][dof.node]));
    }
  }

  void write_dofs(const std::string& folder) const {
    CsvFile file(folder + "dofs.csv");
    file.comment("rows of the matrices of " + model_.systems[structure_].name + "; m");
    file.header(labels_.empty() ? "x,y,z,component" : "x,y,z,component,node");
    std::vector<MatrixEntry> masses;
    for (const Dof& dof : dofs_) {
      const std::string place = sentence(
          "{:.17g},{:.17g},{:.17g},{}",
          {dof.position[0], dof.position[1], dof.position[2], component_names[dof.component]});
      file.row(labels_.empty() ? place : place + "," + labels_[dof.label], {});
      masses.push_back({static_cast<PetscInt>(masses.size()), 0, dof.mass});
    }
    file.close();
    write_matrix(folder + "mass.mtx", "lumped masses, kg and kg m2", {size(), 1}, masses);
  }

  void write_influence(const std::string& folder) const {
    std::vector<MatrixEntry> entries;
    for (std::size_t i = 0; i < dofs_.size(); ++i) {
      if (dofs_[i].component < 3) {
        entries.push_back({static_cast<PetscInt>(i), dofs_[i].component, 1});
      }
    }
    write_matrix(folder + "influence.mtx", "columns: ground motion along x, y, z", {size(), 3},
                 entries);
  }

  /// Loads on this structure: their names, and their forces in columns.
  void write_loads(const std::string& folder) const {
    if (!model_.systems[structure_].loads) return;
    std::vector<MatrixEntry> entries;
    CsvFile names(folder + "loads.csv");
    names.comment("columns of loads.mtx: forces at a history of 1");
    names.header("load");
    PetscInt column = 0;
    for (std::size_t l = 0; l < model_.loads.size(); ++l) {
      if (model_.loads[l].structure != static_cast<int>(structure_)) continue;
      names.row(scene_.loads[l].name, {});
      for (const NodalValue& force : model_.loads[l].forces) {
        const PetscInt row = row_of(force.node, force.component);
        if (row >= 0) entries.push_back({row, column, force.value});
      }
      ++column;
    }
    names.close();
    write_matrix(folder + "loads.mtx", "columns: loads as in loads.csv, N and N m",
                 {size(), column}, entries);
  }

  /// Row of a node's component, -1 if it is clamped.
  PetscInt row_of(GlobalIndex node, int component) const {
    const auto found =
        std::ranges::lower_bound(dofs_, std::pair(node, component), {},
                                 [](const Dof& dof) { return std::pair(dof.node, dof.component); });
    const bool here = found != dofs_.end() && found->node == node && found->component == component;
    return here ? static_cast<PetscInt>(found - dofs_.begin()) : -1;
  }

  void write_contact(const std::string& folder) const {
    std::vector<MatrixEntry> entries;
    CsvFile gaps(folder + "gaps.csv");
    gaps.comment("initial gap of every row of contact.mtx, g = g0 + L u; m");
    gaps.header("contact,initial_gap");
    PetscInt row = 0;
    for (const interactions::Constraint& constraint : model_.interface.constraints) {
      for (const interactions::ConstraintTerm& term : constraint.terms) {
        const bool mine = term.structure == static_cast<int>(structure_);
        const PetscInt column = mine ? row_of(term.node, term.component) : -1;
        if (column >= 0) entries.push_back({row, column, term.coefficient});
      }
      gaps.row(scene_.contacts[constraint.contact].name, {constraint.initial_gap});
      ++row;
    }
    gaps.close();
    write_matrix(folder + "contact.mtx", "this structure's columns of L", {row, size()}, entries);
  }

  void write_probes(const std::string& folder) const {
    std::vector<MatrixEntry> entries;
    CsvFile names(folder + "probes.csv");
    names.header("row");
    PetscInt row = 0;
    for (const ResolvedProbe& probe : model_.probes) {
      if (probe.structure != static_cast<int>(structure_)) continue;
      for (int d = 0; d < 3; ++d, ++row) {
        names.row(probe.name + "." + direction_names[d], {});
        for (const GlobalIndex node : probe.nodes) {
          const PetscInt column = row_of(node, d);
          if (column >= 0) {
            entries.push_back({row, column, 1 / static_cast<double>(probe.nodes.size())});
          }
        }
      }
    }
    names.close();
    write_matrix(folder + "probes.mtx", "displacement of the probes, rows as in probes.csv",
                 {row, size()}, entries);
  }

  void write_square(const std::string& path, const std::string& comment, Mat matrix) const {
    std::vector<MatrixEntry> mine;
    for_each_row(matrix, [&](PetscInt row, std::span<const PetscInt> columns,
                             std::span<const double> values) {
      for (std::size_t k = 0; k < columns.size(); ++k) mine.push_back({row, columns[k], values[k]});
    });
    std::vector<MatrixEntry> all = gathered(comm_, std::move(mine));
    on_rank0(comm_, [&] {
      for (MatrixEntry& entry : all) {
        entry.row = place_[entry.row];
        entry.column = place_[entry.column];
      }
      std::ranges::sort(
          all, {}, [](const MatrixEntry& entry) { return std::pair(entry.row, entry.column); });
      write_matrix(path, comment, {size(), size()}, all);
    });
  }

  MPI_Comm comm_;
  const Scene& scene_;
  const Model& model_;
  std::size_t structure_;
  std::vector<Dof> dofs_;            ///< rank 0: by node in file order
  std::vector<PetscInt> place_;      ///< rank 0: of PETSc's numbers in dofs_
  std::vector<std::string> labels_;  ///< rank 0: of the dofs' nodes, by Dof::label
};

/// Dashpots whose force is no matrix times the rates of their ends.
void refuse_dashpots(const Structure& structure) {
  for (const Region& region : structure.regions) {
    if (!(has_power | has_series)(region)) continue;
    throw UserError(
        "option -export_matrices: structure " + structure.name + ": the dashpots of " +
        region.group +
        (has_power(region) ? " go by a power of the rate" : " are in series with springs") +
        ", which no matrix holds");
  }
}

}  // namespace

void export_matrices(MPI_Comm comm, const Scene& scene, const Model& model) {
  for (std::size_t s = 0; s < model.systems.size(); ++s) {
    refuse_if(
        std::ranges::any_of(scene.structures[s].regions, is_nonlinear),
        "option -export_matrices: structure " + model.systems[s].name +
            " has tension-only bars, compression-only springs or elements that yield, which no "
            "matrix holds");
    refuse_dashpots(scene.structures[s]);
    Export(comm, scene, model, s).write();
  }
}

}  // namespace pounding
