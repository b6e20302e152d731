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
#include "modal/modal_analysis.h"
#include "modal/reduced_system.h"
#include "stability/stable_time_step.h"
#include "system/links.h"
#include "system/load_shapes.h"

namespace pounding {
namespace {

/// Lowest modes whose dashpots' forces the basis answers, beside the modes themselves.
constexpr int braked_modes = 40;

/// Where a basis that is to be chosen ends, however little its modes are damped [Hz].
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

/// The dashpots of all ranks over the coordinates; none where no rank has any. Collective.
std::optional<interactions::DashpotRows> all_dashpots(MPI_Comm comm, const LinearSystem& modes) {
  interactions::DashpotRows own;
  on_every_rank(comm, [&] {
    if (!modes.links || modes.links->links().empty()) return;
    auto rows = interactions::dashpot_rows(modes);
    if (!rows) {
      throw UserError("option -" + modes.name + "_model switched: not with links other than " +
                      "dashpots, nor with dashpots that follow a support; give full");
    }
    own = std::move(*rows);
  });
  own = {gather_rows(comm, own.rows), gather_rows(comm, own.strengths)};
  return own.strengths.empty() ? std::nullopt : std::optional(std::move(own));
}

/// Phi^T M u_0 of a rest; nothing where no rank has one. Collective.
std::vector<double> rest_in_modes(MPI_Comm comm, const LinearSystem& system,
                                  const SwitchedModes& modes) {
  std::vector<LocalIndex> dofs(system.rest_displacement.size());
  std::vector<double> momenta(dofs.size());
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    dofs[i] = static_cast<LocalIndex>(i);
    momenta[i] = system.lumped_mass[i] * system.rest_displacement[i];
  }
  std::vector<double> rest = modes.weighted(dofs, momenta);
  rest.push_back(dofs.empty() ? 0 : 1);
  reduce_over_ranks(comm, MPI_SUM, rest);
  const bool any = rest.back() > 0;
  rest.resize(any ? modes.size() : 0);
  return rest;
}

void give_modes(MPI_Comm comm, Structure structure, std::size_t s, Model& model) {
  LinearSystem& system = model.systems[s];
  structure.modal = structure.switched;
  ModalBasis& basis = *model.buildings[s].open_basis;
  auto switched = std::make_shared<SwitchedModes>();
  switched->part = structure.switched->switched_part;
  LinearSystem& modes = switched->system;
  modes = build_reduced_system(MPI_COMM_SELF, 0, structure, model.meshes[s], basis,
                               model.support_columns());
  modes.uniform_damping = system.uniform_damping;
  modes.loads =
      shape_reduced_loads(model.scene_loads(), static_cast<int>(s), basis.load_parts, true);
  switched->dashpots = all_dashpots(comm, modes);
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
  return -std::log(part) / (2 * ratio * omega);
}

void prepare_switched(const Mesh& mesh, LinearSystem& system, ModalRequest& request) {
  const bool links = on_any_rank(system.comm, system.links && !system.links->links().empty());
  const auto most =
      static_cast<int>(std::min<GlobalIndex>(braked_modes, system.independent_dofs()));
  const ModalResult lowest = lowest_modes(system, mesh, links ? most : 1, true);
  if (request.modes == 0 && request.cutoff == 0) {
    const double first = lowest.first_frequency();
    request.cutoff = std::max(first, 1.0);
    const auto lasts = [&](double frequency) {
      const double omega = 2 * std::numbers::pi * frequency;
      return first * settling_time(system, omega, request.switched_part) > 1;
    };
    while (request.cutoff < highest_cutoff && lasts(request.cutoff)) request.cutoff *= 1.02;
  }
  if (links > 0) system.loads = with_dashpot_loads(system, lowest.modes);
}

void give_modes(MPI_Comm comm, const Scene& scene, Model& model) {
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    if (scene.structures[s].switched) give_modes(comm, scene.structures[s], s, model);
  }
}

}  // namespace pounding
