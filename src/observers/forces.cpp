#include "observers/forces.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "common/saved_state.h"
#include "elements/force_rows.h"
#include "observers/run_statistics.h"
#include "observers/total_force.h"
#include "system/element_forces.h"

namespace pounding {
namespace {

bool has_history(const ForceItem& force) {
  return !force.of_elements() || !force.points.empty();
}

/// Refuses a total of a reduced structure whose links are beside modes that hold them at their
/// stiffest.
void refuse_relieved(const ForceItem& force, const LinearSystem& system) {
  if (!system.generalised || !system.has_laws_beside) return;
  throw UserError("option -" + force.name + "_kind: structure " + force.structure +
                  " is reduced and has elements that yield or act in one direction only; give -" +
                  force.structure + "_model full, or -loops for these elements");
}

/// Refuses a total of a reduced structure made of matrices: it would be that of the elements.
void refuse_beside_matrices(const ForceItem& force, const Structure& structure,
                            const LinearSystem& system) {
  if (!system.generalised || structure.matrices.empty()) return;
  throw UserError("option -" + force.name + "_kind: structure " + force.structure +
                  " is reduced and made of -" + force.structure +
                  "_matrices, and forces of modes come from elements; give -" + force.structure +
                  "_model full");
}

std::vector<std::string> components_of(const ForceItem& force, const Structure& structure) {
  if (!force.of_elements()) return {total_force_names.begin(), total_force_names.end()};
  const auto region = std::ranges::find(structure.regions, force.group, &Region::group);
  const auto names = element_force_names(region->element);
  return {names.begin(), names.end()};
}

/// Unit of a component: of shells forces and moments are per length.
const char* unit_of(const std::string& component) {
  const bool moment = component[0] == 'M' || component[0] == 'T';
  const bool of_shells = std::ranges::find(shell_force_names, component) != shell_force_names.end();
  if (of_shells) return moment ? "N" : "N/m";
  return moment ? "N m" : "N";
}

const ResultFile force_table{"forces.csv", "the largest forces of the samples",
                             "item,component,unit,element,peak,time"};

/// The value of a force that was largest in magnitude, and when.
struct ForcePeak {
  double value = 0;  ///< [N, N m], of shells per length [N/m, N]
  double time = 0;   ///< [s]
};

/// An item of the option `forces`.
struct ForceReport {
  std::string name{};
  std::vector<std::string> components{};  ///< "Fx", "N", ...
  std::vector<std::string> elements{};    ///< numbers in the file; one empty name of a total
  std::optional<Vector3> about{};         ///< of a total: point that its moments are about [m]
  std::size_t first = 0;                  ///< of its columns, shape (elements, components)
};

/// The numbers of a peak in a saved state.
constexpr auto peak_members = [](auto& peak, const auto& take) { take(peak.value, peak.time); };

class Forces final : public Observer {
 public:
  explicit Forces(const ObservedRun& run) : run_(run), peaks_start_(run.scene.spectra.start) {
    const Scene& scene = run.scene;
    const Model& model = run.model;
    lay_out();
    for (std::size_t s = 0; s < model.systems.size(); ++s) {
      const Mesh& mesh = *model.buildings[s].mesh;
      std::vector<ElementForces::Row> rows;
      on_every_rank(run.comm, [&] {
        for (std::size_t i = 0; i < items_.size(); ++i) {
          if (model.forces[i].structure != static_cast<int>(s)) continue;
          const ForceItem& force = scene.forces[i];
          const std::size_t first = items_[i].first;
          const auto add = [&rows](std::vector<ElementForces::Row> more) {
            std::ranges::move(more, std::back_inserter(rows));
          };
          if (force.of_elements()) {
            add(member_rows(scene.structures[s], mesh, model.forces[i], first));
            continue;
          }
          const bool cut = force.kind == ForceKind::cut;
          if (!cut) {
            refuse_relieved(force, model.systems[s]);
            refuse_beside_matrices(force, scene.structures[s], model.systems[s]);
          }
          std::vector<ElementForces::Row> passing;
          if (cut || model.systems[s].generalised) {
            passing = total_rows(scene.structures[s], mesh, force, model.forces[i], first);
          }
          if (cut) {
            add(std::move(passing));
            continue;
          }
          totals_.push_back(
              {s,
               first,
               std::make_unique<TotalForce>(force, model.systems[s], mesh, model.interface.soil, s),
               {}});
          if (model.systems[s].generalised) {
            totals_.back().elements =
                std::make_unique<ElementForces>(model.systems[s], mesh, passing);
          }
        }
      });
      if (rows.empty()) continue;
      elements_.push_back({s, std::make_unique<ElementForces>(model.systems[s], mesh, rows)});
    }
    for (const Total& total : totals_) {
      total.force->find_modes(model.systems[total.structure]);
      run.scheme.stepper().watch_forces(total.structure, total.force->dofs());
    }
  }

