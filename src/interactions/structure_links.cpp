#include "interactions/structure_links.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "laws/law_of.h"
#include "system/support_shapes.h"

namespace pounding::interactions {
namespace {

constexpr double unstretched = 1e-9;  ///< elongation per unit of a support's motion, round-off

/// Name of the memory of a link; all links of an element but that along x say which one they are,
/// and the dashpot of a spring or bar that it is no stiffness.
std::string memory_name(std::size_t structure, const Link& link) {
  std::string name = "link " + std::to_string(structure) + " " + std::to_string(link.number);
  const LinkOrigin& origin = link.origin;
  if (origin.component != 0) name += " " + std::to_string(origin.component);
  const bool dashpot =
      origin.region != nullptr && !origin.region->foundation && origin.part == SpringPart::dashpot;
  return dashpot ? name + " dashpot" : name;
}

std::vector<std::string> record_names(std::size_t structure, const std::vector<Link>& links,
                                      const LinkRecords& records) {
  std::vector<std::string> names;
  for (const std::size_t b : records.links()) {
    names.push_back("record of part " + std::to_string(static_cast<int>(links[b].origin.part)) +
                    " of " + memory_name(structure, links[b]));
  }
  return names;
}

SparseRows weights_of(const std::vector<Link>& links) {
  SparseRows weights;
  for (const Link& link : links) {
    for (std::size_t i = 0; i < link.point.size(); ++i) {
      if (link.point[i] >= 0) weights.add(link.point[i], link.weight[i]);
    }
    weights.end_row();
  }
  return weights;
}

std::vector<std::unique_ptr<LinkLaw>> laws_of(const LinearSystem& system, double time_step) {
  const UniformDamping* const uniform = system.uniform_damping ? &*system.uniform_damping : nullptr;
  std::vector<std::unique_ptr<LinkLaw>> laws;
  for (const Link& link : system.links->links()) {
    laws.push_back(law_of(link.origin, time_step, uniform));
  }
  return laws;
}

}  // namespace

std::vector<std::vector<double>> carried_by_supports(const LinearSystem& system) {
  if (!system.supports) return {};
  const std::size_t columns = system.supports->columns.size();
  const Trace& trace = system.links->trace();
  std::vector<std::vector<double>> carried;
  for (const Link& link : system.links->links()) {
    std::vector<double>& row = carried.emplace_back(link.supports);
    row.resize(columns, 0.0);
    for (std::size_t i = 0; i < link.point.size(); ++i) {
      if (link.point[i] < 0) continue;
      const auto of_point = trace.carried(static_cast<std::size_t>(link.point[i]));
      for (std::size_t c = 0; c < columns; ++c) row[c] += link.weight[i] * of_point[c];
    }
  }
  const auto is_stretched = [](const std::vector<double>& row) {
    return std::ranges::any_of(row, [](double part) { return std::abs(part) > unstretched; });
  };
  if (std::ranges::none_of(carried, is_stretched)) carried.clear();
  return carried;
}

StructureLinks::StructureLinks(const LinearSystem& system, std::size_t structure, double time_step)
    : structure_(structure),
      time_step_(time_step),
      links_(system.links->links()),
      weights_(weights_of(links_)),
      trace_(system.links->trace()),
      laws_(laws_of(system, time_step)),
      memory_(laws_),
      held_(trace_.dofs().size()),
      field_(trace_.known().size(), 0.0),
      velocity_(trace_.dofs().size(), 0.0) {
  if (system.rest_displacement.empty()) return;
  std::vector<double> rest(links_.size(), 0.0);
  measure(system.rest_displacement, rest);
  for (std::size_t b = 0; b < links_.size(); ++b) laws_[b]->rest(rest[b], memory_[b]);
}

void StructureLinks::attach(std::span<SteppedStructure* const> structures) {
  structures[structure_]->watch(trace_.dofs(), true);
  structures[structure_]->take_links(memory_.values());
}

void StructureLinks::measure(const std::vector<double>& owned, std::vector<double>& elongations) {
  trace_.apply(owned.data(), field_.data(), 1);
  for (std::size_t b = 0; b < links_.size(); ++b) elongations[b] = row_product(weights_, b, field_);
}

void StructureLinks::keep(const StateKeeper& state) {
  for (std::size_t b = 0; b < links_.size(); ++b) {
    if (!memory_[b].empty()) state.table(memory_name(structure_, links_[b]), memory_[b]);
  }
  records_.keep(record_names(structure_, links_, records_), state);
}

void StructureLinks::record(std::vector<std::size_t> links) {
  records_.watch(std::move(links));
  if (!records_.empty()) recorded_.assign(links_.size(), 0.0);
}

void StructureLinks::note_records(std::span<const double> now, std::span<const double> stretch,
                                  std::span<const double> force) {
  for (std::size_t k = 0; k < records_.links().size(); ++k) {
    const std::size_t b = records_.links()[k];
    const double whole = force[b] + laws_[b]->counted(now[b]);
    records_.note(k, recorded_[b], whole, laws_[b]->has_yielded(memory_[b]));
    records_.add_work(k, whole * stretch[b]);
  }
}

YieldGroups::YieldGroups(std::span<const Link> links) {
  std::map<std::int64_t, std::size_t> circles;  // by element
  std::map<std::int64_t, int> gauges;
  for (std::size_t b = 0; b < links.size(); ++b) {
    const LinkOrigin& origin = links[b].origin;
    const auto component = static_cast<std::size_t>(origin.component);
    if (origin.part == SpringPart::gauge) gauges[links[b].number] = static_cast<int>(b);
    if (origin.part != SpringPart::stiffness || origin.region == nullptr ||
        !origin.region->nonlinear.yields(component)) {
      continue;
    }
    const NonlinearSpring& spring = origin.region->nonlinear;
    const std::size_t place = circles.try_emplace(links[b].number, groups_.size()).first->second;
    if (place == groups_.size()) groups_.emplace_back();
    groups_[place].links.push_back(b);
    groups_[place].pressing = origin.region->stiffness[spring.circle[2]];
    // Hardening carries its part without friction; a pendulum's slope is apart from it.
    const double part = spring.radius > 0 ? 1 : 1 - spring.hardening;
    groups_[place].friction = spring.friction * part * groups_[place].pressing;
  }
  for (const auto& [number, place] : circles) {
    const auto gauge = gauges.find(number);
    if (gauge != gauges.end()) groups_[place].gauge = gauge->second;
  }
}

void YieldGroups::yield(std::span<const std::unique_ptr<LinkLaw>> laws, std::span<const double> now,
                        LawMemory& memory) const {
  for (const Group& group : groups_) {
    const double pressed = group.gauge < 0 ? 0 : std::max(0.0, -now[group.gauge]);
    double square = 0;
    for (const std::size_t b : group.links) {
      square += std::pow(laws[b]->trial(now[b], memory[b]), 2);
    }
    const double size = std::sqrt(square);
    const double capacity =
        group.gauge < 0 ? laws[group.links.front()]->capacity() : group.friction * pressed;
    const double kept = size > capacity ? capacity / size : 1;
    for (const std::size_t b : group.links) {
      laws[b]->yield(now[b], kept, memory[b]);
      if (group.gauge >= 0) laws[b]->press(group.pressing * pressed, memory[b]);
    }
  }
}

}  // namespace pounding::interactions
