#include "model/switched_modes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <utility>

#include "common/error.h"
#include "common/parallel.h"
#include "dynamics/switched_run.h"
#include "interactions/structure_links.h"
#include "modal/modal_analysis.h"
#include "modal/reduced_system.h"
#include "stability/stable_time_step.h"
#include "system/links.h"
#include "system/load_shapes.h"

namespace pounding {
namespace {

/// Lowest modes whose dashpots' forces the basis answers, beside the modes themselves.
constexpr int braked_modes = 40;

/// Where a basis that is to be chosen ends at least, since motions of the ground drive those below,
/// and at most, however little its modes are damped [Hz].
constexpr double lowest_cutoff = 33;
constexpr double highest_cutoff = 1000;

/// Phi of the owned dofs alone, in their order, in place of all points of the basis.
void keep_owned_rows(const Mesh& mesh, std::size_t size, GeneralisedCoordinates& coordinates) {
  std::vector<double> rows;
  for_each_owned_dof(mesh, [&](LocalIndex, LocalIndex node, int c) {
    const std::size_t row = coordinates.row_of.at({mesh.file_node[node], c});
    const double* const phi = &coordinates.rows[row * size];
    rows.insert(rows.end(), phi, phi + size);
  });
  coordinates.rows = std::move(rows);
  coordinates.row_of.clear();
}

/// Gathers the links of all ranks. `reduced`: the structure whose regions those of `modes` have;
/// `structure`: that of the scene. Collective.
void gather_links(MPI_Comm comm, const Structure& reduced, const Structure& structure,
                  SwitchedModes& modes) {
  constexpr std::size_t numbers = 4;
  std::vector<double> rows;
  std::vector<double> origins;
  on_every_rank(comm, [&] {
    bool refused = structure.soil && structure.soil->is_shared();
    if (modes.system.links) {
      refused = refused || !interactions::carried_by_supports(modes.system).empty();
      rows = interactions::link_rows(modes.system);
    }
    for (std::size_t b = 0; modes.system.links && b < modes.system.links->links().size(); ++b) {
      const interactions::LinkOrigin& origin = modes.system.links->links()[b].origin;
      refused = refused || !(interactions::law_of(origin, 0.5)->rate() > 0);
      const auto region = origin.region - reduced.regions.data();
      origins.insert(origins.end(), {static_cast<double>(region), double(origin.component),
                                     double(origin.part), origin.share});
    }
    if (!refused) return;
    throw UserError(
        "option -" + structure.name + "_model switched: not with soil that mats " +
        "share, nor links that a support stretches or not linear in their rate; give full");
  });
  modes.links.rows = gather_rows(comm, rows);
  origins = gather_rows(comm, origins);
  for (std::size_t i = 0; i < origins.size(); i += numbers) {
    modes.links.origins.push_back(
        {.region = &structure.regions[static_cast<std::size_t>(origins[i])],
         .component = static_cast<int>(origins[i + 1]),
         .part = static_cast<interactions::SpringPart>(origins[i + 2]),
         .share = origins[i + 3]});
  }
}

/// Phi^T M u_0 of a rest; nothing where no rank has one. Collective.
std::vector<double> rest_in_modes(MPI_Comm comm, const LinearSystem& system,
                                  const SwitchedModes& modes) {
  std::vector<double> momenta = system.rest_displacement;
  for (std::size_t i = 0; i < momenta.size(); ++i) momenta[i] *= system.lumped_mass[i];
  std::vector<double> rest = modes.weighted(momenta);
  rest.push_back(momenta.empty() ? 0 : 1);
  reduce_over_ranks(comm, MPI_SUM, rest);
  const bool any = rest.back() > 0;
  rest.resize(any ? modes.size() : 0);
  return rest;
}

void give_modes(MPI_Comm comm, const Structure& structure, std::size_t s, Model& model) {
  LinearSystem& system = model.systems[s];
  Structure reduced = structure;
  reduced.modal = structure.switched;
  ModalBasis& basis = *model.buildings[s].open_basis;
  auto switched = std::make_shared<SwitchedModes>();
  switched->part = structure.switched->switched_part;
  LinearSystem& modes = switched->system;
  modes = build_reduced_system(MPI_COMM_SELF, 0, reduced, model.meshes[s], basis,
                               model.support_columns());
  modes.uniform_damping = system.uniform_damping;
  modes.loads =
      shape_reduced_loads(model.scene_loads(), static_cast<int>(s), basis.load_parts, true);
  gather_links(comm, reduced, structure, *switched);
  modes.links.reset();
  keep_owned_rows(model.meshes[s], basis.size(), *modes.generalised);
  modes.rest_displacement = rest_in_modes(comm, system, *switched);
  system.switched = std::move(switched);
}

/// Forces of the dashpots on modes, behind the loads of the system. Local.
std::shared_ptr<const LoadShapes> with_dashpot_loads(const LinearSystem& system,
                                                     std::span<const Mode> modes) {
  auto all =
      system.loads ? std::make_shared<LoadShapes>(*system.loads) : std::make_shared<LoadShapes>();
  for (const Mode& mode : modes) {
    LoadShape& shape = all->loads.emplace_back();
    if (!system.links) continue;
    shape.dofs = system.links->dofs();
    shape.force.assign(shape.dofs.size(), 0.0);
    for (const Link& link : system.links->links()) {
      double rate = 0;
      for (std::size_t k = 0; k < link.point.size(); ++k) {
        if (link.point[k] >= 0) rate += link.weight[k] * mode.shape[shape.dofs[link.point[k]]];
      }
      rate *= interactions::law_of(link.origin, 0.5)->rate();  // c / (2 dt) is c
      for (std::size_t k = 0; k < link.point.size(); ++k) {
        if (link.point[k] >= 0) shape.force[link.point[k]] += link.weight[k] * rate;
      }
    }
  }
  return all;
}

}  // namespace

double settling_time(const LinearSystem& system, double omega, double part) {
  const double ratio = system.uniform_damping ? system.uniform_damping->ratio_at(omega)
                                              : damping_ratio(system.damping, omega);
  return std::log(struck_part / part) / (2 * ratio * omega);
}

void prepare_switched(const Mesh& mesh, LinearSystem& system, ModalRequest& request) {
  const bool links = on_any_rank(system.comm, system.links && !system.links->links().empty());
  const auto most =
      static_cast<int>(std::min<GlobalIndex>(braked_modes, system.independent_dofs()));
  const ModalResult lowest = lowest_modes(system, mesh, links ? most : 1, true);
  if (request.modes == 0 && request.cutoff == 0) {
    const double first = lowest.first_frequency();
    request.cutoff = std::max(1.02 * first, lowest_cutoff);
    request.most_modes = most_chosen_modes;
    const auto lasts = [&](double frequency) {
      const double omega = 2 * std::numbers::pi * frequency;
      return first * settling_time(system, omega, request.switched_part) > 1;
    };
    while (request.cutoff < highest_cutoff && lasts(request.cutoff)) request.cutoff *= 1.02;
  }
  if (links) system.loads = with_dashpot_loads(system, lowest.modes);
}

void give_modes(MPI_Comm comm, const Scene& scene, Model& model) {
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    if (scene.structures[s].switched) give_modes(comm, scene.structures[s], s, model);
  }
}

}  // namespace pounding
