#include "system/rotary_scaling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/dense_matrix.h"
#include "common/matrix3.h"
#include "common/parallel.h"
#include "mesh/element_properties.h"
#include "stiffness/single_stiffness.h"
#include "system/mass_scaling.h"

namespace pounding {
namespace {

constexpr std::size_t per_node = 6;
constexpr double margin = 1e-6;  // of the step, for round-off

/// Corner of a shell's node in its matrices: 0 displacements, 3 rotations.
constexpr std::size_t displacements = 0;
constexpr std::size_t rotations = 3;

Vector3 corner(std::span<const double> coordinates, std::size_t node) {
  return {coordinates[3 * node], coordinates[3 * node + 1], coordinates[3 * node + 2]};
}

/// The unit normal of the plane of three nodes, or of the mean plane of four.
Vector3 normal_of(std::span<const double> coordinates) {
  const bool quadrangle = coordinates.size() == 12;
  const Vector3 first = minus(corner(coordinates, 2), corner(coordinates, 0));
  const Vector3 second =
      minus(corner(coordinates, quadrangle ? 3 : 1), corner(coordinates, quadrangle ? 1 : 0));
  return normalised(cross(first, second));
}

/// A right-handed frame whose third row is the normal.
Matrix3 frame_about(const Vector3& normal) {
  Vector3 other{0, 0, 0};
  const auto smallest = std::ranges::min_element(
      normal, [](double a, double b) { return std::abs(a) < std::abs(b); });
  other[static_cast<std::size_t>(smallest - normal.begin())] = 1;
  Matrix3 frame{};
  frame[2] = normal;
  frame[0] = normalised(cross(other, normal));
  frame[1] = cross(normal, frame[0]);
  return frame;
}

/// One of the four parts of a shell's stiffness, shape (3 n, 3 n).
std::vector<double> part_of(std::span<const double> stiffness, std::size_t nodes, std::size_t row,
                            std::size_t column) {
  const std::size_t n = 3 * nodes;
  std::vector<double> part(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t r = per_node * (i / 3) + i % 3 + row;
      const std::size_t c = per_node * (j / 3) + j % 3 + column;
      part[i * n + j] = stiffness[r * per_node * nodes + c];
    }
  }
  return part;
}

/// A B or A B^T of square matrices of order n.
std::vector<double> product(const std::vector<double>& a, const std::vector<double>& b,
                            std::size_t n, bool transposed) {
  std::vector<double> result(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) {
        result[i * n + j] += a[i * n + k] * (transposed ? b[j * n + k] : b[k * n + j]);
      }
    }
  }
  return result;
}

/// Order of the rotations about the axes of a frame: those in the plane first.
std::vector<double> turned(const std::vector<double>& matrix, const Matrix3& frame,
                           std::size_t nodes) {
  const std::size_t n = 3 * nodes;
  std::vector<double> axes(n * n, 0.0);
  for (std::size_t a = 0; a < nodes; ++a) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t row = i == 2 ? 2 * nodes + a : 2 * a + i;
      std::ranges::copy(frame[i], &axes[row * n + 3 * a]);
    }
  }
  return product(product(axes, matrix, n, false), axes, n, true);
}

/// Squared radii that make up for a missing inertia, in bending and about the normal apart.
AddedRadii split(const std::vector<double>& missing, std::span<const double> masses) {
  const std::size_t nodes = masses.size();
  const std::size_t n = 3 * nodes;
  const std::size_t plane = 2 * nodes;
  const auto block = [&](std::size_t first, std::size_t size) {
    std::vector<double> part(size * size);
    for (std::size_t i = 0; i < size; ++i) {
      std::copy_n(&missing[(first + i) * n + first], size, &part[i * size]);
    }
    return part;
  };
  std::vector<double> twice;
  for (const double mass : masses) twice.insert(twice.end(), 2, mass);
  double coupling = 0;
  for (std::size_t i = 0; i < plane; ++i) {
    for (std::size_t j = 0; j < nodes; ++j) {
      const double value = missing[i * n + plane + j];
      coupling += value * value / (twice[i] * masses[j]);
    }
  }
  coupling = std::sqrt(coupling);
  AddedRadii radii;
  radii.bending = std::max(0.0, largest_eigenvalue(block(0, plane), twice) + coupling);
  radii.drilling =
      std::max(radii.bending, largest_eigenvalue(block(plane, nodes), masses) + coupling);
  return radii;
}

/// Step that an element which nothing is added to allows [s].
double step_alone(const Structure& structure, const Region& region,
                  std::span<const double> stiffness, std::span<const double> mass) {
  const Rayleigh damping = structure.damping_of(region);
  const double square = std::max(0.0, largest_eigenvalue(stiffness, mass));
  return critical_time_step(damping.alpha + damping.beta * square, structure.stiffening() * square);
}

}  // namespace

