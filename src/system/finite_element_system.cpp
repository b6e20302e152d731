#include "system/finite_element_system.h"

#include <algorithm>
#include <sstream>

#include "common/error.h"
#include "common/parallel.h"
#include "mesh/location.h"
#include "system/element_bounds.h"
#include "system/element_loop.h"
#include "system/element_stiffness.h"

namespace pounding {
namespace {

/// Calls `visit(block, element, layout, work)` with the matrices of every element on this rank.
template <typename Visit>
void for_each_element(const Structure& structure, const Mesh& mesh, Visit&& visit) {
  ElementWork work;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    const ElementProperties properties =
        element_properties(structure.regions[static_cast<std::size_t>(block.region)]);
    const ElementLayout layout = element_layout(block.type);
    const auto size = static_cast<std::size_t>(layout.size());
    for (std::size_t e = 0; e < block.count(); ++e) {
      try {
        element_matrices(block.type, gather_coordinates(mesh, block, e, work), properties,
                         {work.stiffness.data(), size * size}, {work.mass.data(), size});
      } catch (const ElementError& error) {
        throw UserError("structure " + structure.name + ": " + describe_element(mesh, block, e) +
                        ": " + error.what());
      }
      visit(block, e, layout, work);
    }
  }
}

/// Number of entries per owned row in the own and the other columns.
void count_entries(const Mesh& mesh, std::vector<PetscInt>& own, std::vector<PetscInt>& other) {
  std::vector<std::vector<LocalIndex>> neighbours(static_cast<std::size_t>(mesh.owned_nodes));
  for (const ElementBlock& block : mesh.blocks) {
    const auto nodes = static_cast<std::size_t>(element_layout(block.type).nodes);
    for (std::size_t e = 0; e < block.count(); ++e) {
      const LocalIndex* corner = &block.connectivity[e * nodes];
      for (std::size_t a = 0; a < nodes; ++a) {
        if (corner[a] < mesh.owned_nodes) {
          auto& list = neighbours[static_cast<std::size_t>(corner[a])];
          list.insert(list.end(), corner, corner + nodes);
        }
      }
    }
  }
  own.assign(static_cast<std::size_t>(mesh.owned_dofs), 0);
  other.assign(static_cast<std::size_t>(mesh.owned_dofs), 0);
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    auto& list = neighbours[static_cast<std::size_t>(node)];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    PetscInt own_entries = 0;
    PetscInt other_entries = 0;
    for (const LocalIndex neighbour : list) {
      const int dofs = component_count(mesh.free_components[static_cast<std::size_t>(neighbour)]);
      (neighbour < mesh.owned_nodes ? own_entries : other_entries) += dofs;
    }
    const LocalIndex first = mesh.first_dof[static_cast<std::size_t>(node)];
    const int rows = component_count(mesh.free_components[static_cast<std::size_t>(node)]);
    std::fill_n(own.begin() + first, rows, own_entries);
    std::fill_n(other.begin() + first, rows, other_entries);
  }
}

MatHandle create_matrix(const Mesh& mesh) {
  std::vector<PetscInt> own;
  std::vector<PetscInt> other;
  count_entries(mesh, own, other);
  MatHandle matrix;
  const LocalIndex n = mesh.owned_dofs;
  POUNDING_PETSC(MatCreateAIJ(mesh.comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, 0, own.data(), 0,
                              other.data(), matrix.out()));
  POUNDING_PETSC(MatSetOption(matrix.get(), MAT_USE_INODES, PETSC_FALSE));
  POUNDING_PETSC(MatSetOption(matrix.get(), MAT_SYMMETRIC, PETSC_TRUE));
  return matrix;
}

/// Global dof numbers of all local dofs.
std::vector<PetscInt> global_numbers(const Mesh& mesh) {
  std::vector<PetscInt> numbers(static_cast<std::size_t>(mesh.dof_count));
  for (LocalIndex node = 0; node < mesh.node_count(); ++node) {
    for (int c = 0; c < 6; ++c) {
      const LocalIndex dof = mesh.dof(node, c);
      if (dof >= 0) {
        numbers[static_cast<std::size_t>(dof)] = static_cast<PetscInt>(mesh.dof_global(node, c));
      }
    }
  }
  return numbers;
}

