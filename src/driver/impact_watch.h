#pragma once

#include "driver/observed_run.h"
#include "output/impact_catalogue.h"

namespace pounding {

/// The catalogue of a scene's contacts, still empty.
ImpactCatalogue make_catalogue(const Scene& scene, const Model& model);

/// Adds a step of length `duration` at `time` [s] with contact, on a rank that knows it.
void add_contact(const interactions::ContactProblem& contact, double time, double duration,
                 ImpactCatalogue& catalogue);

/// Impacts of a run, from the impulses of its steps: `impacts.csv`.
class ImpactWatch final : public Observer {
 public:
  explicit ImpactWatch(const ObservedRun& run);
  /// The impacts: on the root of the contacts, after `finish` on every rank.
  const ImpactCatalogue& catalogue() const { return catalogue_; }

  bool follows() const override { return run_.is_contact_root(); }
  void follow(const CdLagrange& stepper) override {
    if (!run_.solver.touching()) return;
    add_contact(*run_.solver.contact(), stepper.time(), stepper.force_duration(), catalogue_);
  }
  void finish(bool /*complete*/) override { catalogue_.finish(run_.comm, root_); }
  void save(SavedState& saved) override {
    if (rank_of(run_.comm) == root_) catalogue_.save(saved);
  }
  void load(const SavedState& saved) override { catalogue_.load(saved); }
  void report(RunStatistics& statistics) override;

 private:
  ObservedRun run_;
  int root_;  ///< of the contacts, or rank 0 without them
  ImpactCatalogue catalogue_;
};

}  // namespace pounding
