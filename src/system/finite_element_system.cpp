#include "system/finite_element_system.h"

#include <algorithm>
#include <map>

#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "elements/geometric_stiffness.h"
#include "elements/measured_costs.h"
#include "mesh/element_properties.h"
#include "stiffness/element_loop.h"
#include "stiffness/element_stiffness.h"
#include "stiffness/stiffness.h"
#include "system/each_element.h"
#include "system/element_bounds.h"
#include "system/inelastic_laws.h"
#include "system/law_forces.h"
#include "system/links.h"
#include "system/massless_followers.h"
#include "system/matrix_system.h"
#include "system/rotary_scaling.h"
#include "system/scaled_mass.h"

namespace pounding {
namespace {

/// Part of S that a dof without mass is lent, so that it can be divided by, and swings with a
/// period a little above two steps.
constexpr double held_part = 0.05;
/// Mass over stiffness of a dof without mass in a reduced structure [s2]: 100 kHz of its own.
constexpr double held_in_modes = 2.5e-12;

/// Everything that one sweep over the elements of this rank yields.
class Assembly {
 public:
  /// `with_matrix`: the stiffness of the linear elements as well.
  Assembly(const Structure& structure, const Mesh& mesh, bool with_matrix, LinearSystem& system)
      : structure_(structure),
        mesh_(mesh),
        system_(system),
        bounds_(structure, mesh),
        added_inertia_(structure, mesh),
        added_mass_(structure, mesh) {
    if (with_matrix) matrix_ = stiffness::create_matrix(mesh);
    for (const ElementBlock& block : mesh.blocks) {
      if (follows_law(structure.regions[block.region]) && taut_.get() == nullptr) {
        taut_ = stiffness::create_matrix(mesh);
      }
      if (has_extra_damping(block) && extra_damping_.get() == nullptr) {
        extra_damping_ = stiffness::create_matrix(
            mesh, [this](const ElementBlock& other) { return has_extra_damping(other); });
      }
    }
  }

  void run() {
    system_.lumped_mass.assign(mesh_.owned_dofs, 0.0);
    numbers_ = stiffness::global_numbers(mesh_);
    on_every_rank(mesh_.comm, [&] {
      for_each_element(
          structure_, mesh_, [](const auto&, std::size_t) { return true; },
          [&](const ElementBlock& block, std::size_t e, const ElementLayout& layout,
              stiffness::ElementWork& work) { add(block, e, layout, work); });
      lent_ = lend_mass(mesh_, system_.lumped_mass);
      lend_to_held();
      check_mass();
    });
    system_.stiffness = finished(std::move(matrix_));
    system_.taut = finished(std::move(taut_));
    system_.extra_damping = finished(std::move(extra_damping_));
    bounds_.finish(system_);
    for (const auto& [dof, mass] : lent_) system_.lumped_mass[dof] = mass;
    reduce_over_ranks(mesh_.comm, MPI_SUM, system_.total_mass);
    for (const WaterBody& water : mesh_.water) {
      system_.total_mass += water.density * water.outline.volume;
    }
    on_every_rank(mesh_.comm, [&] { added_mass_.finish(system_); });
    added_mass_.share(system_);
    system_.condensed_dofs = std::ssize(system_.condensed);
    reduce_over_ranks(mesh_.comm, MPI_SUM, system_.condensed_dofs);
    added_inertia_.share(system_.rotary_scaling);
  }

