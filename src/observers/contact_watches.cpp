#include <cmath>
#include <span>

#include "common/saved_state.h"
#include "observers/impact_catalogue.h"
#include "observers/member_result.h"
#include "observers/observed_run.h"
#include "observers/run_statistics.h"

namespace pounding {
namespace {

const ResultFile impact_table{"impacts.csv", "the impacts of the contacts", impact_columns};
const ResultFile point_table{"contact_points.csv", "the impulse of each pair of the contacts",
                             "contact,x,y,z,impulse"};

/// Per row of the interface.
std::vector<int> contacts_of_rows(const Model& model) {
  std::vector<int> contacts;
  for (const auto& constraint : model.interface.constraints) contacts.push_back(constraint.contact);
  return contacts;
}

/// Rows of a rank times steps that the catalogue counts at a time, so that they stay in the caches.
constexpr std::size_t counted_at_a_time = 16000;

/// The catalogue of a scene's contacts, still empty.
ImpactCatalogue make_catalogue(const ObservedRun& run) {
  std::vector<std::array<double, 2>> places;
  for (const interactions::Constraint& constraint : run.model.interface.constraints) {
    places.push_back(constraint.place);
  }
  std::optional<CountedRows> counted;
  if (const interactions::ContactProblem* const contact = run.scheme.contact()) {
    const std::size_t members = contact->members();
    const std::size_t steps = counted_at_a_time * members / places.size();
    counted = {contact->comm(),
               {contact->counted().begin(), contact->counted().end()},
               members == 1 ? 1 : std::clamp(steps, std::size_t{4}, std::size_t{64}),
               contact->friction().has_any()};
  }
  return {static_cast<int>(run.scene.contacts.size()),
          contacts_of_rows(run.model),
          std::move(places),
          {run.scene.impact_merge_time, run.scene.force_window, run.model.time_step},
          std::move(counted)};
}

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

/// Closings below this part of the gap are no motion.
constexpr double least_share = 1e-6;

/// The numbers of a joint in a saved state: one that never closes has no factor, and no infinite
/// number goes into files.
constexpr auto closing_members = [](auto& joint, const auto& take) {
  double factor = std::isfinite(joint.factor) ? joint.factor : -1;
  take(joint.largest, factor);
  if (factor >= 0) joint.factor = factor;
};

/// The numbers of a pair in a saved state.
constexpr auto least_gap_members = [](auto& pair, const auto& take) {
  take(pair.least_gap, pair.time, pair.gap_then);
};

/// Impacts of a run, from the impulses of its steps: `impacts.csv` and `contact_points.csv`.
class ImpactWatch final : public Observer {
 public:
  explicit ImpactWatch(const ObservedRun& run)
      : run_(run), root_(std::max(run.contact_root(), 0)), catalogue_(make_catalogue(run)) {}
  /// Complete after `finish`; before, some steps of several ranks may be missing.
  const ImpactCatalogue* impacts() const override { return &catalogue_; }

  bool follows() const override { return run_.is_contact_member(); }
  void follow(const CdLagrange& stepper) override {
    if (run_.scheme.rows_may_act()) add_contact(stepper);
  }

  void finish(bool /*complete*/) override { catalogue_.finish(run_.comm, root_); }
  void keep_state(const StateKeeper& state) override {
    catalogue_.keep(state.known_if(rank_of(run_.comm) == root_), run_.comm, root_);
  }

  void keep(MemberResult& member) const override {
    const std::size_t contacts = run_.scene.contacts.size();
    for (std::size_t c = 0; c < contacts; ++c) {
      const ImpactTotals totals = catalogue_.totals(static_cast<int>(c));
      member.episodes.push_back(totals.episodes);
      member.impulse_sum.push_back(totals.total_impulse);
      member.impulse_largest.push_back(totals.largest_impulse);
      member.force_peak.push_back(totals.peak_force);
    }
    member.first_time.assign(contacts, std::numeric_limits<double>::quiet_NaN());
    member.slip.assign(contacts, 0.0);
    for (const Impact& impact : catalogue_.impacts()) {  // the earliest first
      double& first = member.first_time[impact.contact];
      if (!(first <= impact.start)) first = impact.start;
      member.slip[impact.contact] += impact.slip;
    }
  }

