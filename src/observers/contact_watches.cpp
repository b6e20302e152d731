#include "observers/contact_watches.h"

#include <cmath>
#include <span>

#include "common/saved_state.h"
#include "interactions/contact_operator.h"
#include "interactions/interface_rows.h"
#include "interactions/pairing/interface.h"
#include "io/csv_file.h"
#include "observers/impact_catalogue.h"
#include "observers/run_statistics.h"
#include "system/trace.h"

namespace pounding {
namespace {

const ResultFile impact_table{"impacts.csv", "the impacts of the contacts", impact_columns};
const ResultFile point_table{"contact_points.csv", "the impulse of each pair of the contacts",
                             "contact,x,y,z,impulse"};

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

class ImpactWatch final : public Observer {
 public:
  explicit ImpactWatch(const ObservedRun& run)
      : run_(run),
        root_(std::max(run.contact_root(), 0)),
        catalogue_(make_catalogue(run.scene, run.model)) {}
  /// Complete on the root of the contacts, after `finish` on every rank.
  const ImpactCatalogue* impacts() const override { return &catalogue_; }

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

/// The numbers of a slide in a saved state.
constexpr auto slide_members = [](auto& slide, const auto& take) {
  take(slide.distance, slide.facet_size, slide.since);
};

constexpr auto pass_members = [](auto& other, const auto& take) {
  take(other.depth, other.facet_size, other.place[0], other.place[1], other.time);
};

/// Two rows along the faces for every pair, then one across them for those of passes not taken.
std::vector<interactions::Constraint> looked_at(const interactions::Interface& interface) {
  std::vector<interactions::Constraint> rows = interactions::tangential_rows(interface.constraints);
  rows.insert(rows.end(), interface.watched.begin(), interface.watched.end());
  return rows;
}

class SlideWatch final : public Observer {
 public:
  explicit SlideWatch(const ObservedRun& run);

  std::int64_t next_due(std::int64_t step) const override { return next_multiple(step, stride_); }
  StepNeeds begin(const CdLagrange& stepper) override;
  void save(SavedState& saved) override {
    if (gather_.root() != rank_of(run_.comm)) return;
    saved.put("contact_slide", to_rows(slides_, slide_members), 3);
    saved.put("contact_other_pass", to_rows(passes_, pass_members), 5);
  }
  void load(const SavedState& saved) override {
    std::vector<double> values(3 * slides_.size());
    saved.get("contact_slide", values);
    from_rows(values, slides_, slide_members);
    values.resize(5 * passes_.size());
    saved.get("contact_other_pass", values);
    from_rows(values, passes_, pass_members);
  }
  void report(RunStatistics& statistics) override {
    statistics.slides = slides_;
    statistics.other_passes = passes_;
    broadcast_values(run_.comm, gather_.root(), statistics.slides, statistics.other_passes);
  }

 private:
  /// Gathers the displacements of the operator's dofs, of every structure's displacements and of
  /// the supports. Members only, collective over them.
  void gather(const auto& of, std::span<const double> supports);
  /// Looks at all pairs at a time [s]. Members only, collective over them.
  void look(double time);
  /// Opening of a row of a pass that is not taken since it was unloaded [m].
  double opening_of(std::size_t row) const {
    return operator_.apply(static_cast<int>(2 * run_.model.interface.constraints.size() + row),
                           displacement_);
  }

  ObservedRun run_;
  std::int64_t stride_;  ///< steps between two looks
  interactions::ContactOperator operator_;
  std::vector<Trace> traces_;             ///< per structure
  std::vector<std::size_t> first_known_;  ///< per structure, into the values of this rank
  interactions::InterfaceGather gather_;
  std::vector<double> mine_;
  std::vector<double> displacement_;  ///< per dof of the operator
  std::vector<Slide> slides_;         ///< per contact
  std::vector<OtherPass> passes_;     ///< per contact
  std::vector<double> start_gaps_;    ///< per row of passes that are not taken [m]
};

/// Contact ratio of a mat on compression-only springs: the stiffness of those that are pressed over
/// that of all, 1 as long as nothing lifts off.
struct ContactRatio {
  double now = 1;           ///< at the last look
  double smallest = 1;      ///< of all looks
  double time = 0;          ///< of the smallest [s]
  double low_duration = 0;  ///< time below 80 % [s]

