#include "motion/record_table.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/error.h"

namespace pounding {

namespace {

constexpr long long few_values = 5;          // between an announced count and that of one layout
constexpr std::size_t columns_in_doubt = 4;  // fewer values in a row than records are written with

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
      std::abs(total - announced) < std::abs(lines - announced)) {
    return false;
  }
  const auto increases = [](const NumberRow& a, const NumberRow& b) {
    return b.values[0] > a.values[0];
  };
  const bool first_column_increases =
      rows.size() > 2 &&
      std::adjacent_find(rows.begin(), rows.end(), [&](const NumberRow& a, const NumberRow& b) {
        return !increases(a, b);
      }) == rows.end();
  return width == 2 || rows[0].delimited || first_column_increases;
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
double uniform_step(const std::string& file, const std::vector<NumberRow>& rows,
                    std::size_t column) {
  const auto time = [&](std::size_t i) { return rows[i].values[column]; };
  std::vector<double> steps;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    steps.push_back(time(i) - time(i - 1));
    if (!(steps.back() > 0)) {
      throw UserError(at_line(file, rows[i].line) + "time " + text_of(time(i)) +
                      " does not follow " + text_of(time(i - 1)) + "; times must increase");
    }
  }
  const double count = static_cast<double>(steps.size());
  const double mean = (time(rows.size() - 1) - time(0)) / count;
  auto sorted = steps;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (std::abs(steps[i - 1] - *middle) > 0.1 * *middle) {
      throw UserError(at_line(file, rows[i].line) + "time " + text_of(time(i)) + " after " +
                      text_of(time(i - 1)) + " breaks the uniform step " + text_of(*middle) +
                      " s; resample the record or restore the missing lines");
    }
  }
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (std::abs(time(i) - time(0) - static_cast<double>(i) * mean) > 0.1 * mean) {
      throw UserError(at_line(file, rows[i].line) + "time " + text_of(time(i)) +
                      " is not where a uniform step " + text_of(mean) +
                      " s puts it; resample the record");
    }
  }
  const double rounded = std::stod(text_of(std::round(mean * 1e7) / 1e7));
  return std::abs(rounded - mean) * count < 1e-6 * mean ? rounded : mean;
}

bool counts_rows(const std::vector<NumberRow>& rows) {
  const double first = rows[0].values[0];
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].values[0] != first + static_cast<double>(i)) return false;
  }
  return first == 0 || first == 1;
}

bool is_time(const std::string& name) {
  return name.find_first_of("tT") < 2;  // time, Time, "t
}

// The column of the times, from 1; 0: there is none.
int time_column(const RecordContent& content) {
  const std::size_t width = content.rows[0].values.size();
  for (std::size_t i = 0; i < content.names.size() && width > 1; ++i) {
    if (is_time(content.names[i])) return static_cast<int>(i) + 1;
  }
  if (width < 2 || !content.names.empty()) return 0;
  if (!counts_rows(content.rows)) return 1;
  return width > 2 ? 2 : 0;
}

std::string columns_text(const RecordContent& content, int time) {
  std::string text = std::to_string(content.rows[0].values.size()) + " columns";
  for (std::size_t i = 0; i < content.names.size(); ++i) {
    text += (i == 0 ? " (" : ", ") + content.names[i];
  }
  if (!content.names.empty()) text += ")";
  return text + (time > 0 ? ", time in column " + std::to_string(time) : ", none of them a time");
}

RecordValues read_table(const RecordedMotion& motion, const RecordContent& content) {
  const auto& rows = content.rows;
  require_equal_rows(motion.file, rows, false);
  const int width = static_cast<int>(rows[0].values.size());
  const int time = time_column(content);
  const std::string range = "give column: 1 to " + std::to_string(width);
  if (motion.column == 0 && width > 2) {
    throw UserError(at_line(motion.file, rows[0].line) + columns_text(content, time) +
                    "; which one holds the acceleration? " + range);
  }
  const int column = motion.column > 0 ? motion.column : width;
  if (column > width) {
    throw UserError(at_line(motion.file, rows[0].line) + "column " + std::to_string(column) +
                    " is asked but there are " + std::to_string(width) + "; " + range);
  }
  if (time == column) {
    throw UserError(motion.file + ": column " + std::to_string(column) +
                    " is the time; give column: the number of another one, up to " +
                    std::to_string(width));
  }
  const std::size_t index = column - 1;
  if (!content.names.empty()) {
    RecordHeader name(motion.file);
    name.read({rows[0].line - 1, content.names[index]});
    name.require_acceleration();
  }
  RecordValues result;
  for (const auto& row : rows) result.values.push_back(row.values[index]);
  if (time > 0 && rows.size() > 1) {
    result.time_step = uniform_step(motion.file, rows, static_cast<std::size_t>(time - 1));
  }
  result.layout = "column " + std::to_string(column) + " of " + std::to_string(width);
  if (!content.names.empty()) result.layout += " (" + content.names[index] + ")";
  if (time > 0) result.layout += ", time in column " + std::to_string(time);
  return result;
}

RecordValues read_running(const RecordedMotion& motion, const RecordContent& content) {
  const bool announced = content.header.number_of_values().has_value();
  if (!announced) require_equal_rows(motion.file, content.rows, true);
  RecordValues result;
  for (const auto& row : content.rows) {
    result.values.insert(result.values.end(), row.values.begin(), row.values.end());
  }
  const std::size_t width = content.rows[0].values.size();
  result.layout = width == 1
                      ? "one column"
                      : "rows of " + std::to_string(width) + " values that follow one another";
  if (!announced && width > 1 && width <= columns_in_doubt) {
    result.doubts.push_back(motion.file + ": " + result.layout +
                            ", or columns? If they are columns, give the number of one");
  }
  return result;
}

}  // namespace

RecordValues read_record_values(const RecordedMotion& motion, const RecordContent& content) {
  return is_table(content, motion.column) ? read_table(motion, content)
                                          : read_running(motion, content);
}

}  // namespace pounding
