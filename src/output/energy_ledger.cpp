#include "output/energy_ledger.h"

#include <array>

#include "io/csv_file.h"

namespace pounding {
namespace {

/// Lines that are kept at most.
constexpr std::int64_t capacity = 5000;

constexpr std::size_t ledger_columns = 12;

/// The numbers of a line in a table.
constexpr auto line_members = [](auto& line, const auto& take) {
  take(line.time, line.kinetic, line.strain, line.damping_loss, line.contact_work, line.input_work,
       line.device_work, line.residual, line.gravity_work, line.friction_loss, line.load_work,
       line.plastic_loss);
};

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
  saved.put("ledger", to_rows(lines_, line_members), ledger_columns);
  saved.put("ledger_last", to_rows(std::vector{last_}, line_members));
  saved.put("ledger_added", {static_cast<double>(added_)});
}

void EnergyLedger::load(const SavedState& saved) {
  const std::vector<double>& numbers = saved.table("ledger", ledger_columns);
  lines_.resize(numbers.size() / ledger_columns);
  from_rows(numbers, lines_, line_members);
  std::array<double, ledger_columns> last{};
  saved.get("ledger_last", last);
  std::vector<EnergyLine> lines(1);
  from_rows(last, lines, line_members);
  last_ = lines[0];
  added_ = saved.integer("ledger_added");
}

void write_energy(const std::string& path, const std::vector<EnergyLine>& lines, int digits) {
  CsvFile file(path, digits);
  file.header(
      "time,kinetic,strain,damping_loss,contact_work,friction_loss,input_work,gravity_work,load_"
      "work,device_work,plastic_loss,residual");
  for (const EnergyLine& line : lines) {
    file.row("", {line.time, line.kinetic, line.strain, line.damping_loss, line.contact_work,
                  line.friction_loss, line.input_work, line.gravity_work, line.load_work,
                  line.device_work, line.plastic_loss, line.residual});
  }
  file.close();
}

}  // namespace pounding