  std::int64_t next_due(std::int64_t step) const override { return run_.next_record_step(step); }
  StepNeeds begin(const CdLagrange& stepper) override {
    supports_ = stepper.state().supports.displacement;
    std::ranges::fill(part_, 0.0);
    for (Elements& of : elements_) {
      of.forces->add(stepper.displacement(of.structure), supports_, part_);
    }
    return {.forces = true};
  }

  void observe(const CdLagrange& stepper) override {
    for (const Total& total : totals_) {
      Wrench sum{};
      total.force->add(stepper, total.structure, run_.scheme.links(total.structure),
                       run_.scheme.inelastic(total.structure), run_.scheme.soil(), sum);
      for (std::size_t k = 0; k < sum.size(); ++k) part_[total.first + k] += sum[k];
      if (total.elements) {
        total.elements->add(acting_displacement(total.structure), supports_, part_);
      }
    }
    MPI_Reduce(part_.data(), columns_.data(), static_cast<int>(part_.size()), MPI_DOUBLE, MPI_SUM,
               0, run_.comm);
    if (rank_of(run_.comm) != 0 || stepper.time() < peaks_start_) return;
    for (std::size_t c = 0; c < peaks_.size(); ++c) {
      const ForcePeak now{columns_[c], stepper.time()};
      if (std::abs(now.value) > std::abs(peaks_[c].value)) peaks_[c] = now;
    }
  }

  void keep_state(const StateKeeper& state) override {
    const StateKeeper own = state.known_if(rank_of(run_.comm) == 0);
    const double time = run_.scheme.stepper().time();
    double start = peaks_start_;
    own.rows("force_peaks", peaks_, peak_members);
    own.numbers("force_peaks_start", start);
    if (start == peaks_start_) return;
    refuse_if(
        time >= peaks_start_,
        sentence("option -spectra_start {:.12g} s: the peaks of forces were counted from {:.12g} "
                 "s on until the checkpoint at {:.12g} s; give -spectra_start {:.12g}, one after "
                 "the checkpoint, or start anew",
                 {peaks_start_, start, time, start}));
    peaks_.assign(peaks_.size(), {});  // summed up from zero
  }

  void report(RunStatistics& statistics) override {
    if (statistics.complete) on_rank0(run_.comm, [&] { write_table(); });
    if (rank_of(run_.comm) != 0) return;
    Facts facts;
    facts.say("\nforce       largest kN, kN m (of shells per m) of samples      at s   element\n");
    for (const ForceReport& item : items_) {
      for (std::size_t c = 0; c < item.components.size(); ++c) {
        const auto peak = [&](std::size_t e) {
          return peaks_[item.first + e * item.components.size() + c];
        };
        std::size_t most = 0;
        for (std::size_t e = 1; e < item.elements.size(); ++e) {
          if (std::abs(peak(e).value) > std::abs(peak(most).value)) most = e;
        }
        Json& of = facts.values["forces"][item.name][item.components[c]] =
            Json{{"peak", peak(most).value}, {"time", peak(most).time}};
        if (!item.elements[most].empty()) of["element"] = std::stoll(item.elements[most]);
        facts.text += told("  {:-18s} {peak:24.6g [kN]} {time:19.5f}   [{element}]\n", of,
                           {item.name + "." + item.components[c]});
      }
      if (!item.about) continue;
      facts.values["moments_about"][item.name] = *item.about;
      facts.say("    moments about {:.6g} m\n", {*item.about});
    }
    statistics.findings.add(facts);
  }

