#include "motion/accelerogram.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include <nlohmann/json.hpp>

#include "common/error.h"
#include "motion/record_content.h"

namespace pounding {

namespace {

constexpr long long few_values = 5;       // that a header may announce in excess: one line of AT2
constexpr double largest_peak_in_g = 20;  // beyond any record: the unit is wrong

std::string text_of(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.8g", value);
  return buffer;
}

bool first_column_increases(const std::vector<NumberRow>& rows) {
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (!(rows[i].values[0] > rows[i - 1].values[0])) return false;
  return rows.size() > 2;
}

// Columns of which one is asked, rather than values that run on from row to row.
bool is_table(const RecordContent& content, int column) {
  const auto& rows = content.rows;
  const std::size_t width = rows[0].values.size();
  if (column > 0) return true;
  if (width == 1) return false;
  long long total = 0;
  for (const auto& row : rows) total += static_cast<long long>(row.values.size());
  const long long announced = content.header.number_of_values().value_or(0);
  const long long lines = static_cast<long long>(rows.size());
  if (announced > 0 && std::abs(total - announced) <= few_values &&
      std::abs(total - announced) < std::abs(lines - announced))
    return false;
  return width == 2 || rows[0].delimited || first_column_increases(rows);
}

void require_equal_rows(const std::string& file, const std::vector<NumberRow>& rows,
                        bool last_may_be_short) {
  const std::size_t width = rows[0].values.size();
  for (const auto& row : rows) {
    const std::size_t size = row.values.size();
    if (size == width || (last_may_be_short && &row == &rows.back() && size < width)) continue;
    throw UserError(at_line(file, row.line) + std::to_string(size) +
                    " numbers where the lines before have " + std::to_string(width) +
                    "; complete or remove the line");
  }
}

// Time step of a uniform time column. Rounded times may be off by a tenth of a step.
double uniform_step(const std::string& file, const std::vector<NumberRow>& rows) {
  const auto time = [&](std::size_t i) { return rows[i].values[0]; };
  std::vector<double> steps;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    steps.push_back(time(i) - time(i - 1));
    if (!(steps.back() > 0))
      throw UserError(at_line(file, rows[i].line) + "time " + text_of(time(i)) +
                      " does not follow " + text_of(time(i - 1)) + "; times must increase");
  }
  const double count = static_cast<double>(steps.size());
  const double mean = (time(rows.size() - 1) - time(0)) / count;
  auto sorted = steps;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (std::abs(steps[i - 1] - *middle) > 0.1 * *middle)
      throw UserError(at_line(file, rows[i].line) + "time " + text_of(time(i)) + " after " +
                      text_of(time(i - 1)) + " breaks the uniform step " + text_of(*middle) +
                      " s; resample the record or restore the missing lines");
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (std::abs(time(i) - time(0) - static_cast<double>(i) * mean) > 0.1 * mean)
      throw UserError(at_line(file, rows[i].line) + "time " + text_of(time(i)) +
                      " is not where a uniform step " + text_of(mean) +
                      " s puts it; resample the record");
  const double rounded = std::stod(text_of(std::round(mean * 1e7) / 1e7));
  return std::abs(rounded - mean) * count < 1e-6 * mean ? rounded : mean;
}

struct Values {
  std::vector<double> values;
  double time_step = 0;  // of the time column; 0: none
};

Values read_table(const RecordedMotion& motion, const RecordContent& content) {
  const auto& rows = content.rows;
  require_equal_rows(motion.file, rows, false);
  const int width = static_cast<int>(rows[0].values.size());
  const int column = motion.column > 0 ? motion.column : width;
  if (column > width)
    throw UserError(at_line(motion.file, rows[0].line) + "column " + std::to_string(column) +
                    " is asked but there are " + std::to_string(width) + "; give column: 1 to " +
                    std::to_string(width));
  const auto index = static_cast<std::size_t>(column - 1);
  const bool named = !content.names.empty();
  const bool has_time =
      width > 1 && (!named || content.names[0].find_first_of("tT") < 2);  // time, Time, "t
  if (has_time && column == 1)
    throw UserError(motion.file + ": column 1 is the time; give column: 2 to " +
                    std::to_string(width));
  if (named) {
    RecordHeader name(motion.file);
    name.read({rows[0].line - 1, content.names[index]});
    name.require_acceleration();
  }
  Values result;
  for (const auto& row : rows) result.values.push_back(row.values[index]);
  if (has_time && rows.size() > 1) result.time_step = uniform_step(motion.file, rows);
  return result;
}

Values read_packed(const RecordedMotion& motion, const RecordContent& content) {
  if (!content.header.number_of_values()) require_equal_rows(motion.file, content.rows, true);
  Values result;
  for (const auto& row : content.rows)
    result.values.insert(result.values.end(), row.values.begin(), row.values.end());
  return result;
}

void check_count(const std::string& file, const RecordHeader& header, std::vector<double>& values) {
  if (values.size() < 2)
    throw UserError(file + ": holds " + std::to_string(values.size()) +
                    " value; an accelerogram needs at least 2");
  if (!header.number_of_values()) return;
  const long long announced = *header.number_of_values();
  const auto found = static_cast<long long>(values.size());
  const bool surplus_is_zero = std::all_of(values.begin() + std::min(announced, found),
                                           values.end(), [](double value) { return value == 0; });
  if (found < announced - few_values || !surplus_is_zero)
    throw UserError(file + ": the header announces " + std::to_string(announced) + " values but " +
                    std::to_string(found) +
                    " are found; the header or the file is not the right one");
  values.resize(static_cast<std::size_t>(std::min(announced, found)));
}

double choose_time_step(const RecordedMotion& motion, const RecordHeader& header, double column) {
  const double option = motion.time_step;
  if (!std::isfinite(option) || option < 0)
    throw UserError(motion.file + ": time_step " + text_of(option) + " must be positive [s]");
  const double stated = header.time_step().value_or(0);
  double chosen = 0;
  for (const double step : {stated, option, column}) {
    if (step == 0) continue;
    if (chosen > 0 && std::abs(step / chosen - 1) > 1e-3)
      throw UserError(
          motion.file + ": time step " + text_of(chosen) + " s and " + text_of(step) +
          " s contradict one another (header, option time_step, time column); correct one");
    if (chosen == 0) chosen = step;
  }
  if (chosen == 0)
    throw UserError(motion.file + ": the time step is not in the file; give time_step [s]");
  return chosen;
}

// {"numPoints": 3, "dT": 0.01, "accel_data": [0.1, 0.2, 0.1]}
Values read_json(const RecordedMotion& motion, const std::vector<TextLine>& lines,
                 RecordHeader& header) {
  std::string text;
  for (const auto& line : lines) text += line.text + "\n";
  const auto json = nlohmann::json::parse(text, nullptr, false);
  try {
    Values result{json.at("accel_data").get<std::vector<double>>(), 0};
    header.declare(json.value("numPoints", 0LL), json.value("dT", 0.0), 1);
    return result;
  } catch (const nlohmann::json::exception&) {
    throw UserError(motion.file +
                    ": is not JSON with dT and a list accel_data of numbers; give another layout");
  }
}

}  // namespace