/// Everything that one sweep over the elements of this rank yields.
class Assembly {
 public:
  Assembly(const Structure& structure, const Mesh& mesh, LinearSystem& system)
      : structure_(structure),
        mesh_(mesh),
        system_(system),
        matrix_(create_matrix(mesh)),
        bounds_(structure, mesh) {
    for (const ElementBlock& block : mesh.blocks) {
      if (block.type == ElementType::tension_bar && taut_.get() == nullptr) {
        taut_ = create_matrix(mesh);
      }
      if (has_extra_damping(block) && extra_damping_.get() == nullptr) {
        extra_damping_ = create_matrix(mesh);
      }
    }
  }

  void run() {
    system_.lumped_mass.assign(static_cast<std::size_t>(mesh_.owned_dofs), 0.0);
    numbers_ = global_numbers(mesh_);
    on_every_rank(mesh_.comm, [&] {
      for_each_element(structure_, mesh_,
                       [&](const ElementBlock& block, std::size_t e, const ElementLayout& layout,
                           const ElementWork& work) { add(block, e, layout, work); });
      check_mass();
    });
    system_.stiffness = finished(std::move(matrix_));
    if (taut_.get() != nullptr) {
      system_.taut = finished(std::move(taut_));
    }
    if (extra_damping_.get() != nullptr) {
      system_.extra_damping = finished(std::move(extra_damping_));
    }
    bounds_.finish(system_);
    MPI_Allreduce(MPI_IN_PLACE, &system_.total_mass, 1, MPI_DOUBLE, MPI_SUM, mesh_.comm);
  }

 private:
  void add(const ElementBlock& block, std::size_t element, const ElementLayout& layout,
           const ElementWork& work) {
    const auto size = static_cast<std::size_t>(layout.size());
    const auto dofs = element_dofs(mesh_, block, element, layout);
    std::array<PetscInt, max_element_size> rows{};
    std::array<PetscInt, max_element_size> columns{};
    for (std::size_t i = 0; i < size; ++i) {
      const LocalIndex dof = dofs[i];
      const bool owned = dof >= 0 && dof < mesh_.owned_dofs;
      columns[i] = dof >= 0 ? numbers_[static_cast<std::size_t>(dof)] : -1;
      rows[i] = owned ? columns[i] : -1;
      if (owned) {
        system_.lumped_mass[static_cast<std::size_t>(dof)] += work.mass[i];
      }
      if (block.counted[element] != 0 && static_cast<int>(i) % layout.components == 0) {
        system_.total_mass += work.mass[i];
      }
    }
    const auto insert = [&](const MatHandle& matrix, const double* values) {
      const auto n = static_cast<PetscInt>(size);
      POUNDING_PETSC(
          MatSetValues(matrix.get(), n, rows.data(), n, columns.data(), values, ADD_VALUES));
    };
    if (block.type != ElementType::tension_bar) {
      insert(matrix_, work.stiffness.data());
    }
    if (taut_.get() != nullptr) {
      insert(taut_, work.stiffness.data());
    }
    const std::span<const double> stiffness(work.stiffness.data(), size * size);
    const std::span<const double> mass(work.mass.data(), size);
    const std::span<double> damping(damping_.data(), size * size);
    element_dashpots(block.type, properties_of(block), damping);
    bounds_.add(block, stiffness, mass, damping, {dofs.data(), size});
    if (has_extra_damping(block)) {
      const Rayleigh extra = extra_rayleigh(block);
      for (std::size_t i = 0; i < damping.size(); ++i) {
        damping[i] += extra.beta * stiffness[i];
      }
      for (std::size_t i = 0; i < size; ++i) {
        damping[i * size + i] += extra.alpha * mass[i];
      }
      insert(extra_damping_, damping.data());
    }
  }

  std::unique_ptr<Stiffness> finished(MatHandle matrix) const {
    POUNDING_PETSC(MatAssemblyBegin(matrix.get(), MAT_FINAL_ASSEMBLY));
    POUNDING_PETSC(MatAssemblyEnd(matrix.get(), MAT_FINAL_ASSEMBLY));
    return std::make_unique<AssembledStiffness>(std::move(matrix));
  }

