#include "mesh/location.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "common/error.h"
#include "common/parallel.h"
#include "elements/element_traits.h"

namespace pounding {
namespace {

/// (x, y, z) to a tenth of a millimetre.
std::string describe_position(const Vector3& x) {
  const auto rounded = [](double value) { return std::round(1e4 * value) / 1e4; };
  return place_text({rounded(x[0]), rounded(x[1]), rounded(x[2])});
}

/// The first element of the file that holds a node; empty if none does.
std::string element_at(const Mesh& mesh, LocalIndex node) {
  for (const ElementBlock& block : mesh.blocks) {
    const std::size_t nodes = element_layout(block.type).nodes;
    for (std::size_t corner = 0; corner < block.connectivity.size(); ++corner) {
      if (block.connectivity[corner] == node) {
        return ", element " + std::to_string(block.tags[corner / nodes]) + " of group '" +
               block.group + "'";
      }
    }
  }
  return "";
}

}  // namespace

std::string describe_element(const Mesh& mesh, const ElementBlock& block, std::size_t element) {
  const std::size_t nodes = element_layout(block.type).nodes;
  Vector3 centre{0, 0, 0};
  for (std::size_t a = 0; a < nodes; ++a) {
    const Vector3 x = mesh.position(block.connectivity[element * nodes + a]);
    for (std::size_t d = 0; d < 3; ++d) centre[d] += x[d] / static_cast<double>(nodes);
  }
  return "element " + std::to_string(block.tags[element]) + " of group '" + block.group + "' at " +
         describe_position(centre);
}

std::string locate_largest(const Mesh& mesh, std::span<const double> values) {
  double largest = -1;
  LocalIndex place = -1;
  int component = 0;
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    for (int c = 0; c < 6; ++c) {
      const LocalIndex dof = mesh.dof(node, c);
      if (dof < 0) continue;
      const double value = values[dof];
      const double size =
          std::isfinite(value) ? std::abs(value) : std::numeric_limits<double>::infinity();
      if (size > largest) {
        largest = size;
        place = node;
        component = c;
      }
    }
  }
  std::string mine;
  if (place >= 0) {
    mine = "node at " + describe_position(mesh.position(place)) + ", component " +
           (component < 3 ? "u" : "r") + direction_names[component % 3] + element_at(mesh, place);
  }
  share_extreme(mesh.comm, MPI_MAXLOC, largest, mine);
  return mine;
}

RegionShare busiest_region(const Mesh& mesh, std::span<const double> values) {
  std::vector<double> square(mesh.owned_nodes);
  for_each_owned_dof(mesh, [&](LocalIndex dof, LocalIndex node, int) {
    square[node] += values[dof] * values[dof];
  });
  int regions = 0;
  for (const ElementBlock& block : mesh.blocks) regions = std::max(regions, block.region + 1);
  reduce_over_ranks(mesh.comm, MPI_MAX, regions);
  std::vector<double> sums(regions + 1);
  sums[regions] = std::accumulate(square.begin(), square.end(), 0.0);
  std::vector<int> counted(mesh.owned_nodes, -1);  // region that had the node last
  for (int region = 0; region < regions; ++region) {
    for (const ElementBlock& block : mesh.blocks) {
      if (block.region != region) continue;
      for (const LocalIndex node : block.connectivity) {
        if (node >= mesh.owned_nodes || counted[node] == region) continue;
        counted[node] = region;
        sums[region] += square[node];
      }
    }
  }
  reduce_over_ranks(mesh.comm, MPI_SUM, sums);
  RegionShare found;
  constexpr double equal = 1e-9;  // difference of two shares that is round-off
  for (int region = 0; region < regions; ++region) {
    const double share = sums[regions] > 0 ? sums[region] / sums[regions] : 0;
    if (share > found.share + equal) found = {region, share};
  }
  return found;
}

}  // namespace pounding
