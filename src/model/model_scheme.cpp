#include "model/model_scheme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "common/parallel.h"
#include "common/progress.h"
#include "dynamics/state.h"
#include "interactions/link_rows.h"
#include "stability/energy_norm.h"

namespace pounding {
namespace {

std::unique_ptr<interactions::ContactProblem> make_contact(const ModelScheme::Parts& parts) {
  if (parts.interface->constraints.empty()) return nullptr;
  auto contact = std::make_unique<interactions::ContactProblem>(
      parts.comm, *parts.interface, parts.systems, parts.meshes, parts.gap_tolerance);
  contact->set_time_step(parts.time_step);
  return contact;
}

/// Products times dofs per structure: a second or two.
constexpr double work = 1e8;

/// L T over the owned coordinates, all rows.
std::vector<double> coordinate_rows(const interactions::ContactProblem& contact,
                                    std::size_t structure, const LinearSystem& system) {
  std::vector<double> rows;
  for (int row = 0; row < contact.rows(); ++row) {
    const std::vector<double> one = contact.row_force(row, structure, system.owned_dofs());
    rows.insert(rows.end(), one.begin(), one.end());
  }
  return rows;
}

GapWatch::Bound energy_bound(const interactions::ContactProblem& contact, std::size_t structure,
                             const LinearSystem& system, double time_step, double margin,
                             Progress& progress) {
  GapWatch::Bound bound;
  EnergyNorm norm(system, time_step, margin, work);
  for (std::size_t d = 0; d < 3; ++d) {
    bound.force_norm[d] = norm.bound(system.ground_load(static_cast<int>(d)));
  }
  if (any_damped_about_rest(system)) {
    std::vector<double> load = rest_forces(system);
    for (std::size_t d = 0; d < 3; ++d) {
      const std::vector<double> of_ground = system.ground_load(static_cast<int>(d));
      for (std::size_t i = 0; i < load.size(); ++i) load[i] -= of_ground[i] * system.gravity[d];
    }
    bound.rest_norm = norm.bound(std::move(load));
  }
  // The row with the largest compliance first: its bound spares most of the others their work.
  std::vector<std::pair<double, int>> rows;
  for (int row = 0; row < contact.rows(); ++row) {
    rows.emplace_back(std::sqrt(contact.row_compliance(row, structure) / margin), row);
  }
  std::ranges::stable_sort(rows, std::greater{}, &std::pair<double, int>::first);
  std::size_t done = 0;
  for (const auto& [coarse, row] : rows) {
    progress.at("row " + std::to_string(++done) + " of " + std::to_string(rows.size()));
    if (coarse <= bound.rate_norm) break;
    const double found =
        norm.exhausted()
            ? coarse
            : norm.bound(contact.row_force(row, structure, system.owned_dofs()), bound.rate_norm);
    bound.rate_norm = std::max(bound.rate_norm, found);
  }
  return bound;
}

}  // namespace

ModelScheme::ModelScheme(Parts parts) : parts_(std::move(parts)), contact_(make_contact(parts_)) {
  if (parts_.carried || interactions::has_fillers(*parts_.interface) ||
      !parts_.interface->soil.empty() || !parts_.interface->sliding.empty()) {
    // Energy that a filler or the soil between mats holds is no structure's, and the bounds are
    // those of the first pairs: gaps are looked at in every step.
    bounds_.resize(parts_.systems.size());
    for (GapWatch::Bound& bound : bounds_) {
      bound.rate_norm = std::numeric_limits<double>::infinity();
    }
  } else {
    const ScopedTimer timer(*parts_.profile, Phase::assembly);
    bounds_ = gap_bounds(parts_.comm, parts_.systems, parts_.energy_margins, parts_.time_step,
                         contact_.get(), parts_.progress_interval);
  }
  gives_way_ =
      std::ranges::any_of(parts_.interface->constraints,
                          [](const interactions::Constraint& row) { return row.filler.strikes(); });
  impulses_.resize(gives_way_ ? parts_.interface->constraints.size() : 0);
  works_.resize(impulses_.size());
  make_stepper();
}

ModelScheme::RowActions ModelScheme::row_actions() {
  if (!gives_way_) return {contact_->impulses(), contact_->works()};
  std::ranges::copy(contact_->impulses(), impulses_.begin());
  std::ranges::copy(contact_->works(), works_.begin());
  fillers_->add_strikes(impulses_, works_);
  return {impulses_, works_};
}

void ModelScheme::restart() {
  stepper_.reset();  // it refers to the contact problem
  contact_ = make_contact(parts_);
  make_stepper();
}

void ModelScheme::make_stepper() {
  const Parts& parts = parts_;
  stepper_ = std::make_unique<CdLagrange>(parts.comm, parts.systems, *parts.motion, parts.time_step,
                                          *parts.profile, parts.supports, parts.loads, parts.batch);
  links_.clear();
  inelastic_.clear();
  for (std::size_t s = 0; s < parts.systems.size(); ++s) {
    const LinearSystem& system = parts.systems[s];
    inelastic_.emplace_back();
    for (const bool apart : {false, true}) {
      std::vector<interactions::RegionLaw> laws;
      std::ranges::copy_if(system.laws, std::back_inserter(laws),
                           [&](const auto& law) { return law.apart == apart; });
      if (laws.empty()) continue;
      inelastic_[s].push_back(&stepper_->add(std::make_unique<interactions::InelasticElements>(
          s, parts.meshes[s], system, parts.time_step, std::move(laws))));
    }
    const bool braked_in_batch =
        parts.batch.of(s) != nullptr && parts.batch.of(s)->brakes(parts.batch.number);
    links_.push_back(system.links && !braked_in_batch
                         ? &stepper_->add(interactions::make_links(system, s, parts.time_step))
                         : nullptr);
  }
  if (!parts.interface->soil.empty()) {
    soil_ = &stepper_->add(std::make_unique<interactions::SoilRows>(
        parts.comm, *parts.interface, parts.systems, parts.meshes, parts.time_step));
  }
  if (interactions::has_fillers(*parts.interface)) {
    fillers_ = &stepper_->add(
        std::make_unique<interactions::FillerRows>(parts.comm, *parts.interface, parts.contacts,
                                                   parts.systems, parts.meshes, parts.time_step));
  }
  if (contact_) {
    GapWatch watch(parts.systems, bounds_, parts.motion->peaks(), parts.time_step);
    unilateral_ = &stepper_->add(std::make_unique<UnilateralContact>(
        parts.comm, *contact_, std::move(watch), stepper_->state()));
  }
}

ModelScheme::Parts scheme_parts(MPI_Comm comm, const Scene& scene, const Model& model,
                                std::span<const Mesh> meshes, Profile& profile) {
  ModelScheme::Parts parts{comm,
                           model.systems,
                           meshes,
                           &model.interface,
                           model.motion.get(),
                           scene.gap_tolerance * model.interface.model_size,
                           model.time_step,
                           {},
                           &profile,
                           scene.progress_interval,
                           scene.contacts,
                           model.supports.get(),
                           model.load_histories.get()};
  for (const Building& building : model.buildings) {
    parts.energy_margins.push_back(building.energy_margin);
  }
  return parts;
}

std::vector<GapWatch::Bound> gap_bounds(MPI_Comm comm, std::span<const LinearSystem> systems,
                                        std::span<const double> energy_margins, double time_step,
                                        const interactions::ContactProblem* contact,
                                        double progress_interval) {
  std::vector<GapWatch::Bound> bounds(systems.size());
  for (std::size_t s = 0; contact != nullptr && s < bounds.size(); ++s) {
    const LinearSystem& system = systems[s];
    // The energy of soil is in that of its structure; that of links in modes may be negative, and
    // nothing bounds the motion by a wave from below, supports of its own or loads, nor about a
    // rest that yielded, which ranks without a part of the structure do not know.
    if (on_any_rank(comm, system.supports || system.loads || !system.rest_law_force.empty() ||
                              system.has_laws_beside || (system.links && system.links->driven()) ||
                              !(energy_margins[s] > 0))) {
      bounds[s].rate_norm = std::numeric_limits<double>::infinity();
      continue;
    }
    if (GapWatch::goes_by_coordinates(system)) {
      bounds[s].coordinate_rows = coordinate_rows(*contact, s, system);
      continue;
    }
    GapWatch::Bound& bound = bounds[s];
    Progress progress(comm, system.name + ": bounds of the gap rates", progress_interval);
    bound = energy_bound(*contact, s, system, time_step, energy_margins[s], progress);
    std::array<double, 5> values{bound.rate_norm, bound.rest_norm.value_or(0), bound.force_norm[0],
                                 bound.force_norm[1], bound.force_norm[2]};
    reduce_over_ranks(comm, MPI_MAX, values);
    bound.rate_norm = values[0];
    if (bound.rest_norm) bound.rest_norm = values[1];
    std::copy(values.begin() + 2, values.end(), bound.force_norm.begin());
  }
  return bounds;
}

}  // namespace pounding