  ElementProperties properties_of(const ElementBlock& block) const {
    return element_properties(structure_.regions[static_cast<std::size_t>(block.region)]);
  }

  /// What the damping of a block's region has beside the structure's.
  Rayleigh extra_rayleigh(const ElementBlock& block) const {
    const Rayleigh own =
        structure_.damping_of(structure_.regions[static_cast<std::size_t>(block.region)]);
    return {own.alpha - structure_.damping.alpha, own.beta - structure_.damping.beta};
  }

  bool has_extra_damping(const ElementBlock& block) const {
    const auto& rates = properties_of(block).dashpot;
    const Rayleigh extra = extra_rayleigh(block);
    return extra.alpha != 0 || extra.beta != 0 ||
           std::any_of(rates.begin(), rates.end(), [](double rate) { return rate > 0; });
  }

  void check_mass() const {
    for (LocalIndex node = 0; node < mesh_.owned_nodes; ++node) {
      for (int c = 0; c < 6; ++c) {
        const LocalIndex dof = mesh_.dof(node, c);
        if (dof >= 0 && !(system_.lumped_mass[static_cast<std::size_t>(dof)] > 0)) {
          const Vector3 x = mesh_.position(node);
          std::ostringstream text;
          text << "structure " << structure_.name << ": the node at (" << x[0] << ", " << x[1]
               << ", " << x[2] << ") has no mass in component " << c
               << "; give its elements a density";
          throw UserError(text.str());
        }
      }
    }
  }

  const Structure& structure_;
  const Mesh& mesh_;
  LinearSystem& system_;
  MatHandle matrix_;  ///< linear elements
  MatHandle taut_;    ///< tension-only bars as well
  MatHandle extra_damping_;
  std::vector<PetscInt> numbers_;
  ElementBounds bounds_;
  std::array<double, max_element_size * max_element_size> damping_{};
};

/// Puts the element-wise product in place of the matrix's where it is asked for or pays.
void choose_stiffness(const Structure& structure, const Mesh& mesh, StiffnessMethod method,
                      LinearSystem& system) {
  system.stiffness_method = "assembled";
  GlobalIndex elements = 0;
  GlobalIndex hexahedra = 0;
  for (const ElementBlock& block : mesh.blocks) {
    elements += block.global_count;
    hexahedra += is_hexahedron(block.type) ? block.global_count : 0;
  }
  if (method == StiffnessMethod::assembled ||
      (method == StiffnessMethod::automatic && 4 * hexahedra < elements)) {
    return;
  }
  auto product = std::make_unique<ElementStiffness>(structure, mesh, std::move(system.stiffness));
  const ElementKinds kinds = product->kinds();
  system.stiffness_method = "element by element (" + std::to_string(kinds.bricks) + " bricks, " +
                            std::to_string(kinds.congruent) + " congruent, " +
                            std::to_string(kinds.beams) + " beams, " + std::to_string(kinds.other) +
                            " others)";
  system.stiffness = std::move(product);
}

}  // namespace

ElementProperties element_properties(const Region& region) {
  ElementProperties properties;
  properties.young = region.material.young;
  properties.poisson = region.material.poisson;
  properties.density = region.material.density;
  properties.area = region.area;
  properties.thickness = region.thickness;
  properties.rotary_inertia_factor = region.rotary_inertia_factor;
  properties.mass = region.mass;
  properties.rotary_inertia = region.rotary_inertia;
  properties.stiffness = region.stiffness;
  properties.dashpot = region.dashpot;
  if (region.section) {
    properties.area = region.section->area;
    properties.inertia_y = region.section->inertia_y;
    properties.inertia_z = region.section->inertia_z;
    properties.torsion = region.section->torsion;
    properties.z_axis = region.section->z_axis;
  }
  return properties;
}

LinearSystem build_finite_element_system(const Structure& structure, const Mesh& mesh,
                                         StiffnessMethod method) {
  LinearSystem system = describe_system(structure, mesh);
  system.tension_bars = TensionBars::build(structure, mesh);
  Assembly(structure, mesh, system).run();
  choose_stiffness(structure, mesh, method, system);
  finish_system(mesh, system);
  return system;
}

}  // namespace pounding
