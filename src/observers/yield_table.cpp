#include "observers/yield_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "common/facts_of.h"
#include "common/parallel.h"
#include "common/types.h"
#include "model/element_middle.h"
#include "observers/field_plan.h"
#include "observers/run_statistics.h"
#include "observers/storeys.h"

namespace pounding {
namespace {

constexpr double never_yielded = -1;

const ResultFile yielding_table{"yielding.csv", "the laws of elements and how far they went",
                                "law,element,ductility,lost_J,x,y,z,first_time"};

/// Numbers by which an element's law is known on every rank: structure, region, element, part.
using LawKey = std::array<double, 4>;

/// A law that has gone beyond its first corner, as a saved state has it.
struct Yielded {
  LawKey key{};
  double since = 0;  ///< [s]
};

constexpr auto yielded_members = [](auto& law, const auto& take) {
  take(law.key[0], law.key[1], law.key[2], law.key[3], law.since);
};

/// A law of an element of this rank that may yield.
struct FoundLaw {
  const interactions::InelasticElements* elements = nullptr;
  interactions::InelasticElements::Part part;

  std::size_t region() const { return static_cast<std::size_t>(elements->block_of(part).region); }
  std::int64_t element() const { return elements->block_of(part).tags[part.element]; }
  interactions::PartState state() const { return elements->state_of(part); }
  double ductility() const { return elements->ductility(part); }
};

std::vector<FoundLaw> yielding_laws(const ObservedRun& run, std::size_t structure) {
  std::vector<FoundLaw> laws;
  for (const auto* elements : run.scheme.inelastic(structure)) {
    for (const auto& part : elements->parts()) laws.push_back({elements, part});
  }
  return laws;
}

/// State of one law of one element at the end of a run.
struct YieldRow {
  std::string name;  ///< structure, group, part
  std::size_t structure = 0;
  std::int64_t element = 0;
  Vector3 place{};
  double since = never_yielded;  ///< sample at which it was first beyond its first corner [s]
  double ductility = 0;
  double lost = 0;
  auto key() const { return std::tie(name, element); }
};

/// Yielding of some elements by laws of one kind.
struct YieldSum {
  std::string name{};  ///< structure:group:part, or storey
  int elements = 0;
  int yielded = 0;                 ///< of them went beyond the first corner
  const YieldRow* most = nullptr;  ///< the one with the largest ductility, if that is above 0
  /// Sample at which the first of them was beyond its first corner [s]; infinite: none was.
  double first_time = std::numeric_limits<double>::infinity();
  double lost = 0;                            ///< energy of all [J]
  std::map<std::size_t, YieldSum> storeys{};  ///< in which there are any, from below

  void add(const YieldRow& row) {
    ++elements;
    lost += row.lost;
    if (row.ductility > 1) ++yielded;
    if (row.since != never_yielded) first_time = std::min(first_time, row.since);
    if (row.ductility > (most != nullptr ? most->ductility : 0)) most = &row;
  }

  Json values() const {
    const YieldRow& largest = most != nullptr ? *most : YieldRow{};
    Json of = FACTS_OF((*this), elements, yielded);
    of.update(FACTS_OF(largest, ductility, element, place));
    of.update({{"first_time", std::isfinite(first_time) ? Json(first_time) : Json()},
               {"energy_lost", lost}});
    return of;
  }
};

/// A line of the table of yielding in the report.
std::string told_yielding(const std::string& name, const Json& of) {
  return told("  {:-36s} {yielded:5d} of {elements:-5d} {ductility:10.4g} {element:9d}", of,
              {name}) +
         (of["first_time"].is_null() ? told(" {:12s}", nullptr, {"-"})
                                     : told(" {first_time:12.4f}", of)) +
         told(" {energy_lost:12.4g}  at {place:.4g} m\n", of);
}

Facts facts_of(const std::vector<YieldSum>& sums) {
  Facts facts;
  double lost = 0;
  int yielded = 0;
  for (const YieldSum& sum : sums) {
    lost += sum.lost;
    yielded += sum.yielded;
  }
  if (yielded == 0) {
    facts.say("\nnothing yielded; of the elongations of first corners there were at most\n");
  } else {
    facts.say("\nyielding, which took {:.4g} J\n", {lost});
  }
  facts.say(
      "  law, storey                          yielded        ductility   element      first s "
      "      J lost\n");
  for (const YieldSum& sum : sums) {
    Json of = sum.values();
    facts.text += told_yielding(sum.name, of);
    for (const auto& [order, storey] : sum.storeys) {
      of["storeys"][storey.name] = storey.values();
      facts.text += told_yielding("  " + storey.name, of["storeys"][storey.name]);
    }
    facts.values["yielding"][sum.name] = std::move(of);
  }
  return facts;
}

class YieldTable final : public Observer {
 public:
  explicit YieldTable(const ObservedRun& run)
      : run_(run), storeys_(find_storeys(run.comm, run.scene, run.model)) {
    for (std::size_t s = 0; s < run.model.systems.size(); ++s) {
      for (const FoundLaw& law : yielding_laws(run, s)) {
        own_.push_back({{static_cast<double>(s), static_cast<double>(law.region()),
                         static_cast<double>(law.element()), static_cast<double>(law.part.number)},
                        law,
                        element_middle(run.model.meshes[s], law.elements->block_of(law.part),
                                       law.part.element)});
      }
    }
  }

