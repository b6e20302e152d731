#include <string>
#include <utility>

#include "dynamics/link_step.h"

namespace pounding {

namespace {

/// Name of what a link remembers; all links of an element but that along x say which one they are.
std::string memory_name(int structure, const Link& link) {
  const std::string name = "link " + std::to_string(structure) + " " + std::to_string(link.number);
  return link.origin.component == 0 ? name : name + " " + std::to_string(link.origin.component);
}

std::vector<std::string> record_names(int structure, const std::vector<Link>& links,
                                      const LinkRecords& records) {
  std::vector<std::string> names;
  for (const std::size_t b : records.links()) {
    names.push_back("record of part " + std::to_string(static_cast<int>(links[b].origin.part)) +
                    " of " + memory_name(structure, links[b]));
  }
  return names;
}

}  // namespace

void LinkStep::save(int structure, SavedState& saved) const {
  for (std::size_t b = 0; b < links_.size(); ++b) {
    if (!memory_[b].empty()) saved.put(memory_name(structure, links_[b]), memory_[b]);
  }
  records_.save(record_names(structure, links_, records_), saved);
}

void LinkStep::load(int structure, const SavedState& saved) {
  rates_known_ = false;
  for (std::size_t b = 0; b < links_.size(); ++b) {
    if (!memory_[b].empty()) saved.get(memory_name(structure, links_[b]), memory_[b]);
  }
  records_.load(record_names(structure, links_, records_), saved);
}

void LinkStep::record(std::vector<std::size_t> links) {
  records_.watch(std::move(links));
  if (!records_.empty()) recorded_.assign(links_.size(), 0.0);
}

void LinkStep::note_records() {
  for (std::size_t k = 0; k < records_.links().size(); ++k) {
    const std::size_t b = records_.links()[k];
    const double force = force_[b] + laws_[b]->counted(now_[b]);
    records_.note(k, recorded_[b], force, laws_[b]->has_yielded(memory_[b]));
    records_.add_work(k, force * (after_[b] - before_[b]) / 2);
  }
}

}  // namespace pounding
