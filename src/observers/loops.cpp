#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdio>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "common/error.h"
#include "common/facts.h"
#include "common/matrix3.h"
#include "common/parallel.h"
#include "common/types.h"
#include "io/csv_file.h"
#include "model/element_middle.h"
#include "observers/observed_run.h"
#include "observers/run_statistics.h"
#include "system/links.h"

namespace pounding {
namespace {

constexpr int of_section = -2;
constexpr int of_section_link = -3;

/// A link that an item of the option may mean, as it travels between ranks.
constexpr double far_point = 10;  ///< of an element from the place that loops_at names [m]

struct Candidate {
  int item = 0;
  int component = 0;
  int part = 0;             ///< of SpringPart; -1: a pair with filler; -2: of a section; -3: of
                            ///< one in a reduced structure
  int bar = 0;              ///< 1: a bar, which has one component
  std::int64_t number = 0;  ///< of its element or pair
  Vector3 place{};          ///< middle of the element [m]
  int rank = 0;
  int index = 0;  ///< among the links or rows there

  bool is_dashpot() const { return part == static_cast<int>(interactions::SpringPart::dashpot); }
  auto key() const { return std::tuple(item, number, component, is_dashpot()); }
};

/// Links of this rank that an item means, wherever they are.
void add_links(const Model& model, const Loop& loop, int item, int rank,
               std::vector<Candidate>& found) {
  for (std::size_t s = 0; s < model.systems.size(); ++s) {
    if (model.systems[s].name != loop.structure || !model.systems[s].links) continue;
    const std::vector<Link>& links = model.systems[s].links->links();
    for (std::size_t b = 0; b < links.size(); ++b) {
      const interactions::LinkOrigin& origin = links[b].origin;
      if (origin.region == nullptr || origin.region->group != loop.group ||
          origin.part == interactions::SpringPart::gauge) {
        continue;
      }
      const int component =
          origin.component - (origin.section ? interactions::first_section_component : 0);
      found.push_back({item, component,
                       origin.section ? of_section_link : static_cast<int>(origin.part),
                       origin.length > 0 ? 1 : 0, links[b].number,
                       element_middle(model.meshes[s], loop.group, links[b].number), rank,
                       static_cast<int>(b)});
    }
  }
}

/// Laws of sections of this rank that an item means.
void add_section_laws(const Model& model, const Solver& solver, const Loop& loop, int item,
                      int rank, std::vector<Candidate>& found) {
  for (std::size_t s = 0; s < model.systems.size(); ++s) {
    const interactions::InelasticElements* const elements = solver.inelastic(s);
    if (model.systems[s].name != loop.structure || elements == nullptr) continue;
    for (std::size_t k = 0; k < elements->parts().size(); ++k) {
      const interactions::InelasticElements::Part& part = elements->parts()[k];
      const ElementBlock& block = elements->block_of(part);
      if (block.group != loop.group) continue;
      const std::int64_t tag = block.tags[part.element];
      found.push_back({item, static_cast<int>(part.number), of_section, 0, tag,
                       element_middle(model.meshes[s], loop.group, tag), rank,
                       static_cast<int>(k)});
    }
  }
}

void add_rows(const Scene& scene, const interactions::FillerRows& fillers, const Loop& loop,
              int item, int rank, std::vector<Candidate>& found) {
  std::int64_t number = 0;
  const std::vector<interactions::FillerPairs::Pair>& rows = fillers.pairs().all();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (scene.contacts[rows[r].contact].name != loop.contact) continue;
    found.push_back({item, 0, -1, 0, ++number, {}, rank, static_cast<int>(r)});
  }
}

/// Candidates of all ranks, on all of them, in an order that does not depend on them.
std::vector<Candidate> of_all_ranks(MPI_Comm comm, const std::vector<Candidate>& mine) {
  const int bytes = static_cast<int>(mine.size() * sizeof(Candidate));
  std::vector<int> counts(size_of(comm));
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  std::vector<int> offsets;
  int total = 0;
  for (const int count : counts) {
    offsets.push_back(total);
    total += count;
  }
  std::vector<Candidate> all(static_cast<std::size_t>(total) / sizeof(Candidate));
  MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), offsets.data(), MPI_BYTE,
                 comm);
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
    if (least > far_point) {
      throw UserError(sentence(
          "option -loops_at: the nearest element of {} is {:.4g} m from ({:.6g}, {:.6g}, {:.6g})",
          {loop.name, least, point[0], point[1], point[2]}));
    }
    kept.insert(nearest);
  }
  std::erase_if(
      all, [&](const Candidate& link) { return link.item == item && !kept.contains(link.number); });
}

/// Names of the parts of a region's law.
std::vector<std::string> part_names(const Scene& scene, const Model& model, const Loop& loop) {
  for (std::size_t s = 0; s < model.systems.size(); ++s) {
    for (const auto& [region, law] : model.systems[s].laws) {
      const bool meant = std::ranges::any_of(
          model.meshes[s].blocks,
          [&, of = region](const auto& b) { return b.region == of && b.group == loop.group; });
      if (model.systems[s].name == loop.structure && meant) return law->parts();
    }
    if (model.systems[s].name != loop.structure) continue;
    for (const Region& region : scene.structures[s].regions) {
      if (region.group == loop.group && yields_by_links(region)) return region.yielding.names();
    }
  }
  return {};
}

