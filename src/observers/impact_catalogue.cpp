#include "observers/impact_catalogue.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

#include "common/error.h"
#include "common/matrix3.h"
#include "common/parallel.h"
#include "interactions/interface_rows.h"
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

/// Numbers of an impact that add up over ranks, and numbers of which the largest counts.
constexpr auto impact_parts = [](auto& i, const auto& take) {
  take(i.points, i.energy_lost, i.place[0], i.place[1], i.low_share[0], i.low_share[1],
       i.friction_loss);
};
constexpr auto impact_extremes = [](auto& i, const auto& take) { take(i.max_penetration, i.slip); };

CountedRows all_rows(std::size_t rows) {
  CountedRows counted{MPI_COMM_SELF, std::vector<int>(rows), 1, true};
  std::iota(counted.rows.begin(), counted.rows.end(), 0);
  return counted;
}

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

void keep_contact_sums(const StateKeeper& state, MPI_Comm comm, int root, const std::string& name,
                       std::vector<double>& part) {
  if (part.empty()) return;
  state.sums(name, part);
  if (state.puts() || root == 0) return;
  std::vector<double> of_first = part;  // all, where the number of ranks is another; else zeros
  MPI_Bcast(of_first.data(), static_cast<int>(of_first.size()), MPI_DOUBLE, 0, comm);
  if (rank_of(comm) != root) return;
  std::ranges::transform(part, of_first, part.begin(), std::plus());
}

ImpactCatalogue::ImpactCatalogue(int contacts, std::vector<int> contact_of_row,
                                 std::vector<std::array<double, 2>> places,
                                 const ImpactTimes& times, std::optional<CountedRows> counted)
    : counted_(counted ? std::move(*counted) : all_rows(contact_of_row.size())),
      width_(counted_.friction ? width : tangential),
      values_(counted_.steps * counted_.rows.size() * width_),
      sums_(counted_.steps * static_cast<std::size_t>(contacts)),
      merge_time_(times.merge),
      contact_of_row_(std::move(contact_of_row)),
      places_(std::move(places)),
      low_(low_halves(static_cast<std::size_t>(contacts), contact_of_row_, places_)),
      open_(static_cast<std::size_t>(contacts)),
      is_open_(static_cast<std::size_t>(contacts), 0),
      windows_(static_cast<std::size_t>(contacts),
               ForceWindow(times.force_window, times.time_step)),
      touched_(contact_of_row_.size(), 0),
      slipped_(contact_of_row_.size(), 0.0),
      row_impulses_(contact_of_row_.size(), 0.0) {
  impacts_.reserve(4096);
  pending_.reserve(counted_.steps);
  for (std::size_t i = 0; i < counted_.rows.size(); ++i) {
    const std::size_t contact = contact_of_row_[counted_.rows[i]];
    if (stretches_.empty() || stretches_.back().contact != contact) {
      stretches_.push_back({contact, i, i});
    }
    stretches_.back().end = i + 1;
  }
}

void ImpactCatalogue::add_step(double time, double duration, const ContactStep& step) {
  const bool acts = !step.impulses.empty();
  double* next = values_.data() + pending_.size() * counted_.rows.size() * width_;
  pending_.push_back({time, duration, acts});
  for (std::size_t i = 0; acts && i < counted_.rows.size(); ++i, next += width_) {
    const int row = counted_.rows[i];
    next[gap] = step.gaps[row];
    next[impulse] = step.impulses[row];
    next[work] = step.works[row];
    if (width_ < width) continue;
    const bool slides = !step.slip_rates.empty();
    for (std::size_t d = 0; d < 3; ++d) {
      next[tangential + d] = slides ? step.tangential_impulses[row][d] : 0;
    }
    next[slip_rate] = slides ? step.slip_rates[row] : 0;
    next[friction_loss] = slides ? step.friction_losses[row] : 0;
  }
  if (pending_.size() == counted_.steps) flush();
}

void ImpactCatalogue::flush() {
  if (pending_.empty()) return;
  const std::size_t contacts = open_.size();
  std::ranges::fill(sums_, StepSum{});
  for (std::size_t k = 0; k < pending_.size(); ++k) {
    if (pending_[k].acts) add_up(k);
  }
  if (size_of(counted_.comm) > 1) {
    const std::size_t numbers = pending_.size() * contacts * std::tuple_size_v<StepSum>;
    reduce_over_ranks(counted_.comm, MPI_SUM, std::span(sums_.data()->data(), numbers));
  }
  for (std::size_t k = 0; k < pending_.size(); ++k) {
    open_episodes(pending_[k], std::span(sums_).subspan(k * contacts, contacts));
    if (pending_[k].acts) count(k);
  }
  pending_.clear();
}

void ImpactCatalogue::add_up(std::size_t step) {
  for (const auto& [contact, begin, end] : stretches_) {
    StepSum& of_contact = sums_[step * open_.size() + contact];
    StepSum sum = of_contact;
    for (std::size_t i = begin; i < end; ++i) {
      const double* const of_row = values(step, i);
      sum[0] += of_row[impulse];
      row_impulses_[counted_.rows[i]] += of_row[impulse];
      if (width_ < width || !(of_row[impulse] > 0)) continue;
      for (std::size_t d = 0; d < 3; ++d) sum[1 + d] += of_row[tangential + d];
    }
    of_contact = sum;
  }
}

