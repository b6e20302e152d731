#include "observers/impact_catalogue.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.h"
#include "common/matrix3.h"
#include "common/parallel.h"
#include "io/csv_file.h"
#include "motion/records/record_text.h"

namespace pounding {
namespace {

/// The numbers of an impact in a table.
constexpr auto impact_members = [](auto& i, const auto& take) {
  take(i.contact, i.start, i.end, i.impulse, i.peak_force, i.points, i.energy_lost,
       i.max_penetration, i.place[0], i.place[1], i.contact_time, i.low_share[0], i.low_share[1],
       i.tangential_impulse, i.slip, i.friction_loss, i.window_force);
};

/// Per constraint and axis: 1 below the middle of the face of its contact, 0.5 at it, 0 above.
std::vector<std::array<double, 2>> low_halves(std::size_t contacts,
                                              const std::vector<int>& contact_of_row,
                                              const std::vector<std::array<double, 2>>& places) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<std::array<double, 2>> low(places.size());
  for (std::size_t axis = 0; axis < 2; ++axis) {
    std::vector<double> smallest(contacts, infinity);
    std::vector<double> largest(contacts, -infinity);
    for (std::size_t row = 0; row < places.size(); ++row) {
      const std::size_t contact = contact_of_row[row];
      smallest[contact] = std::min(smallest[contact], places[row][axis]);
      largest[contact] = std::max(largest[contact], places[row][axis]);
    }
    for (std::size_t row = 0; row < places.size(); ++row) {
      const std::size_t contact = contact_of_row[row];
      const double middle = (smallest[contact] + largest[contact]) / 2;
      const double tolerance = 1e-9 * (largest[contact] - smallest[contact]);
      const double from_middle = places[row][axis] - middle;
      low[row][axis] = from_middle < -tolerance ? 1 : (from_middle > tolerance ? 0 : 0.5);
    }
  }
  return low;
}

}  // namespace

void ImpactTotals::add(const Impact& impact) {
  ++episodes;
  total_impulse += impact.impulse;
  largest_impulse = std::max(largest_impulse, impact.impulse);
  peak_force = std::max(peak_force, impact.peak_force);
  window_force = std::max(window_force, impact.window_force);
  max_penetration = std::max(max_penetration, impact.max_penetration);
  energy_lost += impact.energy_lost;
  friction_loss += impact.friction_loss;
}

ImpactCatalogue::ImpactCatalogue(int contacts, std::vector<int> contact_of_row,
                                 std::vector<std::array<double, 2>> places,
                                 const ImpactTimes& times)
    : merge_time_(times.merge),
      contact_of_row_(std::move(contact_of_row)),
      places_(std::move(places)),
      low_(low_halves(static_cast<std::size_t>(contacts), contact_of_row_, places_)),
      open_(static_cast<std::size_t>(contacts)),
      is_open_(static_cast<std::size_t>(contacts), 0),
      windows_(static_cast<std::size_t>(contacts),
               ForceWindow(times.force_window, times.time_step)),
      step_impulse_(static_cast<std::size_t>(contacts), 0.0),
      step_tangential_(static_cast<std::size_t>(contacts)),
      touched_(contact_of_row_.size(), 0),
      slipped_(contact_of_row_.size(), 0.0),
      row_impulses_(contact_of_row_.size(), 0.0) {
  impacts_.reserve(4096);
}

void ImpactCatalogue::add_friction(Impact& impact, std::size_t row, double duration,
                                   const ContactStep& step) {
  if (step.slip_rates.empty()) return;
  for (std::size_t d = 0; d < 3; ++d) {
    step_tangential_[contact_of_row_[row]][d] += step.tangential_impulses[row][d];
  }
  impact.friction_loss += step.friction_losses[row];
  slipped_[row] += duration * step.slip_rates[row];
  impact.slip = std::max(impact.slip, slipped_[row]);
}