  /// Ratio below which the time counts.
  static constexpr double low = 0.8;
};

/// The numbers of a ratio in a saved state.
constexpr auto ratio_members = [](auto& ratio, const auto& take) {
  take(ratio.now, ratio.smallest, ratio.time, ratio.low_duration);
};

class UpliftWatch final : public Observer {
 public:
  explicit UpliftWatch(const ObservedRun& run) : run_(run), ratios_(run.model.systems.size()) {}

  std::int64_t next_due(std::int64_t step) const override { return run_.next_ledger_step(step); }
  void observe(const CdLagrange& stepper) override;
  void save(SavedState& saved) override {
    if (rank_of(run_.comm) == 0) saved.put("contact_ratio", to_rows(ratios_, ratio_members));
  }
  void load(const SavedState& saved) override {
    std::vector<double> numbers(4 * ratios_.size());
    saved.get("contact_ratio", numbers);
    from_rows(numbers, ratios_, ratio_members);
  }
  void report(RunStatistics& statistics) override;

 private:
  ObservedRun run_;
  std::vector<ContactRatio> ratios_;  ///< per structure, alike on all ranks
};

/// Closings below this part of the gap are no motion.
constexpr double least_share = 1e-6;

class ContactHistory final : public Observer {
 public:
  explicit ContactHistory(const ObservedRun& run)
      : run_(run),
        gap_stride_(gap_stride(run.scene, run.model)),
        impulses_(run.scene.contacts.size(), 0.0),
        values_(2 * impulses_.size()),
        closings_(impulses_.size()) {}

  std::int64_t next_due(std::int64_t step) const override { return run_.next_record_step(step); }
  StepNeeds begin(const CdLagrange& stepper) override {
    return {.gaps = stepper.state().step % gap_stride_ == 0};
  }
  bool follows() const override { return run_.is_contact_root(); }
  void follow(const CdLagrange& stepper) override;
  void observe(const CdLagrange& stepper) override;
  void save(SavedState& saved) override;
  void load(const SavedState& saved) override;
  void report(RunStatistics& statistics) override;
  std::optional<RecordColumns> columns() const override;

 private:
  int contact_of(std::size_t row) const { return run_.model.interface.constraints[row].contact; }
  void note_closing(std::size_t row, double gap);