void ImpactCatalogue::open_episodes(const Pending& step, std::span<const StepSum> sums) {
  const double end = step.time + step.duration;
  for (std::size_t c = 0; c < open_.size(); ++c) {
    const auto& [pressed, x, y, z] = sums[c];
    if (!(pressed > 0)) continue;
    if (is_open_[c] != 0 && step.time - open_[c].end > merge_time_) close(c);
    if (is_open_[c] == 0) {
      is_open_[c] = 1;
      open_[c] = Impact{};
      open_[c].contact = static_cast<int>(c);
      windows_[c].reset();
      open_[c].start = step.time;
    }
    open_[c].end = end;
    open_[c].contact_time += step.duration;
    open_[c].impulse += pressed;
    open_[c].peak_force = std::max(open_[c].peak_force, pressed / step.duration);
    windows_[c].add(step.time, end, pressed);
    open_[c].window_force = windows_[c].largest();
    // Points that push against each other are no force of the contact: a block at rest has none.
    open_[c].tangential_impulse += norm({x, y, z});
  }
}

void ImpactCatalogue::count(std::size_t step) {
  for (const auto& [contact, begin, end] : stretches_) {
    const bool is_open = is_open_[contact] != 0;
    Impact impact = open_[contact];  // a copy, whose sums stay in registers
    for (std::size_t i = begin; i < end; ++i) {
      const double* const of_row = values(step, i);
      if (!(of_row[impulse] > 0)) {
        if (is_open) impact.energy_lost -= of_row[work];  // of a spring that has just let go
        continue;
      }
      const int row = counted_.rows[i];
      impact.points += touched_[row] != 0 ? 0 : 1;
      touched_[row] = 1;
      impact.energy_lost -= of_row[work];
      impact.max_penetration = std::max(impact.max_penetration, -of_row[gap]);
      if (width_ == width) {
        impact.friction_loss += of_row[friction_loss];
        slipped_[row] += pending_[step].duration * of_row[slip_rate];
        impact.slip = std::max(impact.slip, slipped_[row]);
      }
      for (std::size_t axis = 0; axis < 2; ++axis) {
        impact.place[axis] += of_row[impulse] * places_[row][axis];
        impact.low_share[axis] += of_row[impulse] * low_[row][axis];
      }
    }
    open_[contact] = impact;
  }
}

void ImpactCatalogue::merge(std::vector<Impact>& impacts) const {
  if (counted_.comm == MPI_COMM_NULL || size_of(counted_.comm) == 1) return;
  std::vector<double> parts = to_rows(impacts, impact_parts);
  std::vector<double> extremes = to_rows(impacts, impact_extremes);
  reduce_over_ranks(counted_.comm, MPI_SUM, parts);
  reduce_over_ranks(counted_.comm, MPI_MAX, extremes);
  from_rows(parts, impacts, impact_parts);
  from_rows(extremes, impacts, impact_extremes);
}

int ImpactCatalogue::open_count() const {
  return static_cast<int>(std::count(is_open_.begin(), is_open_.end(), 1));
}

void ImpactCatalogue::close(std::size_t contact) {
  std::vector<Impact> closed{open_[contact]};
  merge(closed);
  Impact& impact = closed.front();
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
  flush();
  for (std::size_t c = 0; c < open_.size(); ++c) {
    if (is_open_[c] != 0) close(c);
  }
  interactions::share_rows(counted_.comm, counted_.rows, 1, row_impulses_);
  broadcast_values(comm, root, impacts_, row_impulses_);
  std::stable_sort(impacts_.begin(), impacts_.end(),
                   [](const Impact& a, const Impact& b) { return a.start < b.start; });
}

void ImpactCatalogue::keep(const StateKeeper& state, MPI_Comm comm, int root) {
  if (state.puts()) flush();
  std::vector<Impact> open = open_;
  std::vector<double> touched(touched_.begin(), touched_.end());
  if (state.puts()) {
    merge(open);
    for (std::vector<double>* const rows : {&touched, &slipped_, &row_impulses_}) {
      interactions::share_rows(counted_.comm, counted_.rows, 1, *rows);
    }
  }
  const auto unknown = [&](const Impact& impact) {
    return impact.contact < 0 || impact.contact >= static_cast<int>(open_.size());
  };
  state.list("impacts", impacts_, impact_members);
  state.rows("impacts_open", open, impact_members);
  if (std::ranges::any_of(impacts_, unknown)) state.state().refuse_values("impacts");
  if (std::ranges::any_of(open, unknown)) state.state().refuse_values("impacts_open");
  if (!state.puts()) open_ = std::move(open);
  std::vector<double> parts = to_rows(open_, impact_parts);
  keep_contact_sums(state, comm, root, "impacts_open_parts", parts);
  from_rows(parts, open_, impact_parts);
  const auto flags = [&](const char* name, std::vector<double> numbers, std::vector<char>& all) {
    state.table(name, numbers);
    std::ranges::transform(numbers, all.begin(),
                           [](double value) { return static_cast<char>(value != 0); });
  };
  flags("impacts_is_open", {is_open_.begin(), is_open_.end()}, is_open_);
  flags("impacts_touched_rows", std::move(touched), touched_);
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
              "the columns do not begin with contact,start,end: give the impacts.csv of a run");
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

}  // namespace pounding
