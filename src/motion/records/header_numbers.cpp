#include "motion/records/header_numbers.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace pounding {

namespace {

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
      "not the record's; give the values alone, or a format that docs/records.md lists");
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
