#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "common/error.h"
#include "common/facts.h"
#include "common/matrix3.h"
#include "common/parallel.h"
#include "common/types.h"
#include "model/element_middle.h"
#include "observers/observed_run.h"
#include "observers/run_statistics.h"
#include "system/links.h"

namespace pounding {
namespace {

constexpr double far_point = 10;  ///< of an element from the place that loops_at names [m]

/// A law that an item of the option may mean, as it travels between ranks.
struct Candidate {
  int component = 0;
  bool is_dashpot = false;
  std::int64_t number = 0;      ///< of its element or pair
  Vector3 place{};              ///< middle of the element [m]
  std::array<char, 24> part{};  ///< its name; none of a pair
  int item = 0;
  int rank = 0;
  int source = 0;  ///< among those of the rank
  int index = 0;   ///< in it

  void call(std::string_view name) { name.copy(part.data(), part.size() - 1); }
  auto key() const { return std::tuple(item, number, component, is_dashpot); }
};

/// Links, elements or pairs whose laws can be recorded.
struct Source {
  const interactions::LinkRecords* records = nullptr;
  std::function<void(std::vector<std::size_t>)> record;
  /// Calls `take` with each of its laws that an item means, its index set.
  std::function<void(const Loop&, const std::function<void(Candidate)>& take)> find;
  std::vector<std::size_t> chosen{};
};

/// Links of this rank, wherever they are.
void find_links(const Mesh& mesh, const std::vector<Link>& links, const Loop& loop,
                const std::function<void(Candidate)>& take) {
  for (std::size_t b = 0; b < links.size(); ++b) {
    const interactions::LinkOrigin& origin = links[b].origin;
    if (mesh.structure != loop.structure || origin.region == nullptr ||
        origin.region->group != loop.group || origin.part == interactions::SpringPart::gauge) {
      continue;
    }
    Candidate found{origin.component, origin.part == interactions::SpringPart::dashpot,
                    links[b].number, element_middle(mesh, loop.group, links[b].number)};
    found.call(origin.length > 0 ? "axial"
                                 : motion_names[static_cast<std::size_t>(origin.component)]);
    found.index = static_cast<int>(b);
    take(found);
  }
}

/// Parts of inelastic elements of this rank.
void find_parts(const Mesh& mesh, const interactions::InelasticElements& elements, const Loop& loop,
                const std::function<void(Candidate)>& take) {
  for (std::size_t k = 0; k < elements.parts().size(); ++k) {
    const interactions::InelasticElements::Part& part = elements.parts()[k];
    const ElementBlock& block = elements.block_of(part);
    if (mesh.structure != loop.structure || block.group != loop.group) continue;
    const std::string name = elements.name_of(part);
    const auto motion = std::ranges::find(motion_names, name);
    const bool moves = motion != motion_names.end();
    Candidate found{
        moves ? static_cast<int>(motion - motion_names.begin()) : static_cast<int>(part.number),
        false, block.tags[part.element], element_middle(mesh, block, part.element)};
    found.call(name);
    found.index = static_cast<int>(k);
    take(found);
  }
}

void find_rows(const Scene& scene, const interactions::FillerRows& fillers, const Loop& loop,
               const std::function<void(Candidate)>& take) {
  Candidate found;
  const std::vector<interactions::FillerPairs::Pair>& rows = fillers.pairs().all();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (scene.contacts[rows[r].contact].name != loop.contact) continue;
    ++found.number;
    found.index = static_cast<int>(r);
    take(found);
  }
}

/// All sources of this rank.
std::vector<Source> find_sources(const ObservedRun& run) {
  std::vector<Source> sources;
  const auto add = [&](auto& of, auto find) {
    sources.push_back({&of.records(),
                       [&of](std::vector<std::size_t> chosen) { of.record(std::move(chosen)); },
                       std::move(find)});
  };
  for (std::size_t s = 0; s < run.model.systems.size(); ++s) {
    const Mesh& mesh = run.model.meshes[s];
    if (auto* const links = run.scheme.links(s)) {
      add(*links, [&mesh, &all = run.model.systems[s].links->links()](
                      const Loop& loop, auto& take) { find_links(mesh, all, loop, take); });
    }
    for (auto* const elements : run.scheme.inelastic(s)) {
      add(*elements, [&mesh, elements](const Loop& loop, auto& take) {
        find_parts(mesh, *elements, loop, take);
      });
    }
  }
  auto* const fillers = run.scheme.fillers();
  if (fillers != nullptr && fillers->pairs().rows().root() == rank_of(run.comm)) {
    add(*fillers, [&run, fillers](const Loop& loop, auto& take) {
      find_rows(run.scene, *fillers, loop, take);
    });
  }
  return sources;
}

/// Candidates of all ranks, on all of them, in an order that does not depend on them.
std::vector<Candidate> of_all_ranks(MPI_Comm comm, const std::vector<Candidate>& mine) {
  std::vector<Candidate> all = gather_rows(comm, mine);
  std::ranges::sort(all, {}, &Candidate::key);
  return all;
}

/// Leaves the elements nearest to the points, if there are any points.
void keep_nearest(const Loop& loop, int item, std::vector<Candidate>& all) {
  if (loop.points.empty() || loop.group.empty()) return;
  std::set<std::int64_t> kept;
  for (const Vector3& point : loop.points) {
    double least = std::numeric_limits<double>::infinity();
    std::int64_t nearest = -1;
    for (const Candidate& link : all) {
      const double away = norm(minus(link.place, point));
      if (link.item != item || !(away < least * (1 - 1e-9))) continue;
      least = away;
      nearest = link.number;
    }
    refuse_if(
        least > far_point,
        sentence(
            "option -loops_at: the nearest element of {} is {:.4g} m from ({:.6g}, {:.6g}, {:.6g})",
            {loop.name, least, point[0], point[1], point[2]}));
    kept.insert(nearest);
  }
  std::erase_if(
      all, [&](const Candidate& link) { return link.item == item && !kept.contains(link.number); });
}

std::string name_of(const std::string& item, const Candidate& law) {
  const std::string part = law.part.data();
  return item + "." + std::to_string(law.number) + (part.empty() ? "" : "." + part) +
         (law.is_dashpot ? ".dashpot" : "");
}

/// Links that the scene wants recorded: finds them, has their steps record them, and brings
/// elongation and force of each to the history. A link is named after its item, the element's
/// number in the mesh file, and the component ("frame:pads.17.x", a bar's "axial", a dashpot's
/// "x.dashpot"); a pair with filler after its contact and its number among the pairs. Throws
/// UserError for a group without links. Collective.
class Loops final : public Observer {
 public:
  explicit Loops(const ObservedRun& run) : run_(run) {
    const std::vector<Loop>& items = run.scene.loops;
    const int rank = rank_of(run.comm);
    std::vector<Source> sources = find_sources(run);
    std::vector<Candidate> all;
    for (std::size_t i = 0; i < items.size(); ++i) {
      items_.push_back(items[i].name);
      for (std::size_t k = 0; k < sources.size(); ++k) {
        sources[k].find(items[i], [&](Candidate found) {
          found.item = static_cast<int>(i);
          found.rank = rank;
          found.source = static_cast<int>(k);
          all.push_back(found);
        });
      }
    }
    all = of_all_ranks(run.comm, all);
    for (std::size_t i = 0; i < items.size(); ++i) {
      const int item = static_cast<int>(i);
      refuse_if(std::ranges::find(all, item, &Candidate::item) == all.end(),
                "option -loops: nothing in " + items[i].name +
                    " yields, slides, damps or acts in one direction only; name a group that does");
      keep_nearest(items[i], item, all);
    }
    for (const Candidate& law : all) {
      if (law.rank == rank) {
        Source& source = sources[static_cast<std::size_t>(law.source)];
        mine_.push_back(static_cast<int>(names_.size()));
        own_.push_back({source.records, source.chosen.size()});
        source.chosen.push_back(static_cast<std::size_t>(law.index));
      }
      item_of_.push_back(law.item);
      names_.push_back(name_of(items[static_cast<std::size_t>(law.item)].name, law));
    }
    for (Source& source : sources) {
      if (!source.chosen.empty()) source.record(std::move(source.chosen));
    }
    values_.assign(2 * own_.size(), 0.0);
  }

