#include "driver/yield_table.h"

#include <algorithm>
#include <tuple>

#include "common/component_names.h"
#include "common/gather_rows.h"
#include "common/parallel.h"
#include "driver/run_statistics.h"
#include "io/csv_file.h"
#include "system/links.h"

namespace pounding {
namespace {

/// Numbers of the parts of springs, by component, and of bars, above those of sections.
constexpr std::size_t of_springs = 100;
constexpr std::size_t axial = 200;

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
  /// Region, element, part, ductility and lost energy of each law of this rank.
  std::vector<double> own_rows(std::size_t structure) const;
  std::string part_name(std::size_t structure, int region, std::size_t part) const;
  /// Rows of all ranks. Collective.
  std::vector<YieldRow> rows() const;

  ObservedRun run_;
};

}  // namespace

std::vector<double> YieldTable::own_rows(std::size_t structure) const {
  std::vector<double> rows;
  const auto add = [&](const std::string& group, std::int64_t element, std::size_t part,
                       double ductility, double lost) {
    const auto& regions = run_.scene.structures[structure].regions;
    const auto region = std::ranges::find(regions, group, &Region::group) - regions.begin();
    rows.insert(rows.end(), {static_cast<double>(region), static_cast<double>(element),
                             static_cast<double>(part), ductility, lost});
  };
  if (const auto* const elements = run_.solver.inelastic(structure)) {
    for (const interactions::InelasticElements::Part& part : elements->parts()) {
      const ElementBlock& block = elements->block_of(part);
      const interactions::PartState state = elements->state_of(part);
      add(block.group, block.tags[part.element], part.number, state.ductility, state.lost);
    }
  }
  if (const auto* const links = run_.solver.links(structure)) {
    const std::vector<Link>& all = run_.model.systems[structure].links->links();
    for (std::size_t b = 0; b < all.size(); ++b) {
      const double ductility = links->ductility(b);
      if (ductility < 0) continue;
      const std::size_t part = all[b].origin.length > 0
                                   ? axial
                                   : of_springs + static_cast<std::size_t>(all[b].origin.component);
      add(all[b].origin.region->group, all[b].number, part, ductility, links->lost(b));
    }
  }
  return rows;
}

std::string YieldTable::part_name(std::size_t structure, int region, std::size_t part) const {
  if (part == axial) return "axial";
  if (part >= of_springs) return std::string(motion_names[part - of_springs]);
  const auto& laws = run_.model.systems[structure].laws;
  return std::ranges::find(laws, region, &interactions::RegionLaw::region)->law->parts()[part];
}

std::vector<YieldRow> YieldTable::rows() const {
  std::vector<YieldRow> all;
  for (std::size_t s = 0; s < run_.model.systems.size(); ++s) {
    const std::vector<double> table = gather_rows(run_.comm, own_rows(s));
    constexpr std::size_t width = 5;
    for (std::size_t r = 0; r < table.size(); r += width) {
      const auto region = static_cast<std::size_t>(table[r]);
      const std::string part =
          part_name(s, static_cast<int>(region), static_cast<std::size_t>(table[r + 2]));
      all.push_back({run_.model.systems[s].name + ":" +
                         run_.scene.structures[s].regions[region].group + ":" + part,
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