  std::optional<RecordColumns> columns() const override {
    if (recorded_.empty()) return std::nullopt;
    RecordColumns columns{"forces", recorded_, {{"force", unit_}}, {}, {}};
    if (rank_of(run_.comm) == 0) columns.take_all({columns_.data(), recorded_.size()});
    return columns;
  }

 private:
  struct Total {
    std::size_t structure = 0;
    std::size_t first = 0;
    std::unique_ptr<TotalForce> force;
    std::unique_ptr<ElementForces> elements;  ///< in generalised coordinates
  };
  /// Elements of a structure whose forces are asked for.
  struct Elements {
    std::size_t structure = 0;
    std::unique_ptr<ElementForces> forces;
  };
  void lay_out() {
    const Scene& scene = run_.scene;
    const Model& model = run_.model;
    for (std::size_t i = 0; i < scene.forces.size(); ++i) {
      const ForceItem& force = scene.forces[i];
      ForceReport& item = items_.emplace_back();
      item.name = force.name;
      item.components = components_of(
          force, scene.structures[static_cast<std::size_t>(model.forces[i].structure)]);
      if (!force.of_elements()) {
        item.elements = {""};
        item.about = force.point();
        continue;
      }
      for (const std::int64_t element : model.forces[i].elements) {
        item.elements.push_back(std::to_string(element));
      }
    }
    std::size_t next = 0;
    for (const bool recorded : {true, false}) {
      for (std::size_t i = 0; i < items_.size(); ++i) {
        if (has_history(scene.forces[i]) != recorded) continue;
        if (recorded && scene.forces[i].kind == ForceKind::shells) {
          unit_ = "N, N m; of shells N/m, N m/m";
        }
        items_[i].first = next;
        next += items_[i].elements.size() * items_[i].components.size();
        for (std::size_t e = 0; recorded && e < items_[i].elements.size(); ++e) {
          const std::string& element = items_[i].elements[e];
          for (const std::string& component : items_[i].components) {
            recorded_.push_back(items_[i].name + (element.empty() ? "" : "." + element) + "." +
                                component);
          }
        }
      }
    }
    part_.assign(next, 0.0);
    columns_.assign(next, 0.0);
    peaks_.assign(next, {});
  }

  /// Displacements of generalised coordinates at which K u is the force of the last step, damping
  /// included; of one without stiffness its own.
  std::span<const double> acting_displacement(std::size_t structure) {
    const CdLagrange& stepper = run_.scheme.stepper();
    const std::vector<double>& squares = run_.model.buildings[structure].basis->squared_frequency;
    acting_ = stepper.displacement(structure);
    for (std::size_t i = 0; i < acting_.size(); ++i) {
      if (squares[i] > 0) {
        acting_[i] = stepper.force(structure, static_cast<LocalIndex>(i)) / squares[i];
      }
    }
    return acting_;
  }

  /// Rank 0.
  void write_table() const {
    ResultTable file(run_.scene, force_table);
    for (const ForceReport& item : items_) {
      std::size_t column = item.first;
      for (const std::string& element : item.elements) {
        for (const std::string& component : item.components) {
          const ForcePeak& peak = peaks_[column++];
          file.row(item.name + "," + component + "," + unit_of(component),
                   {element.empty() ? 0.0 : std::stod(element), peak.value, peak.time});
        }
      }
    }
    file.close();
  }

  ObservedRun run_;
  double peaks_start_;
  std::vector<ForceReport> items_;
  std::vector<std::string> recorded_;  ///< columns with a history, which are the first
  std::string unit_ = "N, N m";
  std::vector<Total> totals_;
  std::vector<Elements> elements_;
  std::vector<double> supports_;  ///< displacements at the time of the sample
  std::vector<double> acting_;
  std::vector<double> part_;     ///< of this rank, per column
  std::vector<double> columns_;  ///< sums, rank 0
  std::vector<ForcePeak> peaks_;
};

}  // namespace

OutputKind forces_output() {
  return output<Forces>(
      {force_table}, [](const ObservedRun& run) { return !run.scene.forces.empty(); }, true);
}

}  // namespace pounding
