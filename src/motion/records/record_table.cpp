#include "motion/records/record_table.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "common/error.h"
#include "motion/records/record_sampling.h"

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
  const bool equal = std::ranges::all_of(
      rows, [width](const NumberRow& row) { return row.values.size() == width; });
  if (width <= columns_in_doubt && equal && !content.names.empty()) return true;
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

void refuse_row(const std::string& file, const NumberRow& row, std::size_t width) {
  throw UserError(at_line(file, row.line) + std::to_string(row.values.size()) +
                  " numbers where the lines before have " + std::to_string(width) +
                  "; complete or remove the line, or remove text that is not the record's");
}

void require_equal_rows(const std::string& file, const std::vector<NumberRow>& rows) {
  const std::size_t width = rows[0].values.size();
  for (const auto& row : rows) {
    if (row.values.size() != width) refuse_row(file, row, width);
  }
}

/// Rows that run on have one length, but for the last with a value; zeros may follow it.
void require_running_rows(const std::string& file, const std::vector<NumberRow>& rows,
                          long long announced) {
  const std::size_t width = rows[0].values.size();
  long long count = 0;
  for (const auto& row : rows) {
    const std::size_t size = row.values.size();
    count += static_cast<long long>(size);
    const bool last =
        (announced > 0 && count >= announced) || (&row == &rows.back() && size < width);
    if (size != width && !last) refuse_row(file, row, width);
  }
}

void take_times(const std::string& file, const std::vector<NumberRow>& rows, std::size_t column,
                RecordValues& result) {
  std::vector<TimeOfLine> times;
  for (const auto& row : rows) times.push_back({row.values[column], row.line});
  result.time_step = uniform_step(file, times);
  result.start = times[0].time;
}

/// Rows of time, value, time, value, ... that run on: times that increase through all of them.
bool is_pairs(const std::vector<NumberRow>& rows) {
  const std::size_t width = rows[0].values.size();
  if (width < 4 || width % 2 != 0 || rows.size() < 2) return false;
  double before = -std::numeric_limits<double>::infinity();
  for (const auto& row : rows) {
    if (row.values.size() % 2 != 0) return false;
    for (std::size_t i = 0; i < row.values.size(); i += 2) {
      if (!(row.values[i] > before)) return false;
      before = row.values[i];
    }
  }
  return true;
}

RecordValues read_pairs(const RecordedMotion& motion, const RecordContent& content) {
  RecordValues result;
  std::vector<TimeOfLine> times;
  for (const auto& row : content.rows) {
    for (std::size_t i = 0; i < row.values.size(); i += 2) {
      times.push_back({row.values[i], row.line});
      result.values.push_back(row.values[i + 1]);
    }
  }
  result.time_step = uniform_step(motion.file, times);
  result.start = times[0].time;
  result.layout =
      "rows of " + std::to_string(content.rows[0].values.size() / 2) + " pairs of time and value";
  return result;
}

bool counts_rows(const std::vector<NumberRow>& rows) {
  const double first = rows[0].values[0];
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].values[0] != first + static_cast<double>(i)) return false;
  }
  return first == 0 || first == 1;
}

/// Whether a column may be that of the times: it grows, but for a few lines gone wrong.
bool grows(const std::vector<NumberRow>& rows, std::size_t column) {
  std::size_t falls = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    falls += rows[i].values[column] > rows[i - 1].values[column] ? 0 : 1;
  }
  return falls <= std::max<std::size_t>(1, rows.size() / 5) &&
         rows.back().values[column] > rows[0].values[column];
}

bool grows_evenly(const std::vector<NumberRow>& rows) {
  const double whole = rows.back().values[0] - rows[0].values[0];
  const double step = whole / static_cast<double>(rows.size() - 1);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double here = rows[i].values[0] - rows[i - 1].values[0];
    if (!(here > step / 2 && here < 2 * step)) return false;
  }
  return rows.size() > 2;
}

// The column of the times, from 1; 0: there is none.
int time_column(const RecordContent& content) {
  const std::size_t width = content.rows[0].values.size();
  for (std::size_t i = 0; i < content.names.size() && width > 1; ++i) {
    const bool named = content.names[i].find_first_of("tT") < 2;  // time, Time, "t
    if (named && grows(content.rows, i)) return static_cast<int>(i) + 1;
  }
  if (width < 2) return 0;
  const bool counted = counts_rows(content.rows);
  if (!content.names.empty()) return !counted && grows_evenly(content.rows) ? 1 : 0;
  if (counted) return width > 2 && grows(content.rows, 1) ? 2 : 0;
  return grows(content.rows, 0) ? 1 : 0;
}