 private:
  void add(const ElementBlock& block, std::size_t element, const ElementLayout& layout,
           stiffness::ElementWork& work) {
    const std::size_t size = layout.size();
    const std::span<const double> stiffness(work.stiffness.data(), size * size);
    const std::span<const double> mass(work.mass.data(), size);
    added_inertia_.add(block, element, work);
    const stiffness::ElementDofs dofs(mesh_, block, element);
    for (std::size_t i = 0; i < size; ++i) {
      const bool owned = dofs[i] >= 0 && dofs[i] < mesh_.owned_dofs;
      if (owned) system_.lumped_mass[dofs[i]] += work.mass[i];
      if (block.counted[element] != 0 && static_cast<int>(i) % layout.components == 0) {
        system_.total_mass += work.mass[i];
      }
    }
    const auto insert = [&](const MatHandle& matrix, const double* values) {
      stiffness::add_element(mesh_, numbers_, dofs, values, matrix.get());
    };
    const Region& region = structure_.regions[block.region];
    if (matrix_.get() != nullptr && is_in_stiffness(block.type)) {
      insert(matrix_, work.stiffness.data());
    }
    add_law_stiffness(region, block.share_of(element), layout, work);
    if (taut_.get() != nullptr) insert(taut_, work.stiffness.data());
    const double scaling = added_mass_.add(block, element, region, stiffness, mass);
    note_holding(block, scaling, stiffness, mass, dofs);
    // Elements that a rigid body holds altogether never strain.
    const bool strains = !is_in_rigid_body(mesh_, block, element);
    bounds_.add(block, strains ? stiffness : std::span(unstrained_.data(), size * size), mass, dofs,
                scaling);
    if (has_extra_damping(block)) {
      const Rayleigh extra = extra_rayleigh(block);
      if (!block.axial_force.empty()) {
        // The part that the weight adds may be negative in a rotation: it damps nothing.
        add_geometric_stiffness(block.type, gather_coordinates(mesh_, block, element, work),
                                element_properties(region), -block.axial_force[element],
                                {work.stiffness.data(), size * size});
      }
      for (std::size_t i = 0; i < stiffness.size(); ++i) damping_[i] = extra.beta * stiffness[i];
      for (std::size_t i = 0; i < size; ++i) damping_[i * size + i] += extra.alpha * mass[i];
      insert(extra_damping_, damping_.data());
    }
  }

  /// Notes the mass that an element may lend to the dofs that it holds and gives none, see
  /// lend_to_held.
  void note_holding(const ElementBlock& block, double scaling, std::span<const double> stiffness,
                    std::span<const double> mass, std::span<const LocalIndex> dofs) {
    if (is_nonlinear(structure_.regions[block.region])) return;
    const double factor = scaling > 0 ? held_part * scaling : held_in_modes;
    if (!(scaling > 0) && !structure_.modal) return;
    for (std::size_t i = 0; i < dofs.size(); ++i) {
      if (dofs[i] < 0 || dofs[i] >= mesh_.owned_dofs || mass[i] > 0) continue;
      const double own = factor * stiffness[i * dofs.size() + i];
      if (own > 0) held_[dofs[i]] += own;
    }
  }

  /// Lends mass to dofs without any that springs hold: where these are scaled, S is their inertia,
  /// by which they follow as at rest but for motions that the step does not resolve; of a reduced
  /// structure they are far above its modes.
  void lend_to_held() {
    for (const auto& [dof, mass] : held_) {
      if (system_.lumped_mass[dof] > 0 ||
          std::ranges::find(lent_, dof, &LentMass::first) != lent_.end()) {
        continue;
      }
      lent_.emplace_back(dof, mass);
      system_.condensed.push_back(dof);
    }
    std::ranges::sort(lent_);
  }

  /// Adds the stiffness that laws of springs hold, at its largest.
  static void add_law_stiffness(const Region& region, double share, const ElementLayout& layout,
                                stiffness::ElementWork& work) {
    if (!is_spring(region.element)) return;
    const std::size_t size = layout.size();
    const std::size_t components = layout.components;
    for (std::size_t c = 0; c < components; ++c) {
      const bool pressed = region.compression_only && c == 2;
      if (!pressed && !region.nonlinear.yields(c)) continue;
      for (std::size_t i = c; i < size; i += components) {
        for (std::size_t j = c; j < size; j += components) {
          work.stiffness[i * size + j] += (i == j ? share : -share) * region.stiffness[c];
        }
      }
    }
  }

