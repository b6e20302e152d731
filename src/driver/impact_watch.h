#pragma once

#include "driver/observed_run.h"
#include "output/impact_catalogue.h"

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

}  // namespace pounding