std::string name_of(const std::string& item, const Candidate& link,
                    const std::vector<std::string>& parts) {
  std::string name = item + "." + std::to_string(link.number);
  const bool section = link.part == of_section || link.part == of_section_link;
  if (section) return name + "." + parts[static_cast<std::size_t>(link.component)];
  if (link.part < 0) return name;
  const std::string component(
      link.bar != 0 ? "axial" : motion_names[static_cast<std::size_t>(link.component)]);
  return name + "." + component + (link.is_dashpot() ? ".dashpot" : "");
}

/// Links that the scene wants recorded: finds them, has their steps record them, and brings
/// elongation and force of each to the history. A link is named after its item, the element's
/// number in the mesh file, and the component ("frame:pads.17.x", a bar's "axial", a dashpot's
/// "x.dashpot"); a pair with filler after its contact and its number among the pairs. Throws
/// UserError for a group without links. Collective.
class Loops final : public Observer {
 public:
  explicit Loops(const ObservedRun& run);

  std::int64_t next_due(std::int64_t step) const override { return run_.next_record_step(step); }
  void observe(const CdLagrange& stepper) override;
  void report(RunStatistics& statistics) override;
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

Loops::Loops(const ObservedRun& run) : run_(run) {
  const Scene& scene = run.scene;
  const Model& model = run.model;
  Solver& solver = run.solver;
  const int rank = rank_of(run.comm);
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < scene.loops.size(); ++i) {
    const Loop& loop = scene.loops[i];
    const int item = static_cast<int>(i);
    items_.push_back(loop.name);
    if (loop.contact.empty()) {
      add_links(model, loop, item, rank, all);
      add_section_laws(model, solver, loop, item, rank, all);
    } else if (solver.fillers() != nullptr && solver.fillers()->pairs().rows().root() == rank) {
      add_rows(scene, *solver.fillers(), loop, item, rank, all);
    }
  }
  all = of_all_ranks(run.comm, all);
  std::vector<std::vector<std::string>> parts;  // of each item
  for (std::size_t i = 0; i < scene.loops.size(); ++i) {
    const int item = static_cast<int>(i);
    if (std::ranges::find(all, item, &Candidate::item) == all.end()) {
      throw UserError(
          "option -loops: nothing in " + scene.loops[i].name +
          " yields, slides, damps or acts in one direction only; name a group that does");
    }
    keep_nearest(scene.loops[i], item, all);
    parts.push_back(part_names(scene, model, scene.loops[i]));
  }
  std::vector<std::vector<std::size_t>> chosen(model.systems.size() + 1);  // the last: fillers
  std::vector<std::vector<std::size_t>> sections(model.systems.size());
  for (const Candidate& link : all) {
    const Loop& loop = scene.loops[static_cast<std::size_t>(link.item)];
    if (link.rank == rank) {
      std::size_t s = 0;
      while (s < model.systems.size() && model.systems[s].name != loop.structure) ++s;
      mine_.push_back(static_cast<int>(names_.size()));
      if (link.part == of_section) {
        own_.push_back({&solver.inelastic(s)->records(), sections[s].size()});
        sections[s].push_back(static_cast<std::size_t>(link.index));
      } else {
        own_.push_back(
            {s < model.systems.size() ? &solver.links(s)->records() : &solver.fillers()->records(),
             chosen[s].size()});
        chosen[s].push_back(static_cast<std::size_t>(link.index));
      }
    }
    item_of_.push_back(link.item);
    names_.push_back(name_of(loop.name, link, parts[static_cast<std::size_t>(link.item)]));
  }
  for (std::size_t s = 0; s < model.systems.size(); ++s) {
    if (!chosen[s].empty()) solver.links(s)->record(chosen[s]);
    if (!sections[s].empty()) solver.inelastic(s)->record(sections[s]);
  }
  if (!chosen.back().empty()) solver.fillers()->record(chosen.back());
  values_.assign(2 * own_.size(), 0.0);
}

void Loops::observe(const CdLagrange& /*stepper*/) {
  for (std::size_t k = 0; k < own_.size(); ++k) {
    values_[2 * k] = own_[k].records->elongation(own_[k].number);
    values_[2 * k + 1] = own_[k].records->force(own_[k].number);
  }
}

void Loops::report(RunStatistics& statistics) {
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
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM,
                run_.comm);
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
        "  {:-12s} {:.0f} of {links} links yielded, elongation at most {largest_elongation:.4g mm} "
        "(or mrad), force {largest_force:.4g kN} (or kN m), took {energy_taken:.4g} J\n",
        {items_[item], most[3]});
  }
}

OutputKind loops_output() {
  return output<Loops>({}, [](const ObservedRun& run) { return !run.scene.loops.empty(); });
}

}  // namespace pounding