  /// Null if there is no matrix.
  static std::unique_ptr<stiffness::Stiffness> finished(MatHandle matrix) {
    if (matrix.get() == nullptr) return nullptr;
    assemble(matrix.get());
    return std::make_unique<stiffness::AssembledStiffness>(std::move(matrix));
  }

  /// Damping of a block's region beside the structure's. One-way elements are damped while they
  /// act, by themselves.
  Rayleigh extra_rayleigh(const ElementBlock& block) const {
    const Rayleigh own = structure_.damping_of(structure_.regions[block.region]);
    const bool linear = !follows_law(structure_.regions[block.region]);
    return {own.alpha - structure_.damping.alpha, linear ? own.beta - structure_.damping.beta : 0};
  }

  bool has_extra_damping(const ElementBlock& block) const {
    const Rayleigh extra = extra_rayleigh(block);
    return extra.alpha != 0 || extra.beta != 0;
  }

  void check_mass() const {
    for_each_owned_dof(mesh_, [&](LocalIndex dof, LocalIndex node, int c) {
      if (system_.lumped_mass[dof] > 0) return;
      if (std::ranges::find(lent_, dof, &LentMass::first) == lent_.end()) refuse(node, c);
    });
  }

  [[noreturn]] void refuse(LocalIndex node, int component) const {
    const int part = mesh_.rigid_of.empty() ? -1 : mesh_.rigid_of[static_cast<std::size_t>(node)];
    const RigidPart* const body = part < 0 ? nullptr : &mesh_.rigid[static_cast<std::size_t>(part)];
    const bool follows = body != nullptr && mesh_.follows(node, component);
    throw UserError(sentence(
        "structure {}: the node at {} has no mass {}{}{}",
        {structure_.name, mesh_.position(node), component < 3 ? "along " : "against turning about ",
         direction_names[static_cast<std::size_t>(component % 3)],
         follows ? ", and nothing in " + body->group +
                       ", with which it moves, resists that motion; give a point_mass with "
                       "rotary_inertia"
                 : remedy(node, component)}));
  }

  /// Groups of the structure with an element at a node of this rank.
  std::vector<const Region*> regions_at(LocalIndex node) const {
    std::vector<const Region*> found;
    for (const ElementBlock& block : mesh_.blocks) {
      const auto& nodes = block.connectivity;
      if (std::ranges::find(nodes, node) == nodes.end()) continue;
      found.push_back(&structure_.regions[block.region]);
    }
    return found;
  }

  /// Continues a sentence on a dof without mass: the elements that hold it, the option that helps.
  std::string remedy(LocalIndex node, int component) const {
    std::string holders;
    std::string point;  // the group of a point mass there
    for (const Region* region : regions_at(node)) {
      const auto& traits = traits_of(region->element);
      if (traits.family == ElementFamily::point_mass) {
        point = region->group;
      } else {
        holders += (holders.empty() ? "" : ", ") + region->group;
      }
    }
    const std::string option = "-" + structure_.name + "_";
    const std::string only =
        holders.empty() ? ", and nothing holds it there: "
                        : ", and only " + holders + " hold" +
                              (holders.find(',') == std::string::npos ? "s" : "") + " it there: ";
    const std::string others =
        holders.empty() || structure_.mass_scaling > 0
            ? ", or clamp the component"
            : ", or give " + option +
                  "mass_scaling, beside which linear springs and beams condense it, or clamp "
                  "the component";
    if (!point.empty() && component >= 3) {
      return only + "give " + option + point + "_rotary_inertia" + others;
    }
    return only + "put a point_mass there (" + option + "<group>_element, " + option +
           "<group>_mass" + (component < 3 ? "" : ", " + option + "<group>_rotary_inertia") + ")" +
           others;
  }

