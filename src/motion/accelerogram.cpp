#include "motion/accelerogram.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "common/array_reductions.h"
#include "common/error.h"
#include "motion/records/record_format.h"
#include "motion/records/record_header.h"
#include "motion/records/record_table.h"
#include "motion/records/record_text.h"

namespace pounding {

namespace {

constexpr double longest_step = 0.1;  // s: beyond any accelerogram, unless the option says so

void check_count(const std::string& file, const RecordHeader& header, std::vector<double>& values) {
  refuse_if(values.size() < 2, file + ": holds " + std::to_string(values.size()) +
                                   " value; an accelerogram needs at least 2");
  if (!header.number_of_values()) return;
  const long long announced = *header.number_of_values();
  const auto found = static_cast<long long>(values.size());
  const bool surplus_is_zero = std::all_of(values.begin() + std::min(announced, found),
                                           values.end(), [](double value) { return value == 0; });
  refuse_if(found < announced || !surplus_is_zero,
            file + ": the header announces " + std::to_string(announced) + " values but " +
                std::to_string(found) + " are found; the header or the file is not the right one");
  values.resize(std::min(announced, found));
}

double choose_time_step(const RecordedMotion& motion, const RecordHeader& header, double column) {
  const double option = motion.time_step;
  refuse_if(!std::isfinite(option) || option < 0,
            motion.file + ": time_step " + text_of(option) + " must be positive [s]");
  const double stated = header.time_step().value_or(0);
  double chosen = 0;
  for (const double step : {stated, option, column}) {
    if (step == 0) continue;
    refuse_if(chosen > 0 && std::abs(step / chosen - 1) > 1e-3,
              motion.file + ": time step " + text_of(chosen) + " s and " + text_of(step) +
                  " s contradict one another (header, option time_step, time column); correct one");
    if (chosen == 0) chosen = step;
  }
  refuse_if(chosen == 0, motion.file + ": the time step is not in the file; give time_step [s]");
  refuse_if(chosen > longest_step && option == 0,
            motion.file + ": a time step of " + text_of(chosen) + " s (from the " +
                (stated > 0 ? "header" : "time column") + ") is above " + text_of(longest_step) +
                " s: are the times not seconds, or is that column no time? Correct the file, "
                "or give time_step: " +
                text_of(chosen) + " if it is meant");
  return chosen;
}

// {"numPoints": 3, "dT": 0.01, "accel_data": [0.1, 0.2, 0.1]}
RecordValues read_json(const RecordedMotion& motion, const std::vector<TextLine>& lines,
                       RecordHeader& header) {
  std::string text;
  for (const auto& line : lines) text += line.text + "\n";
  const auto json = nlohmann::json::parse(text, nullptr, false);
  try {
    RecordValues result{json.at("accel_data").get<std::vector<double>>(), 0, {}, {}, "JSON"};
    if (json.contains("numPoints")) header.declare_count(json["numPoints"].get<double>(), 1);
    if (json.contains("dT")) header.declare_time_step(json["dT"].get<double>(), 1);
    return result;
  } catch (const nlohmann::json::exception&) {
    throw UserError(motion.file +
                    ": is not JSON with dT and a list accel_data of numbers; give another layout");
  }
}

/// Takes unit and doubts into a record whose values are in the file's unit.
void take_unit(const RecordedMotion& motion, const RecordUnit& unit, const std::string& stated,
               Accelerogram& record) {
  record.unit = unit_text(unit, motion.unit);
  for (double& a : record.acceleration) a *= unit.factor;
  if (stated == "mm/s2" && motion.unit == "m/s2") {
    record.doubts.push_back(motion.file +
                            ": the header says mm/s2 but m/s2 is asked and taken; leave unit out, "
                            "and a scale of 0.001 as well");
  }
  refuse_if((unit.name == "g" || unit.name == "g/10") && record.peak() > largest_peak,
            motion.file + ": in " + unit.name + " the peak would be " +
                text_of(record.peak() / standard_gravity) + " g; correct the unit");
}

Accelerogram read_format(const RecordedMotion& motion, const RecordFormat& format,
                         const std::vector<TextLine>& lines) {
  FormatRecord read = format.read(motion, lines);
  Accelerogram result{std::move(read.values), read.time_step,           std::move(read.layout), "",
                      std::move(read.doubts), std::move(read.component)};
  take_unit(motion, agreed_unit(motion.file, motion.unit, read.unit), read.unit, result);
  return result;
}

Accelerogram read_free(const RecordedMotion& motion, std::vector<TextLine>& lines) {
  const auto filled = std::find_if(lines.begin(), lines.end(),
                                   [](const TextLine& line) { return !line.text.empty(); });
  RecordContent content{RecordHeader(motion.file), {}, {}};
  RecordValues read;
  if (filled->text.starts_with('{')) {
    read = read_json(motion, lines, content.header);
  } else {
    const bool commas = replace_decimal_commas(motion.file, motion.column, lines);
    content =
        read_record_content(motion.file, lines, motion.time_step, motion.is_of_displacement());
    read = read_record_values(motion, content);
    if (commas) read.layout += ", decimal commas";
  }
  check_count(motion.file, content.header, read.values);
  const double time_step = choose_time_step(motion, content.header, read.time_step);
  const bool of_column = !read.component.empty();
  Accelerogram result{
      std::move(read.values), time_step,
      std::move(read.layout), "",
      std::move(read.doubts), of_column ? read.component : content.header.component(),
      read.start.value_or(0), read.start.has_value()};
  if (!motion.is_of_displacement()) refuse_offset(motion.file, result.acceleration);
  const auto& stated = content.header.stated_units();
  take_unit(motion, content.header.unit(motion.unit),
            stated.size() == 1 ? *stated.begin() : std::string(), result);
  return result;
}

/// Values of a displacement become the acceleration that goes through them, from rest and to rest:
/// the second derivatives of their cubic spline, whose straight lines between samples have the
/// displacement as their exact second integral. The last value is held until nothing is left.
void differentiate_twice(Accelerogram& record) {
  constexpr std::size_t held = 30;  // samples, each of which leaves 0.27 of the one before
  std::vector<double>& values = record.acceleration;
  const double last = values.back();
  values.insert(values.end(), held, last);
  const std::size_t end = values.size() - 1;
  std::vector<double> diagonal(values.size());
  std::vector<double> right(values.size());
  for (std::size_t i = 0; i <= end; ++i) {
    const double before = i > 0 ? values[i] - values[i - 1] : 0;
    const double after = i < end ? values[i + 1] - values[i] : 0;
    diagonal[i] = i == 0 || i == end ? 2 : 4;
    right[i] = 6 * (after - before) / (record.time_step * record.time_step);
    if (i == 0) continue;
    right[i] -= right[i - 1] / diagonal[i - 1];
    diagonal[i] -= 1 / diagonal[i - 1];
  }
  for (std::size_t i = end + 1; i-- > 0;) {
    values[i] = (right[i] - (i < end ? values[i + 1] : 0)) / diagonal[i];
  }
  record.layout += ", of displacement, accelerations by its cubic spline";
}

}  // namespace

double Accelerogram::peak() const {
  return largest_magnitude(acceleration);
}

double Accelerogram::duration() const {
  return acceleration.empty() ? 0 : static_cast<double>(acceleration.size() - 1) * time_step;
}

double Accelerogram::at(double t) const noexcept {
  const double x = (t - start) / time_step;
  const std::size_t size = acceleration.size();
  if (!(x >= 0) || size == 0 || x > static_cast<double>(size - 1)) return 0;
  const auto i = static_cast<std::size_t>(x);
  const double a = acceleration[i];
  if (i + 1 == size) return a;
  return a + (x - static_cast<double>(i)) * (acceleration[i + 1] - a);
}

Accelerogram read_accelerogram(const RecordedMotion& motion) {
  auto lines = read_text_lines(motion.file);
  const RecordFormat* format = format_of(lines);
  Accelerogram result =
      format != nullptr ? read_format(motion, *format, lines) : read_free(motion, lines);
  if (result.peak() == 0) {
    result.doubts.push_back(motion.file + ": all values are zero; a dead channel?");
  }
  if (motion.is_of_displacement()) differentiate_twice(result);
  return result;
}

}  // namespace pounding
