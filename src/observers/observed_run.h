#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <mpi.h>

#include "common/parallel.h"
#include "io/csv_file.h"
#include "model/model.h"
#include "model/model_scheme.h"
#include "observers/observer.h"
#include "output/result_folder.h"
#include "scene/scene.h"

namespace pounding {

/// A number of steps, at least one, never more than the run has, nor than an int holds.
double whole_steps(const Model& model, double count);

/// Steps between two samples of the probes.
int record_stride(const Scene& scene, const Model& model);

/// Steps between two samples of the gaps, which the probes record as well.
std::int64_t gap_stride(const Scene& scene, const Model& model);

/// A run as its observers know it; all that is referred to outlives them.
struct ObservedRun {
  MPI_Comm comm;
  const Scene& scene;
  const Model& model;
  ModelScheme& scheme;

  std::string path(const std::string& name) const { return scene.output + "/" + name; }
  /// A file beside the checkpoint that this run continues; empty for a new run.
  std::string continued_path(const std::string& name) const;
  /// The lowest rank that knows gaps and impulses, -1 without contacts.
  int contact_root() const { return scheme.contact() != nullptr ? scheme.contact()->root() : -1; }
  bool is_contact_member() const {
    return scheme.contact() != nullptr && scheme.contact()->member();
  }
  bool is_contact_root() const { return rank_of(comm) == contact_root(); }
  std::vector<std::string> contact_names() const { return names_of(scene.contacts); }
  /// The first step from `step` on with a record of the history.
  std::int64_t next_record_step(std::int64_t step) const {
    return next_multiple(step, record_stride(scene, model));
  }
  /// The first step from `step` on with a line of the energy ledger.
  std::int64_t next_ledger_step(std::int64_t step) const {
    const std::int64_t first = std::max<std::int64_t>(step, 1);
    if (first > model.steps) return Observer::never;
    return std::min(next_multiple(first, scene.energy_interval), model.steps);
  }
};

/// A table among the results of a scene, its head written.
class ResultTable : public CsvFile {
 public:
  ResultTable(const Scene& scene, const ResultFile& file)
      : CsvFile(scene.output + "/" + file.name, scene.csv_digits) {
    header(file.columns);
  }
};

/// An output of a run, in one value: its files, and the observer that makes them; its facts for the
/// summary and its columns in the history come from that.
struct OutputKind {
  /// Makes the observer, `before` it those whose kinds come before; null where nothing observes the
  /// steps: the job writes the files.
  using Make = std::unique_ptr<Observer> (*)(const ObservedRun& run, Observers& before);
  using Asked = bool (*)(const ObservedRun& run);

  std::vector<ResultFile> files;
  Make make = nullptr;
  Asked asked = nullptr;    ///< whether a run has it; null: every one
  bool in_members = false;  ///< of ensembles as well
};

/// The kind of an output whose observer is made of a run, or of a run and those before it.
template <typename Kind>
OutputKind output(std::vector<ResultFile> files, OutputKind::Asked asked = nullptr,
                  bool in_members = false) {
  const auto make = [](const ObservedRun& run, Observers& before) -> std::unique_ptr<Observer> {
    if constexpr (std::is_constructible_v<Kind, const ObservedRun&, Observers&>) {
      return std::make_unique<Kind>(run, before);
    } else {
      return std::make_unique<Kind>(run);
    }
  };
  return {std::move(files), make, asked, in_members};
}

}  // namespace pounding