  const Structure& structure_;
  const Mesh& mesh_;
  LinearSystem& system_;
  std::vector<LentMass> lent_;
  std::map<LocalIndex, double> held_;  ///< mass that may be lent to a dof that springs hold
  MatHandle matrix_;  ///< linear elements; these three are null if nobody wants them
  MatHandle taut_;    ///< one-way elements as well
  MatHandle extra_damping_;
  std::vector<PetscInt> numbers_;
  ElementBounds bounds_;
  AddedInertia added_inertia_;
  ScaledMass added_mass_;
  std::array<double, max_element_size * max_element_size> damping_{};
  const std::array<double, max_element_size * max_element_size> unstrained_{};
};

/// Whether the element-wise product is asked for or pays.
bool multiplies_elements(const Mesh& mesh, StiffnessMethod method) {
  GlobalIndex elements = 0;
  GlobalIndex in_kernels = 0;
  for (const ElementBlock& block : mesh.blocks) {
    elements += block.global_count;
    in_kernels += traits_of(block.type).kernel != ElementKernel::sparse ? block.global_count : 0;
  }
  return method == StiffnessMethod::element ||
         (method == StiffnessMethod::automatic &&
          measured_costs::elements_per_kernel * in_kernels >= elements);
}

std::string describe(const stiffness::ElementKinds& kinds, Numbers numbers) {
  const std::string single = numbers == Numbers::in_single
                                 ? ", of these " + std::to_string(kinds.single) + " in 32 bits"
                                 : "";
  return sentence(
      "element by element ({} bricks, {} rectangles, {} general{}, {} beams, {} others)",
      {kinds.bricks, kinds.rectangles, kinds.general, single, kinds.beams, kinds.other});
}

/// Time of a step of the solids of a mesh over that of hexahedra extruded along an axis with as
/// many nodes; 0 without solids. A node has one hexahedron, two wedges or five or six tetrahedra.
double cost_beside_extruded(const Mesh& mesh, const stiffness::ElementKinds& kinds) {
  constexpr double wedges_per_node = 2, tetrahedra_per_node = 5.5;
  double nodes = 0;
  double cost = static_cast<double>(kinds.skew) * (measured_costs::skew - measured_costs::extruded);
  for (const ElementBlock& block : mesh.blocks) {
    if (!is_solid(block.type)) continue;
    const double per_node = block.type == ElementType::wedge6 ? wedges_per_node
                            : block.type == ElementType::tet4 ? tetrahedra_per_node
                                                              : 1;
    const auto count = static_cast<double>(block.global_count);
    nodes += count / per_node;
    cost += count * (per_node == 1 ? measured_costs::extruded : traits_of(block.type).cost);
  }
  return nodes > 0 ? cost / (nodes * measured_costs::extruded) : 0;
}

}  // namespace

LinearSystem build_system(const Structure& structure, const Mesh& mesh, StiffnessMethod method,
                          bool with_matrix) {
  if (!structure.matrices.empty()) return build_matrix_system(structure, mesh);
  LinearSystem system = describe_system(structure, mesh);
  system.links = Links::build(structure, mesh);
  const bool by_element = multiplies_elements(mesh, method);
  // Modes want every link at its stiffest: the linear elements alone are of no use to them then.
  const bool for_modes = with_matrix && std::ranges::none_of(structure.regions, follows_law);
  Assembly(structure, mesh, !by_element || for_modes, system).run();
  if (!structure.modal) system.laws = inelastic_laws(structure, mesh);
  system.inelastic = dofs_of_laws(system.laws, false, mesh);
  system.stiffness_method = "assembled";
  stiffness::ElementKinds kinds;
  if (by_element) {
    auto product =
        std::make_unique<stiffness::ElementStiffness>(structure, mesh, std::move(system.stiffness));
    system.stiffness_method = describe(product->kinds(), structure.numbers);
    kinds = product->kinds();
    system.stiffness = std::move(product);
  }
  system.cost_beside_extruded = cost_beside_extruded(mesh, kinds);
  finish_system(mesh, system);
  if (system.links) system.links->find_trace(system, mesh);
  return system;
}

}  // namespace pounding