double Accelerogram::peak() const {
  double peak = 0;
  for (const double a : acceleration) peak = std::max(peak, std::abs(a));
  return peak;
}

double Accelerogram::duration() const {
  return acceleration.empty() ? 0 : static_cast<double>(acceleration.size() - 1) * time_step;
}

Accelerogram read_accelerogram(const RecordedMotion& motion) {
  const auto lines = read_text_lines(motion.file);
  const auto filled = std::find_if(lines.begin(), lines.end(),
                                   [](const TextLine& line) { return !line.text.empty(); });
  RecordContent content{RecordHeader(motion.file), {}, {}};
  Values read;
  if (filled->text.starts_with('{')) {
    read = read_json(motion, lines, content.header);
  } else {
    content = read_record_content(motion.file, lines, motion.time_step);
    read = is_table(content, motion.column) ? read_table(motion, content)
                                            : read_packed(motion, content);
  }
  check_count(motion.file, content.header, read.values);
  Accelerogram result{std::move(read.values),
                      choose_time_step(motion, content.header, read.time_step)};
  const double factor = content.header.unit_factor(motion.unit);
  for (double& a : result.acceleration) a *= factor;
  if (factor == standard_gravity && result.peak() > largest_peak_in_g * standard_gravity)
    throw UserError(motion.file + ": in g the peak would be " +
                    text_of(result.peak() / standard_gravity) + " g; correct the unit");
  return result;
}

}  // namespace pounding