  std::int64_t next_due(std::int64_t step) const override { return run_.next_record_step(step); }
  void observe(const CdLagrange& /*stepper*/) override {
    for (std::size_t k = 0; k < own_.size(); ++k) {
      values_[2 * k] = own_[k].records->elongation(own_[k].number);
      values_[2 * k + 1] = own_[k].records->force(own_[k].number);
    }
  }

  void report(RunStatistics& statistics) override {
    constexpr std::size_t width = 4;
    std::vector<double> all(width * names_.size(), 0.0);
    for (std::size_t k = 0; k < own_.size(); ++k) {
      const interactions::LinkTotals& t = own_[k].records->totals(own_[k].number);
      double* const to = &all[width * static_cast<std::size_t>(mine_[k])];
      to[0] = t.largest_elongation;
      to[1] = t.largest_force;
      to[2] = t.work;
      to[3] = t.yielded;
    }
    reduce_over_ranks(run_.comm, MPI_SUM, all);
    for (std::size_t item = 0; item < items_.size(); ++item) {
      std::size_t links = 0;
      std::array<double, width> most{};  // of the last two the sums
      Json yielded = Json::array();
      for (std::size_t i = 0; i < names_.size(); ++i) {
        if (item_of_[i] != static_cast<int>(item)) continue;
        const double* const from = &all[width * i];
        ++links;
        most = {std::max(most[0], from[0]), std::max(most[1], from[1]), most[2] + from[2],
                most[3] + from[3]};
        if (from[3] > 0) yielded.push_back(names_[i]);
      }
      statistics.findings.add(
          "loops", items_[item],
          {{"links", links},
           {"yielded", yielded},
           {"largest_elongation", most[0]},
           {"largest_force", most[1]},
           {"energy_taken", most[2]}},
          "  {:-12s} {:.0f} of {links} links yielded, elongation at most {largest_elongation:.4g "
          "mm} (or mrad), force {largest_force:.4g kN} (or kN m), took {energy_taken:.4g} J\n",
          {items_[item], most[3]});
    }
  }

  std::optional<RecordColumns> columns() const override {
    return RecordColumns{
        "links", names_, {{"link_elongation", "m, rad"}, {"link_force", "N, N m"}}, mine_, values_};
  }

 private:
  struct Own {
    const interactions::LinkRecords* records = nullptr;
    std::size_t number = 0;  ///< among those
  };

  ObservedRun run_;
  std::vector<std::string> items_;  ///< of the option
  std::vector<int> item_of_;        ///< per name
  std::vector<std::string> names_;  ///< of all links, the same on all ranks
  std::vector<int> mine_;           ///< those that this rank holds
  std::vector<Own> own_;            ///< per link of this rank
  std::vector<double> values_;      ///< elongation and force of each of these
};

}  // namespace

OutputKind loops_output() {
  return output<Loops>({}, [](const ObservedRun& run) { return !run.scene.loops.empty(); });
}

}  // namespace pounding
