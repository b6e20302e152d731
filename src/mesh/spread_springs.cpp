#include "mesh/spread_springs.h"

namespace pounding {

std::vector<SpreadReport> find_spread_springs(const GlobalMesh& mesh) {
  std::vector<SpreadReport> found;
  for (const ElementSet& set : mesh.regions) {
    if (set.share.empty()) continue;
    SpreadReport& report = found.emplace_back();
    report.region = set.region;
    report.nodes = static_cast<std::int64_t>(set.tags.size());
    for (const double share : set.share) report.extent += share;
  }
  return found;
}

}  // namespace pounding
