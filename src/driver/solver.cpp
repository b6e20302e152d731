#include "driver/solver.h"

#include <algorithm>
#include <utility>

#include "driver/gap_bounds.h"
#include "interactions/link_rows.h"

namespace pounding {
namespace {

std::unique_ptr<interactions::ContactProblem> make_contact(const Solver::Parts& parts) {
  if (parts.interface->constraints.empty()) return nullptr;
  auto contact = std::make_unique<interactions::ContactProblem>(
      parts.comm, *parts.interface, parts.systems, parts.meshes, parts.gap_tolerance);
  contact->set_time_step(parts.time_step);
  return contact;
}

}  // namespace

Solver::Solver(Parts parts) : parts_(std::move(parts)), contact_(make_contact(parts_)) {
  if (parts_.carried || interactions::has_fillers(*parts_.interface) ||
      !parts_.interface->sliding.empty()) {
    // Energy that a filler holds is no structure's, and the bounds are those of the first pairs:
    // gaps are looked at in every step.
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

Solver::RowActions Solver::row_actions() {
  if (!gives_way_) return {contact_->impulses(), contact_->works()};
  std::ranges::copy(contact_->impulses(), impulses_.begin());
  std::ranges::copy(contact_->works(), works_.begin());
  fillers_->add_strikes(impulses_, works_);
  return {impulses_, works_};
}

void Solver::restart() {
  stepper_.reset();  // it refers to the contact problem
  contact_ = make_contact(parts_);
  make_stepper();
}

void Solver::make_stepper() {
  const Parts& parts = parts_;
  stepper_ = std::make_unique<CdLagrange>(parts.comm, parts.systems, *parts.motion, parts.time_step,
                                          *parts.profile, parts.supports, parts.loads, parts.lane);
  links_.clear();
  inelastic_.clear();
  for (std::size_t s = 0; s < parts.systems.size(); ++s) {
    const LinearSystem& system = parts.systems[s];
    inelastic_.push_back(system.laws.empty()
                             ? nullptr
                             : &stepper_->add(std::make_unique<interactions::InelasticElements>(
                                   s, parts.meshes[s], system, parts.time_step, system.laws)));
    const bool braked_in_lanes =
        !parts.lane.structures.empty() && parts.lane.structures[s].brakes(parts.lane.number);
    links_.push_back(system.links && !braked_in_lanes
                         ? &stepper_->add(interactions::make_links(system, s, parts.time_step))
                         : nullptr);
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

}  // namespace pounding