/// "1, 2 or 4": the columns that are not the time.
std::string columns_to_give(int width, int time) {
  std::string text;
  for (int column = 1; column <= width; ++column) {
    if (column == time) continue;
    const bool last = column == width || (column + 1 == width && time == width);
    text += (text.empty() ? "" : last ? " or " : ", ") + std::to_string(column);
  }
  return text;
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
  require_equal_rows(motion.file, rows);
  const int width = static_cast<int>(rows[0].values.size());
  const int time = time_column(content);
  const std::string range = "give column: " + columns_to_give(width, time);
  if (motion.column == 0 && (width > 2 || (time == 0 && !counts_rows(rows)))) {
    throw UserError(at_line(motion.file, rows[0].line) + columns_text(content, time) +
                    "; which one holds the acceleration? " + range);
  }
  const int column = motion.column > 0 ? motion.column : width;
  refuse_if(column > width, at_line(motion.file, rows[0].line) + "column " +
                                std::to_string(column) + " is asked but there are " +
                                std::to_string(width) + "; " + range);
  refuse_if(time == column, motion.file + ": column " + std::to_string(column) +
                                " is the time; give column: the number of another one, up to " +
                                std::to_string(width));
  const std::size_t index = column - 1;
  if (!content.names.empty()) {
    RecordHeader name(motion.file);
    name.read({rows[0].line - 1, content.names[index]});
    name.require_acceleration(motion.is_of_displacement());
  }
  RecordValues result;
  for (const auto& row : rows) result.values.push_back(row.values[index]);
  if (time > 0 && rows.size() > 1) {
    take_times(motion.file, rows, static_cast<std::size_t>(time - 1), result);
  }
  result.layout = "column " + std::to_string(column) + " of " + std::to_string(width);
  if (!content.names.empty()) {
    if (width > 2) result.component = content.names[index];
    result.layout += " (" + content.names[index] + ")";
  }
  if (time > 0) result.layout += ", time in column " + std::to_string(time);
  return result;
}

RecordValues read_running(const RecordedMotion& motion, const RecordContent& content) {
  const bool announced = content.header.number_of_values().has_value();
  require_running_rows(motion.file, content.rows, content.header.number_of_values().value_or(0));
  if (!announced) refuse_numbers_of_header(motion.file, content.rows);
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

constexpr std::size_t narrow = 4;             // rows with fewer values are no rows of a header
constexpr double head = 0.2, long_head = 12;  // rows of a header: part of all, or so many
constexpr std::size_t few = 100;              // values; a shorter record may be a test's
constexpr int mixed = -1;                     // decimals that differ within a row
constexpr int zeros = -2;                     // a row of zeros

/// Decimals of all values of a row, `mixed` or `zeros`.
int decimals_of(const NumberRow& row) {
  if (std::all_of(row.values.begin(), row.values.end(), [](double v) { return v == 0; })) {
    return zeros;
  }
  return row.decimals;
}

}  // namespace

RecordValues read_record_values(const RecordedMotion& motion, const RecordContent& content) {
  if (motion.column == 0 && is_pairs(content.rows)) return read_pairs(motion, content);
  return is_table(content, motion.column) ? read_table(motion, content)
                                          : read_running(motion, content);
}

void refuse_numbers_of_header(const std::string& file, const std::vector<NumberRow>& rows) {
  if (rows.size() < 4 || rows[0].values.size() < narrow) return;
  const int usual = decimals_of(rows[rows.size() - 2]);
  if (usual < 0) return;
  std::size_t last = rows.size(), alike_above = 0, alike = 0;  // last row that is written otherwise
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int decimals = decimals_of(rows[i]);
    if (decimals == usual) {
      ++alike;
    } else if (decimals != zeros) {
      last = i;
      alike_above = alike;
    }
  }
  const double others = static_cast<double>(last + 1);
  const bool at_head = others <= std::max(head * static_cast<double>(rows.size()), long_head);
  if (last == rows.size() || alike_above > 0 || alike < narrow || !at_head) return;
  throw UserError(
      at_line(file, rows[0].line) + "the numbers down to line " + std::to_string(rows[last].line) +
      " are written with other decimals than those below: they seem to be of a header, "
      "not the record's; give the values alone, or a format that docs/reference/records.md lists");
}

void refuse_offset(const std::string& file, const std::vector<double>& values) {
  if (values.size() < few) return;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*low == *high || *low * *high <= 0) return;
  const double count = static_cast<double>(values.size());
  double mean = 0, square = 0;
  for (const double value : values) mean += value / count;
  for (const double value : values) square += (value - mean) * (value - mean) / count;
  const double swing = std::sqrt(square), half = std::abs(mean) / 2;
  if (std::abs(mean) < swing || std::abs(values.front()) < half || std::abs(values.back()) < half) {
    return;
  }
  throw UserError(file + ": all values lie about " + text_of(mean) + ", from " + text_of(*low) +
                  " to " + text_of(*high) +
                  ", and none is near zero: an offset, counts of a recorder or another quantity? "
                  "Give accelerations about zero");
}

}  // namespace pounding
