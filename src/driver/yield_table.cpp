#include "driver/yield_table.h"

#include <algorithm>
#include <tuple>

#include "common/parallel.h"
#include "driver/run_statistics.h"
#include "io/csv_file.h"

namespace pounding {
namespace {

/// State of one law of one element at the end of a run.
struct YieldRow {
  std::string name;  ///< structure, group, part
  std::int64_t element = 0;
  double ductility = 0;
  double lost = 0;
  auto key() const { return std::tie(name, element); }
};

class YieldTable final : public Observer {
 public:
  explicit YieldTable(const ObservedRun& run) : run_(run) {}

  void report(RunStatistics& statistics) override;

 private:
  std::vector<YieldRow> rows() const;

  ObservedRun run_;
};

}  // namespace

std::vector<YieldRow> YieldTable::rows() const {
  std::vector<YieldRow> all;
  for (std::size_t s = 0; s < run_.model.systems.size(); ++s) {
    const interactions::InelasticElements* const elements = run_.solver.inelastic(s);
    if (elements == nullptr) continue;
    const LinearSystem& system = run_.model.systems[s];
    const std::vector<double> table = elements->table();
    constexpr std::size_t width = 5;
    for (std::size_t r = 0; r < table.size(); r += width) {
      const auto region = static_cast<std::size_t>(table[r]);
      const auto law = std::ranges::find(system.laws, static_cast<int>(region),
                                         &interactions::RegionLaw::region);
      const std::string part = law->law->parts()[static_cast<std::size_t>(table[r + 2])];
      all.push_back(
          {system.name + ":" + run_.scene.structures[s].regions[region].group + ":" + part,
           static_cast<std::int64_t>(table[r + 1]), table[r + 3],
           table[r + 3] > 1 ? table[r + 4] : 0});  // round-off while it is elastic
    }
  }
  std::ranges::sort(all, {}, &YieldRow::key);
  return all;
}

void YieldTable::report(RunStatistics& statistics) {
  const std::vector<YieldRow> all = rows();
  on_rank0(run_.comm, [&] {
    CsvFile file(run_.scene.output + "/yielding.csv", run_.scene.csv_digits);
    file.header("law,element,ductility,lost_J");
    for (const YieldRow& row : all) {
      file.row(row.name, {static_cast<double>(row.element), row.ductility, row.lost});
      if (statistics.yielding.empty() || statistics.yielding.back().name != row.name) {
        statistics.yielding.push_back({row.name});
      }
      YieldReport& sum = statistics.yielding.back();
      ++sum.elements;
      sum.yielded += row.ductility > 1 ? 1 : 0;
      sum.lost += row.lost;
      if (row.ductility > sum.ductility) {
        sum.ductility = row.ductility;
        sum.element = row.element;
      }
    }
    file.close();
  });
}

std::unique_ptr<Observer> make_yield_table(const ObservedRun& run) {
  return std::make_unique<YieldTable>(run);
}

}  // namespace pounding