void ImpactCatalogue::add_step(double time, double duration, const ContactStep& step) {
  const std::span<const double> impulses = step.impulses;
  std::fill(step_impulse_.begin(), step_impulse_.end(), 0.0);
  std::fill(step_tangential_.begin(), step_tangential_.end(), Vector3{});
  for (std::size_t row = 0; row < impulses.size(); ++row) {
    step_impulse_[contact_of_row_[row]] += impulses[row];
    row_impulses_[row] += impulses[row];
  }
  for (std::size_t c = 0; c < open_.size(); ++c) {
    if (!(step_impulse_[c] > 0)) continue;
    if (is_open_[c] != 0 && time - open_[c].end > merge_time_) close(c);
    if (is_open_[c] == 0) {
      is_open_[c] = 1;
      open_[c] = Impact{};
      open_[c].contact = static_cast<int>(c);
      windows_[c].reset();
      open_[c].start = time;
    }
    open_[c].end = time + duration;
    open_[c].contact_time += duration;
    open_[c].impulse += step_impulse_[c];
    open_[c].peak_force = std::max(open_[c].peak_force, step_impulse_[c] / duration);
    windows_[c].add(time, time + duration, step_impulse_[c]);
    open_[c].window_force = windows_[c].largest();
  }
  for (std::size_t row = 0; row < impulses.size(); ++row) {
    Impact& impact = open_[contact_of_row_[row]];
    if (!(impulses[row] > 0) && is_open_[contact_of_row_[row]] != 0) {
      impact.energy_lost -= step.works[row];  // of a spring that has just let go
    }
    if (impulses[row] > 0) {
      impact.points += touched_[row] != 0 ? 0 : 1;
      touched_[row] = 1;
      impact.energy_lost -= step.works[row];
      impact.max_penetration = std::max(impact.max_penetration, -step.gaps[row]);
      add_friction(impact, row, duration, step);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        impact.place[axis] += impulses[row] * places_[row][axis];
        impact.low_share[axis] += impulses[row] * low_[row][axis];
      }
    }
  }
  // Points that push against each other are no force of the contact: a block at rest has none.
  for (std::size_t c = 0; c < open_.size(); ++c) {
    if (step_impulse_[c] > 0) open_[c].tangential_impulse += norm(step_tangential_[c]);
  }
}

int ImpactCatalogue::open_count() const {
  return static_cast<int>(std::count(is_open_.begin(), is_open_.end(), 1));
}

void ImpactCatalogue::close(std::size_t contact) {
  Impact impact = open_[contact];
  for (std::size_t axis = 0; axis < 2; ++axis) {
    impact.place[axis] /= impact.impulse;
    impact.low_share[axis] /= impact.impulse;
  }
  impacts_.push_back(impact);
  is_open_[contact] = 0;
  for (std::size_t row = 0; row < touched_.size(); ++row) {
    if (contact_of_row_[row] != static_cast<int>(contact)) continue;
    touched_[row] = 0;
    slipped_[row] = 0;
  }
}

void ImpactCatalogue::finish(MPI_Comm comm, int root) {
  for (std::size_t c = 0; c < open_.size(); ++c) {
    if (is_open_[c] != 0) close(c);
  }
  broadcast_values(comm, root, impacts_, row_impulses_);
  std::stable_sort(impacts_.begin(), impacts_.end(),
                   [](const Impact& a, const Impact& b) { return a.start < b.start; });
}

void ImpactCatalogue::keep(const StateKeeper& state) {
  const auto flags = [&](const char* name, std::vector<char>& all) {
    std::vector<double> numbers(all.begin(), all.end());
    state.table(name, numbers);
    std::ranges::transform(numbers, all.begin(),
                           [](double value) { return static_cast<char>(value != 0); });
  };
  const auto unknown = [&](const Impact& impact) {
    return impact.contact < 0 || impact.contact >= static_cast<int>(open_.size());
  };
  state.list("impacts", impacts_, impact_members);
  state.rows("impacts_open", open_, impact_members);
  if (std::ranges::any_of(impacts_, unknown)) state.state().refuse_values("impacts");
  if (std::ranges::any_of(open_, unknown)) state.state().refuse_values("impacts_open");
  flags("impacts_is_open", is_open_);
  flags("impacts_touched_rows", touched_);
  state.table("impacts_slipped_rows", slipped_);
  state.table("impacts_impulse_rows", row_impulses_);
  for (std::size_t c = 0; c < windows_.size(); ++c) {
    windows_[c].keep("impacts_window_" + std::to_string(c), state);
  }
}

