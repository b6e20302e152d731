#include "motion/load_histories.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "common/error.h"
#include "common/series.h"
#include "motion/records/record_text.h"

namespace pounding {
namespace {

using Kind = LoadFunction::Kind;

double history_at(const LoadFunction& f, double t) {
  switch (f.kind) {
    case Kind::constant:
      return 1;
    case Kind::step:
      return t < f.start ? 0 : 1;
    case Kind::ramp:
      return std::clamp((t - f.start) / f.rise, 0.0, 1.0);
    case Kind::harmonic:
      return t < f.start ? 0
                         : std::sin(2 * std::numbers::pi * f.frequency * (t - f.start) + f.phase);
    case Kind::table:
      return interpolated(f.times, f.values, t);
  }
  return 0;
}

/// Time at which a table, on its way from value `i` to value `end`, is half of the way between
/// the two [s].
double half_way(const LoadFunction& f, std::size_t i, std::size_t end) {
  const double half = (f.values[i] + f.values[end]) / 2;
  const bool falls = f.values[end] < f.values[i];
  const std::size_t by = end > i ? 1 : static_cast<std::size_t>(-1);
  while ((f.values[i + by] > half) == falls) i += by;
  const double share = (half - f.values[i]) / (f.values[i + by] - f.values[i]);
  return f.times[i] + share * (f.times[i + by] - f.times[i]);
}

/// The narrowest peak of a table, either way, that begins before `end`: twice its width at half of
/// its height [s]. Turns by less than a hundredth of its range are noise. `sudden`: its first value
/// is a peak as well, as of a blast that is there at once.
double narrowest_peak(const LoadFunction& f, double end, bool sudden) {
  const auto [least, most] = std::ranges::minmax(f.values);
  std::vector<std::size_t> turns{0};
  std::size_t far = 0;  // the farthest value since the last turn
  double way = 0;
  for (std::size_t i = 1; i < f.values.size(); ++i) {
    const double on = f.values[i] - f.values[far];
    if (way == 0) way = on > 0 ? 1 : on < 0 ? -1 : 0;
    if (on * way > 0) {
      far = i;
    } else if (-on * way > (most - least) / 100) {
      turns.push_back(std::exchange(far, i));
      way = -way;
    }
  }
  if (far > 0) turns.push_back(far);
  double narrowest = std::numeric_limits<double>::infinity();
  sudden = sudden && turns.size() > 1 && std::abs(f.values[0]) > std::abs(f.values[turns[1]]);
  for (std::size_t k = sudden ? 0 : 1; k + 1 < turns.size(); ++k) {
    const double from = k > 0 ? half_way(f, turns[k], turns[k - 1]) : f.times[0];
    const double to = half_way(f, turns[k], turns[k + 1]);
    if (from < end && to > 0) narrowest = std::min(narrowest, 2 * (to - from));
  }
  return narrowest;
}

/// Two columns, time and value; lines before the first row of numbers are a header.
void read_table(const std::string& load, LoadFunction& function) {
  const auto refuse = [&](int line, const std::string& why) {
    throw UserError("option -" + load + "_table " + function.file + ", line " +
                    std::to_string(line) + ": " + why);
  };
  std::vector<TextLine> lines = read_text_lines(function.file);
  replace_decimal_commas(function.file, 1, lines);
  for (const TextLine& line : lines) {
    if (line.text.empty() || is_comment(line.text)) continue;
    const std::vector<std::string_view> words = split_words(line.text);
    std::vector<double> numbers;
    for (const std::string_view word : words) {
      if (const auto number = parse_number(word)) numbers.push_back(*number);
    }
    if (numbers.size() != words.size()) {
      if (function.times.empty() && numbers.empty()) continue;  // names of the columns
      refuse(line.number, "'" + line.text.substr(0, 40) + "' is no pair of time and value");
    }
    if (numbers.size() != 2) {
      refuse(line.number,
             std::to_string(numbers.size()) + " numbers where a time [s] and a value belong");
    }
    if (!function.times.empty() && !(numbers[0] > function.times.back())) {
      refuse(line.number, "the time does not increase");
    }
    function.times.push_back(numbers[0]);
    function.values.push_back(numbers[1]);
  }
  refuse_if(function.times.empty(),
            "option -" + load + "_table " + function.file + ": no pair of time and value");
}

}  // namespace

LoadHistories::LoadHistories(std::span<const Load> loads) {
  for (const Load& load : loads) {
    History& history = histories_.emplace_back(History{load.function, load.factor});
    if (!load.function.file.empty()) read_table(load.name, history.function);
  }
}

void LoadHistories::evaluate(double t, std::span<double> values) const noexcept {
  for (std::size_t l = 0; l < histories_.size(); ++l) {
    values[l] = histories_[l].factor * history_at(histories_[l].function, t);
  }
}

double LoadHistories::before_start(std::size_t load) const noexcept {
  const auto& [function, factor] = histories_[load];
  const bool acts = function.kind == Kind::constant || function.kind == Kind::table;
  return acts ? factor * history_at(function, 0) : 0;
}

double LoadHistories::peak(std::size_t load, double end) const {
  const auto& [function, factor] = histories_[load];
  double largest = std::max(std::abs(history_at(function, 0)), std::abs(history_at(function, end)));
  if (function.kind == Kind::harmonic && function.start <= end) largest = 1;
  for (std::size_t i = 0; i < function.times.size(); ++i) {
    const bool inside = function.times[i] >= 0 && function.times[i] <= end;
    if (inside) largest = std::max(largest, std::abs(function.values[i]));
  }
  return std::abs(factor) * largest;
}

double LoadHistories::fastest(std::size_t load, double end, bool sudden) const {
  const LoadFunction& f = histories_[load].function;
  if (f.kind == Kind::harmonic) return f.start < end ? f.frequency : 0;
  return f.kind == Kind::table ? 1 / narrowest_peak(f, end, sudden) : 0;
}

std::vector<std::string> LoadHistories::doubts(std::span<const Load> loads, double origin,
                                               double end) const {
  std::vector<std::string> found;
  for (std::size_t l = 0; l < loads.size(); ++l) {
    const LoadFunction& f = histories_[l].function;
    if (histories_[l].factor != 0 && peak(l, end) == 0) {
      found.push_back("load " + loads[l].name + ": it is 0 throughout the run, which ends at " +
                      text_of(end) + " s: " + describe(l));
    }
    if (std::abs(origin) > 0.01 * end && (f.kind == Kind::table || f.start > 0)) {
      found.push_back("load " + loads[l].name + ": its times count from the start of the run, " +
                      "which is at " + text_of(origin) +
                      " s in the times of the records: subtract that where it has their clock");
    }
  }
  return found;
}

std::string LoadHistories::describe(std::size_t load) const {
  const LoadFunction& f = histories_[load].function;
  switch (f.kind) {
    case Kind::constant:
      return "constant";
    case Kind::step:
      return "step at " + text_of(f.start) + " s";
    case Kind::ramp:
      return "ramp from " + text_of(f.start) + " s on, over " + text_of(f.rise) + " s";
    case Kind::harmonic:
      return "harmonic, " + text_of(f.frequency) + " Hz from " + text_of(f.start) + " s on";
    case Kind::table:
      return (f.file.empty() ? "table" : f.file) + ", " + std::to_string(f.times.size()) +
             " values from " + text_of(f.times.front()) + " s to " + text_of(f.times.back()) + " s";
  }
  return "";
}

}  // namespace pounding
