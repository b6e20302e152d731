#include "observers/observers.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "observers/contact_watches.h"
#include "observers/field_plan.h"
#include "observers/forces.h"
#include "observers/loops.h"
#include "observers/model_file.h"
#include "observers/run_progress.h"
#include "observers/storeys.h"
#include "observers/watchdog.h"
#include "observers/yield_table.h"

namespace pounding {
namespace {

/// A new run removes those of an earlier one.
constexpr std::array tables{"impacts.csv", "contact_points.csv", "energy.csv", "forces.csv",
                            "yielding.csv"};

/// A file beside the checkpoint that a run continues; empty for a new run.
std::string continued_file(const Scene& scene, const char* name) {
  if (scene.restart.empty()) return "";
  return std::filesystem::path(scene.restart).replace_filename(name);
}

/// `history.h5`, with the columns of those that see a step before it.
std::unique_ptr<Recorder> make_history(const ObservedRun& run, const Observers& others) {
  Recorder::Layout layout;
  layout.comm = run.comm;
  layout.path = run.scene.output + "/history.h5";
  layout.continued = continued_file(run.scene, "history.h5");
  layout.title = run.scene.title;
  layout.probes = run.model.probes;
  for (const auto& other : others.list()) {
    if (auto columns = other->columns()) layout.columns.push_back(std::move(*columns));
  }
  layout.bases = run.model.storey_bases;
  layout.storeys = find_storeys(run.comm, run.scene, run.model);
  layout.stride = record_stride(run.scene, run.model);
  layout.time_step = run.model.time_step;
  layout.peaks_start = run.scene.spectra.start;
  return std::make_unique<Recorder>(std::move(layout), run.model.systems, run.model.meshes);
}

std::unique_ptr<FieldWriter> make_fields(const ObservedRun& run) {
  FieldWriter::Layout layout;
  layout.comm = run.comm;
  layout.folder = run.scene.output;
  layout.continued = continued_file(run.scene, "fields.h5");
  layout.title = run.scene.title;
  layout.time_step = run.model.time_step;
  layout.steps = planned_fields(run.scene, run.model).value();
  layout.xdmf = run.scene.fields_format != FieldsFormat::vtkhdf;
  layout.vtkhdf = run.scene.fields_format != FieldsFormat::xdmf;
  layout.yields = yielding_structures(run.scene);
  layout.yielding = [run](std::size_t structure) { return yielding_elements(run, structure); };
  layout.labels = mesh_labels(run.scene, run.model.interface);
  layout.impulse_root = std::max(run.contact_root(), 0);
  if (run.contact_root() >= 0) {
    for (const interactions::InterfaceDof& dof : run.solver.contact()->dof_list()) {
      layout.places.push_back({dof.structure, dof.node, dof.component});
    }
    layout.add_impulses = [&solver = run.solver](std::span<double> sums) {
      if (solver.touching()) solver.contact()->add_dof_impulses(sums);
    };
  }
  return std::make_unique<FieldWriter>(std::move(layout), run.model.systems, run.model.meshes);
}

bool may_lift_off(const Scene& scene) {
  return std::ranges::any_of(scene.structures, [](const Structure& structure) {
    return std::ranges::any_of(structure.regions, [](const Region& region) {
      return region.compression_only && is_spring(region.element);
    });
  });
}

}  // namespace

RunObservers make_observers(const ObservedRun& run, Profile& profile) {
  Observers all(profile);
  const auto& impacts = all.add(std::make_unique<ImpactWatch>(run));
  all.add(make_contact_history(run));
  if (!run.scene.loops.empty()) all.add(make_loops(run));
  if (!run.scene.forces.empty()) all.add(make_forces(run));
  const auto& history = all.add(make_history(run, all));
  if (run.scene.fields_interval > 0) all.add(make_fields(run));
  if (run.contact_root() >= 0) all.add(make_slide_watch(run));
  all.add(make_energy_watch(run));
  if (may_lift_off(run.scene)) all.add(make_uplift_watch(run));
  const std::vector<char> yields = yielding_structures(run.scene);
  if (std::ranges::count(yields, 0) < std::ssize(yields)) all.add(make_yield_table(run));
  all.add(make_progress_watch(run, impacts.catalogue()));
  return {std::move(all), impacts, history};
}

std::span<const char* const> tables_of_observers() {
  return tables;
}

}  // namespace pounding
