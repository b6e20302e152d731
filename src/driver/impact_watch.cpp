#include "driver/impact_watch.h"

#include "driver/run_statistics.h"

namespace pounding {
namespace {

/// The catalogue of a scene's contacts, still empty.
ImpactCatalogue make_catalogue(const Scene& scene, const Model& model) {
  std::vector<int> contacts;
  std::vector<std::array<double, 2>> places;
  for (const interactions::Constraint& constraint : model.interface.constraints) {
    contacts.push_back(constraint.contact);
    places.push_back(constraint.place);
  }
  return {static_cast<int>(scene.contacts.size()),
          std::move(contacts),
          std::move(places),
          {scene.impact_merge_time, scene.force_window, model.time_step}};
}

}  // namespace

void ImpactWatch::add_contact(const CdLagrange& stepper) {
  const interactions::ContactProblem& contact = *run_.solver.contact();
  const auto [impulses, works] = run_.solver.row_actions();
  ContactStep step{contact.gaps(), impulses, works, {}, {}, {}};
  if (contact.friction().has_any()) {
    step.tangential_impulses = contact.friction().tangential_impulses();
    step.slip_rates = contact.friction().slip_rates();
    step.friction_losses = contact.friction().losses();
  }
  catalogue_.add_step(stepper.time(), stepper.force_duration(), step);
}

ImpactWatch::ImpactWatch(const ObservedRun& run)
    : run_(run),
      root_(std::max(run.contact_root(), 0)),
      catalogue_(make_catalogue(run.scene, run.model)) {}

void ImpactWatch::report(RunStatistics& statistics) {
  for (std::size_t c = 0; c < run_.scene.contacts.size(); ++c) {
    statistics.impacts.push_back(catalogue_.totals(static_cast<int>(c)));
  }
  statistics.all_impacts = catalogue_.totals();
  on_rank0(run_.comm, [&] {
    write_impacts(run_.scene.output + "/impacts.csv", run_.contact_names(), catalogue_.impacts(),
                  run_.scene.csv_digits);
  });
}

}  // namespace pounding