ImpactTotals ImpactCatalogue::totals(int contact) const {
  ImpactTotals totals;
  for (const Impact& impact : impacts_) {
    if (impact.contact == contact) totals.add(impact);
  }
  return totals;
}

ImpactTotals ImpactCatalogue::totals() const {
  ImpactTotals totals;
  for (const Impact& impact : impacts_) totals.add(impact);
  return totals;
}

void write_impacts(const std::string& path, const std::vector<std::string>& contacts,
                   std::span<const Impact> impacts, int digits) {
  CsvFile file(path, digits);
  file.header(impact_columns);
  for (const Impact& impact : impacts) {
    file.row(contacts[impact.contact],
             {impact.start, impact.end, impact.duration(), impact.impulse, impact.peak_force,
              static_cast<double>(impact.points), impact.energy_lost, impact.max_penetration,
              impact.place[0], impact.place[1], impact.contact_time, impact.low_share[0],
              impact.low_share[1], impact.tangential_impulse, impact.slip, impact.friction_loss,
              impact.window_force});
  }
  file.close();
}

std::vector<NamedWindow> read_impact_windows(const std::string& path) {
  std::vector<NamedWindow> windows;
  bool named = false;
  for (const TextLine& line : read_text_lines(path)) {
    if (line.text.empty() || is_comment(line.text)) continue;
    const auto words = split_words(line.text);
    if (!named) {
      named = true;
      refuse_if(
          words.size() < 3 || words[0] != "contact" || words[1] != "start" || words[2] != "end",
          at_line(path, line.number) +
              "the columns do not begin with contact,start,end: give the impacts.csv of "
              "a run");
      continue;
    }
    const auto start = words.size() < 3 ? std::nullopt : parse_number(words[1]);
    const auto end = words.size() < 3 ? std::nullopt : parse_number(words[2]);
    if (!start || !end || *end < *start) {
      throw UserError(at_line(path, line.number) +
                      "is no impact: a contact, its start and a later end are expected");
    }
    windows.push_back({std::string(words[0]), *start, *end});
  }
  return windows;
}

ForceWindow::ForceWindow(double length, double time_step) : length_(length) {
  constexpr double most = 1e6;  // more would only be allocated when they come
  steps_.reserve(2 * static_cast<std::size_t>(std::min(most, std::ceil(length / time_step) + 3)));
}

double ForceWindow::at(const Step& step, double time) {
  const double share = (time - step.start) / (step.end - step.start);
  return step.before + std::clamp(share, 0.0, 1.0) * (step.after - step.before);
}

void ForceWindow::add(double start, double end, double impulse) {
  const bool any = first_ < steps_.size();
  const double last = any ? steps_.back().end : start;
  const double before = any ? steps_.back().after : 0.0;
  const Step step{start, end, before, before + impulse};
  // The impulse over time is a polygon, so that the largest rise within a length begins or ends
  // where a step does. Times that begin with a step and end in this one, or since the last:
  double most = 0;
  for (std::size_t i = first_; i < steps_.size() && steps_[i].start + length_ <= end; ++i) {
    if (steps_[i].start + length_ <= last) continue;
    most = std::max(most, at(step, steps_[i].start + length_) - steps_[i].before);
  }
  while (first_ < steps_.size() && steps_[first_].end <= end - length_) ++first_;
  if (first_ == steps_.size() || steps_.size() == steps_.capacity()) {
    steps_.erase(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(first_));
    first_ = 0;
  }
  steps_.push_back(step);
  most = std::max(most, step.after - at(steps_[first_], end - length_));  // that end with it
  largest_ = std::max(largest_, most / length_);
}

void ForceWindow::reset() {
  steps_.clear();
  first_ = 0;
  largest_ = 0;
}

void ForceWindow::keep(const std::string& name, const StateKeeper& state) {
  std::vector<Step> rows{{largest_, 0, 0, 0}};
  rows.insert(rows.end(), steps_.begin() + static_cast<std::ptrdiff_t>(first_), steps_.end());
  state.list(name, rows, [](auto& step, const auto& take) {
    take(step.start, step.end, step.before, step.after);
  });
  if (rows.empty()) state.state().refuse_values(name);
  largest_ = rows[0].start;
  first_ = 0;
  steps_.assign(rows.begin() + 1, rows.end());
}

}  // namespace pounding