  std::int64_t next_due(std::int64_t step) const override { return run_.next_record_step(step); }
  void observe(const CdLagrange& stepper) override {
    for (Own& law : own_) {
      if (law.since == never_yielded && law.law.ductility() > 1) law.since = stepper.time();
    }
  }

  void keep_state(const StateKeeper& state) override {
    std::vector<Yielded> all;
    for (const Own& law : own_) {
      if (law.since != never_yielded) all.push_back({law.key, law.since});
    }
    if (state.puts()) all = gather_rows(run_.comm, all);
    state.known_if(rank_of(run_.comm) == 0).list("yielded_since", all, yielded_members);
    if (state.puts()) return;
    std::map<LawKey, double> since;
    for (const Yielded& law : all) since[law.key] = law.since;
    for (Own& law : own_) {
      if (const auto found = since.find(law.key); found != since.end()) law.since = found->second;
    }
  }

  void report(RunStatistics& statistics) override {
    const std::vector<YieldRow> all = rows();
    std::vector<YieldSum> sums;
    on_rank0(run_.comm, [&] {
      ResultTable file(run_.scene, yielding_table);
      for (const YieldRow& row : all) {
        const bool elastic = row.since == never_yielded;
        file.row(row.name, {static_cast<double>(row.element), row.ductility, row.lost, row.place[0],
                            row.place[1], row.place[2],
                            elastic ? std::numeric_limits<double>::quiet_NaN() : row.since});
        if (sums.empty() || sums.back().name != row.name) sums.push_back({row.name});
        sums.back().add(row);
        std::size_t order = 0;
        const std::string storey = storey_of(row, order);
        if (storey.empty()) continue;
        YieldSum& within = sums.back().storeys[order];
        within.name = storey;
        within.add(row);
      }
      file.close();
    });
    if (!sums.empty()) statistics.findings.add(facts_of(sums));
  }

 private:
  /// A law of an element of this rank.
  struct Own {
    LawKey key{};
    FoundLaw law;
    Vector3 place{};
    double since = never_yielded;
  };

  std::string part_name(std::size_t structure, std::size_t region, std::size_t part) const {
    const auto& laws = run_.model.systems[structure].laws;
    const auto number = static_cast<int>(region);
    return std::ranges::find(laws, number, &interactions::RegionLaw::region)->law->parts()[part];
  }

  /// Rows of all ranks. Collective.
  std::vector<YieldRow> rows() const {
    std::vector<double> mine;
    for (const Own& law : own_) {
      mine.insert(mine.end(), law.key.begin(), law.key.end());
      mine.insert(mine.end(), law.place.begin(), law.place.end());
      const interactions::PartState state = law.law.state();
      mine.insert(mine.end(), {law.since, state.ductility, state.lost});
    }
    const std::vector<double> table = gather_rows(run_.comm, mine);
    constexpr std::size_t width = 10;
    std::vector<YieldRow> all;
    for (std::size_t r = 0; r < table.size(); r += width) {
      const double* const v = &table[r];
      const auto s = static_cast<std::size_t>(v[0]);
      const auto region = static_cast<std::size_t>(v[1]);
      const std::string part = part_name(s, region, static_cast<std::size_t>(v[3]));
      const double loss = v[8] > 1 ? v[9] : 0;  // round-off while it is elastic
      all.push_back({run_.model.systems[s].name + ":" +
                         run_.scene.structures[s].regions[region].group + ":" + part,
                     s,
                     static_cast<std::int64_t>(v[2]),
                     {v[4], v[5], v[6]},
                     v[7],
                     v[8],
                     loss});
    }
    std::ranges::sort(all, {}, &YieldRow::key);
    return all;
  }

  /// The storey that a place is in, "roof over floor2"; empty where none is. `order`: its number.
  std::string storey_of(const YieldRow& row, std::size_t& order) const {
    for (order = 0; order < storeys_.size(); ++order) {
      const Storey& storey = storeys_[order];
      if (storey.structure != run_.scene.structures[row.structure].name) continue;
      const auto probe = static_cast<std::size_t>(storey.upper_probe);
      const double top = run_.model.probes[probe].position[2];
      const double small = 1e-9 * storey.height;
      if (row.place[2] > top - storey.height - small && row.place[2] < top + small) {
        return storey.upper + " over " + storey.lower;
      }
    }
    return "";
  }

  ObservedRun run_;
  std::vector<Own> own_;
  std::vector<Storey> storeys_;
};

}  // namespace

std::vector<double> yielding_elements(const ObservedRun& run, std::size_t structure) {
  std::map<std::pair<std::size_t, std::int64_t>, std::array<double, 3>> found;
  for (const FoundLaw& law : yielding_laws(run, structure)) {
    const interactions::PartState state = law.state();
    if (state.ductility == 0) continue;
    auto& [ductility, damage, lost] = found[{law.region(), law.element()}];
    ductility = std::max(ductility, state.ductility);
    damage = std::max(damage, state.damage);
    if (state.ductility > 1) lost += state.lost;  // round-off before
  }
  std::vector<double> rows;
  for (const auto& [key, values] : found) {
    rows.insert(rows.end(), {static_cast<double>(key.first), static_cast<double>(key.second)});
    rows.insert(rows.end(), values.begin(), values.end());
  }
  return rows;
}

OutputKind yield_output() {
  return output<YieldTable>({yielding_table}, [](const ObservedRun& run) {
    return std::ranges::count(yielding_structures(run.scene), 1) > 0;
  });
}

}  // namespace pounding
