#include "modal/static_loads.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "common/matrix3.h"
#include "common/parallel.h"
#include "modal/eigen_solver.h"
#include "system/load_shapes.h"
#include "system/support_shapes.h"

namespace pounding {
namespace {

/// Contact points whose forces are one load: every one alone, or patches.
std::vector<std::vector<std::size_t>> load_patches(MPI_Comm comm, const Mesh& mesh,
                                                   const std::vector<TracePoint>& points,
                                                   std::size_t wanted) {
  if (wanted == 0 || wanted >= points.size()) {
    std::vector<std::vector<std::size_t>> single;
    for (std::size_t p = 0; p < points.size(); ++p) single.push_back({p});
    return single;
  }
  std::vector<double> coordinates(3 * points.size(), 0.0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const LocalIndex node = mesh.owned_node(points[p].node);
    if (node >= 0) std::ranges::copy(mesh.position(node), &coordinates[3 * p]);
  }
  reduce_over_ranks(comm, MPI_SUM, coordinates);
  std::vector<Vector3> positions;
  for (std::size_t p = 0; p < points.size(); ++p) {
    positions.push_back({coordinates[3 * p], coordinates[3 * p + 1], coordinates[3 * p + 2]});
  }
  return contact_patches(points, positions, wanted);
}

std::vector<double> weight_of(const LinearSystem& system, const Vector3& gravity) {
  std::vector<double> weight(system.lumped_mass.size(), 0.0);
  for (std::size_t i = 0; i < weight.size(); ++i) {
    const int direction = system.direction[i];
    if (direction >= 0) weight[i] = std::sqrt(system.lumped_mass[i]) * gravity[direction];
  }
  const auto& [dofs, force] = system.water;
  for (std::size_t k = 0; k < 3 * dofs.size(); ++k) {
    const auto i = static_cast<std::size_t>(dofs[k / 3]);
    weight[i] += std::sqrt(system.inverse_mass[i]) * force[k % 3][k / 3] * gravity[k % 3];
  }
  return weight;
}

void add_contact_loads(const LinearSystem& system, const Mesh& mesh, const ModalRequest& request,
                       DenseMatrix& loads) {
  const std::vector<TracePoint> points = free_points(system.comm, mesh, request.contact_points);
  for (const std::vector<std::size_t>& patch :
       load_patches(system.comm, mesh, points, static_cast<std::size_t>(request.patches))) {
    std::vector<double> load(loads.rows, 0.0);
    for (const std::size_t p : patch) {
      const LocalIndex dof = mesh.owned_dof(points[p].node, points[p].component);
      if (dof >= 0) load[dof] = patch.size() == 1 ? 1 : std::sqrt(system.inverse_mass[dof]);
    }
    loads.append(load);
  }
}

using Patch = std::vector<std::size_t>;

/// Patches of points that move along one axis.
std::vector<Patch> patches_of(const Patch& points, std::span<const Vector3> positions,
                              std::size_t count) {
  std::vector<double> square(points.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> nearest(points.size(), 0);
  std::size_t middle = 0;
  for (std::size_t patch = 0; patch < count; ++patch) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double own = square_between(positions[points[i]], positions[points[middle]]);
      if (!(own < square[i])) continue;
      square[i] = own;
      nearest[i] = patch;
    }
    middle = static_cast<std::size_t>(std::ranges::max_element(square) - square.begin());
  }
  std::vector<Patch> patches(count);
  for (std::size_t i = 0; i < points.size(); ++i) patches[nearest[i]].push_back(points[i]);
  std::erase_if(patches, [](const Patch& patch) { return patch.empty(); });  // points that coincide
  return patches;
}

}  // namespace

std::vector<TracePoint> free_points(MPI_Comm comm, const Mesh& mesh,
                                    const std::vector<TracePoint>& points) {
  std::vector<std::uint8_t> found;
  for (const TracePoint& point : points) {
    found.push_back(mesh.owned_dof(point.node, point.component) >= 0 ? 1 : 0);
  }
  reduce_over_ranks(comm, MPI_MAX, found);
  std::vector<TracePoint> free;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (found[p] != 0) free.push_back(points[p]);
  }
  return free;
}

DenseMatrix scaled_loads(const LinearSystem& system) {
  DenseMatrix scaled(system.lumped_mass.size(), 0);
  for (const LoadShape& shape : system.loads->loads) {
    std::vector<double> load(scaled.rows, 0.0);
    for (std::size_t k = 0; k < shape.dofs.size(); ++k) {
      const LocalIndex dof = shape.dofs[k];
      load[dof] = std::sqrt(system.inverse_mass[dof]) * shape.force[k];
    }
    scaled.append(load);
  }
  return scaled;
}

DenseMatrix scaled_start(const LinearSystem& system) {
  DenseMatrix scaled(system.lumped_mass.size(), 0);
  for (std::vector<double> field : {system.start->displacement, system.start->velocity}) {
    scale_by_root_mass(system, field);
    scaled.append(field);
  }
  return scaled;
}

DenseMatrix static_loads(const LinearSystem& system, const Mesh& mesh,
                         const ModalRequest& request) {
  DenseMatrix loads(system.lumped_mass.size(), 0);
  if (request.gravity != Vector3{0, 0, 0}) loads.append(weight_of(system, request.gravity));
  if (system.loads) loads.append_columns(scaled_loads(system));
  if (!request.attachment) return loads;
  add_contact_loads(system, mesh, request, loads);
  for (const TracePoint& point : free_points(system.comm, mesh, request.yielding_points)) {
    std::vector<double> load(loads.rows, 0.0);
    if (const LocalIndex dof = mesh.owned_dof(point.node, point.component); dof >= 0) load[dof] = 1;
    loads.append(load);
  }
  return loads;
}

std::vector<std::vector<std::size_t>> contact_patches(std::span<const TracePoint> points,
                                                      std::span<const Vector3> positions,
                                                      std::size_t count) {
  std::vector<Patch> all;
  for (int component = 0; component < 6; ++component) {
    Patch along;
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (points[p].component == component) along.push_back(p);
    }
    if (along.empty()) continue;
    const double share = static_cast<double>(along.size()) / static_cast<double>(points.size());
    const auto own = static_cast<std::size_t>(std::lround(share * static_cast<double>(count)));
    std::ranges::move(patches_of(along, positions, std::clamp<std::size_t>(own, 1, along.size())),
                      std::back_inserter(all));
  }
  return all;
}

DenseMatrix ground_loads(const LinearSystem& system) {
  DenseMatrix loads(system.lumped_mass.size(), 0);
  for (const Vector3& along : {Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}}) {
    loads.append(weight_of(system, along));
  }
  if (system.supports) loads.append_columns(support_loads(system));
  return loads;
}

DenseMatrix support_loads(const LinearSystem& system) {
  DenseMatrix loads(system.lumped_mass.size(), 0);
  for (std::vector<double> load : system.supports->shape) {
    load.resize(loads.rows, 0.0);
    scale_by_root_mass(system, load);
    loads.append(load);
  }
  return loads;
}

}  // namespace pounding
