#include "output/energy_ledger.h"

#include <array>
#include <span>

#include "io/csv_file.h"

namespace pounding {
namespace {

/// Lines that are kept at most.
constexpr std::int64_t capacity = 5000;

/// A line as numbers, in the order of its members.
constexpr std::size_t ledger_columns = 10;

void append_numbers(const EnergyLine& line, std::vector<double>& numbers) {
  numbers.insert(numbers.end(), {line.time, line.kinetic, line.strain, line.damping_loss,
                                 line.contact_work, line.input_work, line.device_work,
                                 line.residual, line.gravity_work, line.friction_loss});
}

EnergyLine line_of_numbers(std::span<const double> v) {
  EnergyLine line{v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]};
  line.gravity_work = v[8];
  line.friction_loss = v[9];
  return line;
}

}  // namespace

EnergyLedger::EnergyLedger(std::int64_t expected_lines)
    : stride_((expected_lines + capacity - 1) / capacity) {
  lines_.reserve(expected_lines / stride_ + 2);
}

void EnergyLedger::add(const EnergyLine& line) {
  last_ = line;
  if (added_ % stride_ == 0) lines_.push_back(line);
  ++added_;
}

void EnergyLedger::save(SavedState& saved) const {
  std::vector<double> numbers;
  for (const EnergyLine& line : lines_) append_numbers(line, numbers);
  saved.put("ledger", numbers, ledger_columns);
  numbers.clear();
  append_numbers(last_, numbers);
  saved.put("ledger_last", numbers);
  saved.put("ledger_added", {static_cast<double>(added_)});
}

void EnergyLedger::load(const SavedState& saved) {
  const std::vector<double>& numbers = saved.table("ledger", ledger_columns);
  lines_.clear();
  for (std::size_t i = 0; i < numbers.size(); i += ledger_columns) {
    lines_.push_back(line_of_numbers({&numbers[i], ledger_columns}));
  }
  std::array<double, ledger_columns> last{};
  saved.get("ledger_last", last);
  last_ = line_of_numbers(last);
  added_ = saved.integer("ledger_added");
}

void write_energy(const std::string& path, const std::vector<EnergyLine>& lines, int digits) {
  CsvFile file(path, digits);
  file.header(
      "time,kinetic,strain,damping_loss,contact_work,friction_loss,input_work,gravity_work,device_"
      "work,"
      "residual");
  for (const EnergyLine& line : lines) {
    file.row("", {line.time, line.kinetic, line.strain, line.damping_loss, line.contact_work,
                  line.friction_loss, line.input_work, line.gravity_work, line.device_work,
                  line.residual});
  }
  file.close();
}

}  // namespace pounding