  ObservedRun run_;
  std::int64_t gap_stride_;       ///< steps between two samples of the gaps
  std::vector<double> impulses_;  ///< per contact, since the last record [N s]
  std::vector<double> values_;    ///< gap and force of each contact
  std::vector<JointClosing> closings_;
};

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

void ImpactWatch::report(RunStatistics& statistics) {
  for (std::size_t c = 0; c < run_.scene.contacts.size(); ++c) {
    statistics.impacts.push_back(catalogue_.totals(static_cast<int>(c)));
  }
  statistics.all_impacts = catalogue_.totals();
  on_rank0(run_.comm, [&] {
    write_impacts(run_.path(impact_table.name), run_.contact_names(), catalogue_.impacts(),
                  run_.scene.csv_digits);
    ResultTable points(run_.scene, point_table);
    const auto& rows = run_.model.interface.constraints;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      points.row(run_.contact_names()[rows[i].contact],
                 {rows[i].at[0], rows[i].at[1], rows[i].at[2], catalogue_.row_impulses()[i]});
    }
    points.close();
  });
}

OutputKind impact_output() {
  return output<ImpactWatch>({impact_table, point_table}, nullptr, true);
}

SlideWatch::SlideWatch(const ObservedRun& run)
    : run_(run),
      stride_(
          static_cast<std::int64_t>(std::max(1.0, OtherPass::look_interval / run.model.time_step))),
      operator_(run.comm, looked_at(run.model.interface), run.model.meshes),
      traces_(interactions::make_traces(operator_, run.model.systems, run.model.meshes, false)),
      gather_(run.comm,
              interactions::known_dofs(
                  interactions::dofs_by_structure(operator_, run.model.systems.size()), traces_)),
      displacement_(static_cast<std::size_t>(operator_.dofs()), 0.0),
      slides_(run.scene.contacts.size()),
      passes_(run.scene.contacts.size()) {
  std::size_t known = 0;
  for (const Trace& trace : traces_) {
    first_known_.push_back(known);
    known += trace.known().size();
  }
  mine_.assign(known, 0.0);
  const std::vector<interactions::Constraint>& watched = run.model.interface.watched;
  for (const interactions::Constraint& row : watched) start_gaps_.push_back(row.initial_gap);
  if (!run.model.equilibrium || watched.empty() || !gather_.member()) return;
  gather([&](std::size_t s) { return run.model.systems[s].rest_displacement.data(); }, {});
  for (std::size_t w = 0; w < watched.size(); ++w) {
    if (run.scene.contacts[watched[w].contact].gap_at_rest) start_gaps_[w] -= opening_of(w);
  }
}

void SlideWatch::gather(const auto& of, std::span<const double> supports) {
  for (std::size_t s = 0; s < traces_.size(); ++s) {
    traces_[s].apply(of(s), mine_.data() + first_known_[s], 1, supports);
  }
  gather_.gather(1, mine_, displacement_);
}

StepNeeds SlideWatch::begin(const CdLagrange& stepper) {
  if (!gather_.member()) return {};
  const State& state = stepper.state();
  gather([&](std::size_t s) { return state.structures[s].displacement.data(); },
         state.supports.displacement);
  look(static_cast<double>(state.step) * stepper.time_step());
  return {};
}

void SlideWatch::look(double time) {
  int row = 0;  // two per pair
  for (const interactions::Constraint& constraint : run_.model.interface.constraints) {
    const double distance =
        std::hypot(operator_.apply(row, displacement_), operator_.apply(row + 1, displacement_));
    row += 2;
    const double size = constraint.facet_size;
    Slide& slide = slides_[constraint.contact];
    if (size > 0 && distance > Slide::limit * size && slide.since < 0) slide.since = time;
    // All pairs of a contact face facets, or all a wall.
    if (size > 0 ? distance * slide.facet_size > slide.distance * size || slide.facet_size == 0
                 : distance > slide.distance) {
      slide.distance = distance;
      slide.facet_size = size;
    }
  }
  for (std::size_t w = 0; w < start_gaps_.size(); ++w) {
    const interactions::Constraint& other = run_.model.interface.watched[w];
    const double depth = -(start_gaps_[w] + opening_of(w));
    OtherPass& deepest = passes_[other.contact];
    const bool beside = slides_[other.contact].distance > Slide::limit * other.facet_size;
    if (depth > deepest.depth && !beside) deepest = {depth, other.facet_size, other.place, time};
  }
}

OutputKind slide_output() {
  return output<SlideWatch>({}, [](const ObservedRun& run) { return run.contact_root() >= 0; });
}

void UpliftWatch::observe(const CdLagrange& stepper) {
  const int between = run_.scene.energy_interval;
  const std::int64_t rest = (stepper.state().step - 1) % between;  // of the last line
  const double interval = static_cast<double>(rest == 0 ? between : rest) * stepper.time_step();
  std::vector<double> sums;  // pressed and all, structure by structure
  for (std::size_t s = 0; s < ratios_.size(); ++s) {
    const interactions::StructureLinks* const links = run_.solver.links(s);
    const auto bedding =
        links != nullptr ? links->bedding() : interactions::StructureLinks::Bedding{};
    sums.insert(sums.end(), {bedding.pressed, bedding.all});
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                run_.comm);
  for (std::size_t s = 0; s < ratios_.size(); ++s) {
    if (!(sums[2 * s + 1] > 0)) continue;
    ContactRatio& ratio = ratios_[s];
    ratio.now = sums[2 * s] / sums[2 * s + 1];
    if (ratio.now < ContactRatio::low) ratio.low_duration += interval;
    if (ratio.now < ratio.smallest) {
      ratio.smallest = ratio.now;
      ratio.time = stepper.time();
    }
  }
}

void UpliftWatch::report(RunStatistics& statistics) {
  for (std::size_t s = 0; s < ratios_.size(); ++s) {
    const ContactRatio& ratio = ratios_[s];
    const std::string& name = run_.scene.structures[s].name;
    statistics.findings.add(
        "contact_ratio", name,
        {{"end", ratio.now},
         {"smallest", ratio.smallest},
         {"time_of_smallest", ratio.time},
         {"time_below_80_percent", ratio.low_duration}},
        "  {:-12s} contact ratio of its compression-only springs {end:.3f} at the end, at least "
        "{smallest:.3f} at {time_of_smallest:.4g} s, below {:.0f %} for "
        "{time_below_80_percent:.4g} s\n",
        {name, ContactRatio::low});
  }
}

OutputKind uplift_output() {
  return output<UpliftWatch>({}, [](const ObservedRun& run) {
    return std::ranges::any_of(run.scene.structures, [](const Structure& structure) {
      return std::ranges::any_of(structure.regions, [](const Region& region) {
        return region.compression_only && is_spring(region.element);
      });
    });
  });
}

void ContactHistory::follow(const CdLagrange& /*stepper*/) {
  if (!run_.solver.rows_act()) return;
  const std::span<const double> impulses = run_.solver.row_actions().impulses;
  for (std::size_t row = 0; row < impulses.size(); ++row) {
    impulses_[contact_of(row)] += impulses[row];
  }
}

void ContactHistory::observe(const CdLagrange& /*stepper*/) {
  if (!run_.is_contact_root()) return;
  const bool known = run_.solver.interface_known();
  for (std::size_t c = 0; c < impulses_.size(); ++c) {
    values_[2 * c] =
        known ? std::numeric_limits<double>::max() : std::numeric_limits<double>::quiet_NaN();
    values_[2 * c + 1] =
        impulses_[c] / (run_.model.time_step * record_stride(run_.scene, run_.model));
    impulses_[c] = 0;
  }
  if (!known) return;
  const std::span<const double> gaps = run_.solver.contact()->gaps();
  for (std::size_t row = 0; row < gaps.size(); ++row) {
    double& smallest = values_[2 * contact_of(row)];
    smallest = std::min(smallest, gaps[row]);
    note_closing(row, gaps[row]);
  }
}

void ContactHistory::note_closing(std::size_t row, double gap) {
  const double start = run_.model.start_gaps[row];
  const double closing = start - gap;
  if (start == interactions::open_gap || gap == interactions::open_gap || !(closing > 0)) return;
  JointClosing& joint = closings_[contact_of(row)];
  joint.largest = std::max(joint.largest, closing);
  if (closing > least_share * start) {
    joint.factor = std::min(joint.factor, std::max(0.0, start) / closing);
  }
}

std::optional<RecordColumns> ContactHistory::columns() const {
  RecordColumns columns{"contacts", run_.contact_names(), {}, {}, {}};
  if (!columns.names.empty()) columns.quantities = {{"gap", "m"}, {"contact_force", "N"}};
  if (run_.is_contact_root()) columns.take_all(values_);
  return columns;
}

void ContactHistory::save(SavedState& saved) {
  if (run_.is_contact_root()) saved.put("recorder_impulse", impulses_);
  if (rank_of(run_.comm) != std::max(run_.contact_root(), 0)) return;
  std::vector<double> numbers;
  for (const JointClosing& joint : closings_) {
    // A joint that never closes has no factor, and no infinite number goes into files.
    const bool closes = std::isfinite(joint.factor);
    numbers.insert(numbers.end(), {joint.largest, closes ? joint.factor : -1});
  }
  saved.put("joint_closings", numbers, 2);
}

void ContactHistory::load(const SavedState& saved) {
  if (run_.contact_root() >= 0) saved.get("recorder_impulse", impulses_);
  std::vector<double> numbers(2 * closings_.size());
  saved.get("joint_closings", numbers);
  for (std::size_t c = 0; c < closings_.size(); ++c) {
    closings_[c].largest = numbers[2 * c];
    if (numbers[2 * c + 1] >= 0) closings_[c].factor = numbers[2 * c + 1];
  }
}

void ContactHistory::report(RunStatistics& statistics) {
  if (run_.contact_root() < 0) return;
  statistics.closings = closings_;
  broadcast_values(run_.comm, run_.contact_root(), statistics.closings);
}

OutputKind contact_history_output() {
  return output<ContactHistory>({});
}

}  // namespace pounding
