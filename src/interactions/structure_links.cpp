#include "interactions/structure_links.h"

#include <utility>

#include "interactions/laws/law_of.h"

namespace pounding::interactions {
namespace {

/// Name of the memory of a link; all links of an element but that along x say which one they are,
/// and the dashpot of a spring that it is no stiffness.
std::string memory_name(std::size_t structure, const Link& link) {
  std::string name = "link " + std::to_string(structure) + " " + std::to_string(link.number);
  const LinkOrigin& origin = link.origin;
  if (origin.component != 0) name += " " + std::to_string(origin.component);
  const bool dashpot = origin.region != nullptr && is_spring(origin.region->element) &&
                       origin.part == SpringPart::dashpot;
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
    for (std::size_t i = 0; i < link.place.size(); ++i) {
      if (link.place[i] >= 0) weights.add(link.place[i], link.weight[i]);
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
}

void StructureLinks::measure(const std::vector<double>& owned, std::vector<double>& elongations) {
  trace_.apply(owned.data(), field_.data(), 1);
  for (std::size_t b = 0; b < links_.size(); ++b) elongations[b] = row_product(weights_, b, field_);
}

void StructureLinks::save(SavedState& saved) const {
  for (std::size_t b = 0; b < links_.size(); ++b) {
    if (!memory_[b].empty()) saved.put(memory_name(structure_, links_[b]), memory_[b]);
  }
  records_.save(record_names(structure_, links_, records_), saved);
}

void StructureLinks::load(const SavedState& saved) {
  for (std::size_t b = 0; b < links_.size(); ++b) {
    if (!memory_[b].empty()) saved.get(memory_name(structure_, links_[b]), memory_[b]);
  }
  records_.load(record_names(structure_, links_, records_), saved);
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

}  // namespace pounding::interactions
