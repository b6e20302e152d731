#include "system/axial_forces.h"

#include <algorithm>
#include <cmath>

#include "common/parallel.h"
#include "elements/geometric_stiffness.h"
#include "mesh/element_properties.h"
#include "mesh/ghost_dofs.h"
#include "mesh/halo.h"
#include "mesh/location.h"
#include "stiffness/element_loop.h"

namespace pounding {
namespace {

/// Binary digits of the largest force that are kept.
constexpr int kept_digits = 30;

double rounded(double force, double unit) {
  return unit > 0 ? std::round(force / unit) * unit : 0;
}

/// The largest value over the ranks, and the text that belongs to it.
void share_largest(MPI_Comm comm, LargestCompression& largest) {
  struct {
    double value;
    int rank;
  } found{largest.force, rank_of(comm)};
  MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_DOUBLE_INT, MPI_MAXLOC, comm);
  largest.force = found.value;
  std::vector<char> letters(largest.place.begin(), largest.place.end());
  broadcast_array(comm, letters, found.rank);
  largest.place.assign(letters.begin(), letters.end());
}

}  // namespace

std::vector<double> with_ghosts(const Mesh& mesh, const std::vector<double>& owned) {
  const std::vector<GlobalIndex> ghosts = ghost_dofs(mesh);
  Halo halo(mesh.comm, mesh.first_owned_dof, mesh.owned_dofs, ghosts);
  halo.begin(owned.data());
  halo.end();
  std::vector<double> values = owned;
  values.resize(mesh.dof_count);
  for (std::size_t i = 0; i < ghosts.size(); ++i) {
    values[mesh.owned_dofs + static_cast<LocalIndex>(i)] = halo.ghosts()[halo.place(i)];
  }
  return values;
}

LargestCompression set_axial_forces(const Structure& structure,
                                    const std::vector<double>& displacement, Mesh& mesh) {
  const std::vector<double> values = with_ghosts(mesh, displacement);
  stiffness::ElementWork work;
  double largest = 0;
  for (ElementBlock& block : mesh.blocks) {
    block.axial_force.clear();
    if (!has_axial_force(block.type)) continue;
    const ElementProperties properties = element_properties(structure.regions[block.region]);
    const ElementLayout layout = element_layout(block.type);
    for (std::size_t e = 0; e < block.count(); ++e) {
      const auto dofs = stiffness::element_dofs(mesh, block, e, layout);
      std::array<double, 6> ends{};
      for (std::size_t i = 0; i < ends.size(); ++i) {
        const LocalIndex dof = dofs[i / 3 * static_cast<std::size_t>(layout.components) + i % 3];
        ends[i] = dof < 0 ? 0 : values[dof];
      }
      const double force = axial_force(gather_coordinates(mesh, block, e, work), properties, ends);
      block.axial_force.push_back(force);
      largest = std::max(largest, std::abs(force));
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, mesh.comm);
  const double unit = largest > 0 ? std::ldexp(1.0, std::ilogb(largest) - kept_digits) : 0;
  LargestCompression result;
  for (ElementBlock& block : mesh.blocks) {
    for (std::size_t e = 0; e < block.axial_force.size(); ++e) {
      block.axial_force[e] = rounded(block.axial_force[e], unit);
      if (-block.axial_force[e] > result.force) {
        result = {-block.axial_force[e], describe_element(mesh, block, e)};
      }
    }
  }
  share_largest(mesh.comm, result);
  return result;
}

}  // namespace pounding
