#pragma once

#include <memory>

#include "observers/field_plan.h"
#include "observers/impact_catalogue.h"

namespace pounding {

/// Impacts of a run, from the impulses of its steps: `impacts.csv`.
class ImpactWatch final : public Observer {
 public:
  explicit ImpactWatch(const ObservedRun& run);
  /// The impacts: on the root of the contacts, after `finish` on every rank.
  const ImpactCatalogue& catalogue() const { return catalogue_; }

  bool follows() const override { return run_.is_contact_root(); }
  void follow(const CdLagrange& stepper) override {
    if (run_.solver.rows_act()) add_contact(stepper);
  }
  void finish(bool /*complete*/) override { catalogue_.finish(run_.comm, root_); }
  void save(SavedState& saved) override {
    if (rank_of(run_.comm) == root_) catalogue_.save(saved);
  }
  void load(const SavedState& saved) override { catalogue_.load(saved); }
  void report(RunStatistics& statistics) override;

 private:
  void add_contact(const CdLagrange& stepper);

  ObservedRun run_;
  int root_;  ///< of the contacts, or rank 0 without them
  ImpactCatalogue catalogue_;
};

/// Pairs are found once, in the initial geometry. This keeps how far each node has moved along the
/// facet that it faces, whether they touch or not, on the ranks that have displacements of the
/// interface. It reads displacements and changes nothing; nothing allocates after construction. Of
/// a run with contacts. Collective.
std::unique_ptr<Observer> make_slide_watch(const ObservedRun& run);

/// Contact ratio of every structure that has compression-only springs, at the lines of the energy
/// ledger.
std::unique_ptr<Observer> make_uplift_watch(const ObservedRun& run);

/// Smallest gap at t_n and mean force over the interval of each contact, for the history; and how
/// far the pairs have closed at the samples. On the root of the contacts.
std::unique_ptr<Observer> make_contact_history(const ObservedRun& run);

}  // namespace pounding