  void report(RunStatistics& statistics) override {
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

 private:
  void add_contact(const CdLagrange& stepper) {
    const interactions::ContactProblem& contact = *run_.scheme.contact();
    ContactStep step;
    if (run_.scheme.rows_act()) {
      const auto [impulses, works] = run_.scheme.row_actions();
      step = {contact.gaps(), impulses, works, {}, {}, {}};
    }
    if (contact.friction().has_any()) {
      step.tangential_impulses = contact.friction().tangential_impulses();
      step.slip_rates = contact.friction().slip_rates();
      step.friction_losses = contact.friction().losses();
    }
    catalogue_.add_step(stepper.time(), stepper.force_duration(), step);
  }

  ObservedRun run_;
  int root_;  ///< of the contacts, or rank 0 without them
  ImpactCatalogue catalogue_;
};

/// Contact ratio of every structure that has compression-only springs, at the lines of the energy
/// ledger.
class UpliftWatch final : public Observer {
 public:
  explicit UpliftWatch(const ObservedRun& run) : run_(run), ratios_(run.model.systems.size()) {}

  std::int64_t next_due(std::int64_t step) const override { return run_.next_ledger_step(step); }
  void observe(const CdLagrange& stepper) override {
    const int between = run_.scene.energy_interval;
    const std::int64_t rest = (stepper.state().step - 1) % between;  // of the last line
    const double interval = static_cast<double>(rest == 0 ? between : rest) * stepper.time_step();
    std::vector<double> sums;  // pressed and all, structure by structure
    for (std::size_t s = 0; s < ratios_.size(); ++s) {
      const interactions::StructureLinks* const links = run_.scheme.links(s);
      const auto bedding =
          links != nullptr ? links->bedding() : interactions::StructureLinks::Bedding{};
      sums.insert(sums.end(), {bedding.pressed, bedding.all});
    }
    reduce_over_ranks(run_.comm, MPI_SUM, sums);
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

  void keep_state(const StateKeeper& state) override {
    state.rows("contact_ratio", ratios_, ratio_members);
  }

  void report(RunStatistics& statistics) override {
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

 private:
  ObservedRun run_;
  std::vector<ContactRatio> ratios_;  ///< per structure, alike on all ranks
};

/// Smallest gap at t_n and mean force over the interval of each contact, for the history; and how
/// far the pairs have closed at the samples. Every rank looks at the rows that it counts.
class ContactHistory final : public Observer {
 public:
  explicit ContactHistory(const ObservedRun& run)
      : run_(run),
        gap_stride_(gap_stride(run.scene, run.model)),
        contact_of_(contacts_of_rows(run.model)),
        impulses_(run.scene.contacts.size(), 0.0),
        smallest_(impulses_.size()),
        values_(2 * impulses_.size()),
        closings_(impulses_.size()),
        pairs_(run.model.interface.constraints.size()) {}

  std::int64_t next_due(std::int64_t step) const override { return run_.next_record_step(step); }
  StepNeeds begin(const CdLagrange& stepper) override {
    return {.gaps = stepper.state().step % gap_stride_ == 0};
  }

  bool follows() const override { return run_.is_contact_member(); }
  void follow(const CdLagrange& /*stepper*/) override {
    if (!run_.scheme.rows_act()) return;
    const std::span<const double> impulses = run_.scheme.row_actions().impulses;
    for (const int row : run_.scheme.contact()->counted()) {
      impulses_[contact_of_[row]] += impulses[row];
    }
  }

  void observe(const CdLagrange& stepper) override {
    if (!run_.is_contact_member()) return;
    const bool known = run_.scheme.interface_known();
    std::ranges::fill(smallest_, known ? std::numeric_limits<double>::max()
                                       : std::numeric_limits<double>::quiet_NaN());
    if (known) {
      const std::span<const double> gaps = run_.scheme.contact()->gaps();
      for (const int row : run_.scheme.contact()->counted()) {
        smallest_[contact_of_[row]] = std::min(smallest_[contact_of_[row]], gaps[row]);
        pairs_[row].note(gaps[row], stepper.time());
        note_closing(static_cast<std::size_t>(row), gaps[row]);
      }
      run_.scheme.contact()->reduce(MPI_MIN, smallest_);
    }
    for (std::size_t c = 0; c < impulses_.size(); ++c) {
      values_[2 * c] = run_.is_contact_root() ? smallest_[c] : 0;  // ranks add up
      values_[2 * c + 1] =
          impulses_[c] / (run_.model.time_step * record_stride(run_.scene, run_.model));
      impulses_[c] = 0;
    }
  }
  void finish(bool /*complete*/) override { share(); }

  void keep_state(const StateKeeper& state) override {
    if (state.puts()) share();
    const int root = std::max(run_.contact_root(), 0);
    keep_contact_sums(state, run_.comm, root, "recorder_impulse", impulses_);
    const StateKeeper own = state.known_if(rank_of(run_.comm) == root);
    own.rows("joint_closings", closings_, closing_members);
    own.rows("pair_gaps", pairs_, least_gap_members);
  }

  void keep(MemberResult& member) const override {
    member.smallest_gap.assign(run_.scene.contacts.size(), std::numeric_limits<double>::infinity());
    member.pair_initial_gap = run_.model.start_gaps;
    for (std::size_t row = 0; row < pairs_.size(); ++row) {
      double& smallest = member.smallest_gap[contact_of_[row]];
      smallest = std::min(smallest, pairs_[row].least_gap);
      member.pair_least_gap.push_back(pairs_[row].least_gap);
      member.pair_time.push_back(pairs_[row].time);
    }
  }

  void report(RunStatistics& statistics) override {
    if (run_.contact_root() < 0) return;
    statistics.closings = closings_;
    statistics.pairs = pairs_;
    broadcast_values(run_.comm, run_.contact_root(), statistics.closings, statistics.pairs);
  }

  std::optional<RecordColumns> columns() const override {
    RecordColumns columns{"contacts", run_.contact_names(), {}, {}, {}};
    if (!columns.names.empty()) columns.quantities = {{"gap", "m"}, {"contact_force", "N"}};
    if (run_.is_contact_member()) columns.take_all(values_);
    return columns;
  }

 private:
  /// Brings pairs and closings to all ranks of the contacts.
  void share() {
    if (!run_.is_contact_member()) return;
    const interactions::ContactProblem& contact = *run_.scheme.contact();
    std::vector<double> pairs = to_rows(pairs_, least_gap_members);
    interactions::share_rows(contact.comm(), contact.counted(), 3, pairs);
    from_rows(pairs, pairs_, least_gap_members);
    for (JointClosing& joint : closings_) {
      reduce_over_ranks(contact.comm(), MPI_MAX, joint.largest);
      reduce_over_ranks(contact.comm(), MPI_MIN, joint.factor);
    }
  }
  void note_closing(std::size_t row, double gap) {
    const double start = run_.model.start_gaps[row];
    if (start == interactions::open_gap || gap == interactions::open_gap) return;
    auto& [largest, factor] = closings_[contact_of_[row]];
    const double closing = start - gap;
    largest = std::max(largest, closing);
    // A pair that is closed as the run starts is so whatever round-off makes of it.
    if (start <= run_.scheme.contact()->gap_tolerance()) factor = 0;
    if (start > 0 && closing > least_share * start) factor = std::min(factor, start / closing);
  }

  ObservedRun run_;
  std::int64_t gap_stride_;       ///< steps between two samples of the gaps
  std::vector<int> contact_of_;   ///< per row
  std::vector<double> impulses_;  ///< per contact, since the last record, of this rank [N s]
  std::vector<double> smallest_;  ///< gap of each contact
  std::vector<double> values_;    ///< gap and force of each contact
  std::vector<JointClosing> closings_;
  std::vector<PairMotion> pairs_;  ///< per row, without displacements
};

}  // namespace

OutputKind impact_output() {
  return output<ImpactWatch>({impact_table, point_table}, nullptr, true);
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

OutputKind contact_history_output() {
  return output<ContactHistory>({}, nullptr, true);
}

}  // namespace pounding
