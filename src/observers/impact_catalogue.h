#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <mpi.h>

#include "common/saved_state.h"
#include "common/types.h"
#include "observers/force_window.h"

namespace pounding {

/// One contact episode: from its first to its last impulse, pauses shorter than the merge time
/// included.
struct Impact {
  int contact = 0;
  double start = 0;               ///< [s]
  double end = 0;                 ///< end of the last step with an impulse [s]
  double impulse = 0;             ///< [N s]
  double peak_force = 0;          ///< largest impulse of a step over the step [N]
  int points = 0;                 ///< constraints that carried an impulse
  double energy_lost = 0;         ///< minus the contact work [J]
  double max_penetration = 0;     ///< largest -gap met [m]
  std::array<double, 2> place{};  ///< mean of the points, weighted with their impulses [m]
  double contact_time = 0;        ///< sum of the steps with an impulse [s]
  /// Share of the impulse at points below the middle of the face along each tangent axis; one at
  /// the middle counts half: 0 is one end of the face, 1 the other, 0.5 a centred impact.
  std::array<double, 2> low_share{};
  double tangential_impulse = 0;  ///< of friction: magnitudes of the sum of all points in a
                                  ///< step, summed over the steps [N s]
  double slip = 0;                ///< path of the point that slid farthest while it touched [m]
  double friction_loss = 0;       ///< [J]
  double window_force = 0;        ///< largest force over a stated time, see ForceWindow [N]
  double duration() const { return end - start; }
};

/// Contact of one step, per row; the last three are empty without friction.
struct ContactStep {
  std::span<const double> gaps;      ///< [m]
  std::span<const double> impulses;  ///< [N s]
  std::span<const double> works;     ///< contact work [J], of springs in the step before
  std::span<const Vector3> tangential_impulses;  ///< [N s]
  std::span<const double> slip_rates;            ///< [m/s]
  std::span<const double> friction_losses;       ///< [J]
};

/// Times that the catalogue goes by [s].
struct ImpactTimes {
  double merge = 0;         ///< pauses that are shorter are part of an episode
  double force_window = 0;  ///< over which `window_force` is taken
  double time_step = 0;     ///< longest
};

/// Totals of a contact, or of all.
struct ImpactTotals {
  int episodes = 0;
  double total_impulse = 0;    ///< [N s]
  double largest_impulse = 0;  ///< of an episode [N s]
  double peak_force = 0;       ///< largest of an episode [N]
  double window_force = 0;     ///< largest of an episode [N]
  double max_penetration = 0;  ///< [m]
  double energy_lost = 0;      ///< [J]
  double friction_loss = 0;    ///< [J]
  void add(const Impact& impact);
};

/// Rows that a rank counts in a catalogue, and the ranks that count together.
struct CountedRows {
  MPI_Comm comm = MPI_COMM_SELF;  ///< null: this rank counts none
  std::vector<int> rows;
  std::size_t steps = 1;  ///< that they count at a time
  bool friction = false;
};

/// Sums of a saved state to which the ranks of the contacts have parts. Of a run on another number
/// of ranks `root`, the lowest of them, gets all. Collective over `comm`, that of the run, where it
/// brings them back.
void keep_contact_sums(const StateKeeper& state, MPI_Comm comm, int root, const std::string& name,
                       std::vector<double>& part);

/// Collects the impacts, on every rank the part of the rows that it counts. Ranks add up the
/// impulses of the contacts in each step, some steps at a time.
class ImpactCatalogue {
 public:
  /// `contact_of_row`, `places`: contact and tangential position of each constraint. Without
  /// `counted` this rank counts all rows alone.
  ImpactCatalogue(int contacts, std::vector<int> contact_of_row,
                  std::vector<std::array<double, 2>> places, const ImpactTimes& times,
                  std::optional<CountedRows> counted = {});

  /// One step of length `duration` at `time` [s]; empty arrays if no row acts here. Collective over
  /// the ranks that count.
  void add_step(double time, double duration, const ContactStep& step);
  /// Closes open episodes, and brings the list from rank `root`, which counts, to all ranks, sorted
  /// by start. Collective.
  void finish(MPI_Comm comm, int root);

  /// Closed and open episodes; `state`: known to the first of the ranks that count, `root`, among
  /// those of the run. Collective over all of these.
  void keep(const StateKeeper& state, MPI_Comm comm, int root);

  const std::vector<Impact>& impacts() const { return impacts_; }
  /// Impulse of each constraint in the run [N s]; after `finish` on every rank.
  std::span<const double> row_impulses() const { return row_impulses_; }
  int episodes() const { return static_cast<int>(impacts_.size()) + open_count(); }
  ImpactTotals totals(int contact) const;
  ImpactTotals totals() const;

 private:
  /// A step that is not counted yet.
  struct Pending {
    double time = 0;
    double duration = 0;
    bool acts = false;  ///< some row here
  };
  /// Counted rows of one contact that follow each other.
  struct Stretch {
    std::size_t contact = 0;
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  /// Values of a row in a pending step, with friction all of them.
  enum Value { gap, impulse, work, tangential, slip_rate = tangential + 3, friction_loss, width };
  /// Sums over the rows of a contact in a pending step: the impulse and that of friction.
  using StepSum = std::array<double, 4>;

  int open_count() const;
  void close(std::size_t contact);
  const double* values(std::size_t step, std::size_t row) const {
    return &values_[width_ * (step * counted_.rows.size() + row)];
  }
  /// Counts the pending steps.
  void flush();
  void add_up(std::size_t step);
  void open_episodes(const Pending& step, std::span<const StepSum> sums);
  void count(std::size_t step);
  /// Makes those of this rank whole.
  void merge(std::vector<Impact>& impacts) const;
  CountedRows counted_;
  std::vector<Stretch> stretches_;
  std::size_t width_;
  std::vector<Pending> pending_;
  std::vector<double> values_;  ///< shape (steps, counted rows, width)
  std::vector<StepSum> sums_;   ///< shape (steps, contacts)
  double merge_time_;
  std::vector<int> contact_of_row_;
  std::vector<std::array<double, 2>> places_;
  std::vector<std::array<double, 2>> low_;  ///< per row: 1 below the middle, 0.5 at it, 0 above
  std::vector<Impact> open_;                ///< per contact
  std::vector<char> is_open_;               ///< per contact
  std::vector<ForceWindow> windows_;        ///< per contact
  std::vector<char> touched_;               ///< per row, in the open episode
  std::vector<double> slipped_;             ///< per row, path in the open episode [m]
  std::vector<double> row_impulses_;        ///< per row, of the whole run [N s]
  std::vector<Impact> impacts_;
};

/// Columns of `impacts.csv`, see docs/manual/results.md.
inline constexpr const char* impact_columns =
    "contact,start,end,duration,impulse,peak_force,points,energy_lost,max_penetration,lateral,"
    "vertical,contact_time,left,bottom,tangential_impulse,slip,friction_loss,window_force";

/// `impacts.csv`: one line per episode, its columns as in docs/manual/results.md; `digits`:
/// significant ones. Throws UserError if the file cannot be written.
void write_impacts(const std::string& path, const std::vector<std::string>& contacts,
                   std::span<const Impact> impacts, int digits);

/// An impact as in `impacts.csv`, with the name of its contact.
struct NamedWindow {
  std::string contact;
  double start = 0;  ///< [s]
  double end = 0;    ///< [s]
};

/// Reads name, start and end of the impacts of an `impacts.csv`. Throws UserError (file, line, what
/// is wrong).
std::vector<NamedWindow> read_impact_windows(const std::string& path);

}  // namespace pounding
