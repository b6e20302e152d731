#include "observers/energy_ledger.h"

#include "io/csv_file.h"

namespace pounding {
namespace {

/// Lines that are kept at most.
constexpr std::int64_t most_lines = 5000;

/// The numbers of a line in a saved state.
constexpr auto line_members = [](auto& line, const auto& take) {
  take(line.time, line.kinetic, line.strain, line.residual);
  for (auto& row : line.rows) take(row);
};

}  // namespace

EnergyLedger::EnergyLedger(std::int64_t expected_lines)
    : stride_((expected_lines + most_lines - 1) / most_lines) {}

void EnergyLedger::add(const EnergyLine& line) {
  last_ = line;
  if (added_++ % stride_ == 0) lines_.push_back(line);
}

void EnergyLedger::keep(const StateKeeper& state) {
  lines_.push_back(last_);
  state.list("ledger", lines_, line_members);
  if (lines_.empty()) state.state().refuse_values("ledger");
  last_ = lines_.back();
  lines_.pop_back();
  state.numbers("ledger_added", added_);
}

std::string energy_columns() {
  std::string names = "time,kinetic,strain";
  for (const LedgerRow& row : ledger_rows) {
    if (!row.key.empty()) names += "," + std::string(row.name);
  }
  return names + ",residual";
}

void write_energy(const std::string& path, const std::vector<EnergyLine>& lines, int digits) {
  CsvFile file(path, digits);
  file.header(energy_columns());
  for (const EnergyLine& line : lines) {
    std::vector<double> values{line.time, line.kinetic, line.strain};
    for (std::size_t r = 0; r < ledger_rows.size(); ++r) {
      if (!ledger_rows[r].key.empty()) values.push_back(line.rows[r]);
    }
    values.push_back(line.residual);
    file.row("", values);
  }
  file.close();
}

}  // namespace pounding