std::optional<AddedRadii> needed_radii(double time_step, const Rayleigh& damping, double stiffening,
                                       std::span<const double> coordinates,
                                       std::span<const double> stiffness,
                                       std::span<const double> mass) {
  const std::size_t nodes = coordinates.size() / 3;
  const std::size_t n = 3 * nodes;
  const double dt = time_step * (1 + margin);
  const double a = 4 - 2 * dt * damping.alpha;
  const double b = dt * (2 * damping.beta + stiffening * dt);
  if (!(a > 0)) return std::nullopt;
  std::vector<double> held = part_of(stiffness, nodes, displacements, displacements);
  for (double& value : held) value *= -b;
  for (std::size_t i = 0; i < n; ++i) held[i * n + i] += a * mass[per_node * (i / 3) + i % 3];
  if (!invert_definite(held)) return std::nullopt;
  const std::vector<double> beside = part_of(stiffness, nodes, rotations, displacements);
  std::vector<double> missing = part_of(stiffness, nodes, rotations, rotations);
  const std::vector<double> through = product(product(beside, held, n, false), beside, n, true);
  for (std::size_t i = 0; i < n * n; ++i) missing[i] = b * missing[i] + b * b * through[i];
  for (std::size_t i = 0; i < n; ++i) {
    missing[i * n + i] -= a * mass[per_node * (i / 3) + rotations + i % 3];
  }
  std::vector<double> masses(nodes);
  for (std::size_t node = 0; node < nodes; ++node) masses[node] = a * mass[per_node * node];
  const Matrix3 frame = frame_about(normal_of(coordinates));
  const AddedRadii radii = split(turned(missing, frame, nodes), masses);
  if (!std::isfinite(radii.drilling)) return std::nullopt;
  return radii;
}

void add_radii(const AddedRadii& radii, std::span<const double> coordinates,
               std::span<double> mass) {
  const Vector3 normal = normal_of(coordinates);
  const double sum = std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]);
  for (std::size_t node = 0; node < coordinates.size() / 3; ++node) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double radius =
          radii.bending + (radii.drilling - radii.bending) * std::abs(normal[i]) * sum;
      mass[per_node * node + rotations + i] += mass[per_node * node] * radius;
    }
  }
}

AddedInertia::AddedInertia(const Structure& structure, const Mesh& mesh)
    : structure_(structure), mesh_(mesh) {
  if (structure.step_target) scaling_.inertia.assign(mesh.owned_dofs, 0.0);
}

bool AddedInertia::add(const ElementBlock& block, std::size_t element,
                       stiffness::ElementWork& work) {
  if (!is_shell(block.type) || !structure_.step_target || structure_.step_target->shells == 0) {
    return true;
  }
  const stiffness::ElementDofs dofs(mesh_, block, element);
  const std::size_t size = dofs.size();
  const std::span<const double> coordinates(work.coordinates.data(), size / 2);
  const auto radii =
      needed_radii(structure_.step_target->shells,
                   structure_.damping_of(structure_.regions[block.region]), structure_.stiffening(),
                   coordinates, {work.stiffness.data(), size * size}, {work.mass.data(), size});
  if (!radii) return false;
  if (radii->drilling == 0) return true;
  const double own = work.mass[rotations] / work.mass[displacements];
  scaling_.elements += block.counted[element];
  scaling_.bending = std::max(scaling_.bending, radii->bending / own);
  scaling_.drilling = std::max(scaling_.drilling, radii->drilling / own);
  const std::array<double, max_element_size> before = work.mass;
  add_radii(*radii, coordinates, {work.mass.data(), size});
  for (std::size_t i = 0; i < size; ++i) {
    if (dofs[i] >= 0 && dofs[i] < mesh_.owned_dofs) {
      scaling_.inertia[dofs[i]] += work.mass[i] - before[i];
    }
  }
  return true;
}

void AddedInertia::share(RotaryScaling& scaling) {
  scaling = std::move(scaling_);
  reduce_over_ranks(mesh_.comm, MPI_SUM, scaling.elements);
  reduce_over_ranks(mesh_.comm, MPI_MAX, scaling.bending, scaling.drilling);
}

StepPlan plan_step(const Structure& structure, const Mesh& mesh) {
  StepPlan plan;
  AddedInertia inertia(structure, mesh);
  stiffness::ElementWork work;
  std::vector<double> added;
  bool feasible = true;
  for (const ElementBlock& block : mesh.blocks) {
    const Region& region = structure.regions[block.region];
    const std::size_t size = element_layout(block.type).size();
    feasible = feasible && structure.mass_scaling * structure.damping_of(region).alpha < 2;
    for (std::size_t e = 0; feasible && e < block.count(); ++e) {
      const std::span<double> stiffness(work.stiffness.data(), size * size);
      const std::span<double> mass(work.mass.data(), size);
      stiffness::element_matrices_in(
          structure.numbers, block.type, gather_coordinates(mesh, block, e, work),
          element_properties(region, block.share_of(e)), stiffness, mass);
      if (is_shell(block.type)) {
        feasible = inertia.add(block, e, work);
      } else if (may_scale(structure, block.type)) {
        added.assign(size * size, 0.0);
        plan.largest_factor =
            std::max(plan.largest_factor,
                     add_element_mass(structure.mass_scaling, structure.damping_of(region),
                                      stiffness, mass, added, structure.stiffening()));
      } else if (*std::ranges::max_element(mass) > 0) {
        feasible = step_alone(structure, region, stiffness, mass) >= structure.mass_scaling;
      }
    }
  }
  RotaryScaling scaling;
  inertia.share(scaling);
  plan.inertia = std::move(scaling.inertia);
  plan.feasible = !on_any_rank(mesh.comm, !feasible);
  reduce_over_ranks(mesh.comm, MPI_MAX, plan.largest_factor);
  return plan;
}

}  // namespace pounding
