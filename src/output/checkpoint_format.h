#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "system/linear_system.h"

/// Names that writer and reader of a checkpoint share; the format is described in
/// output/checkpoint.h.
namespace pounding::checkpoint_format {

inline constexpr const char* name = "pounding checkpoint";

/// The group of a structure.
inline std::string folder(const Mesh& mesh) {
  return "structures/" + mesh.structure;
}

inline GlobalIndex element_count(const Mesh& mesh) {
  GlobalIndex count = 0;
  for (const ElementBlock& block : mesh.blocks) count += block.global_count;
  return count;
}

/// Mark in which bases of generalised coordinates differ, per coordinate [kg^-1/2]: a sum of its
/// rows and participation factors with weights of their own. Owned dofs.
std::vector<double> basis_check(const LinearSystem& system);

/// Largest part of the largest value by which such numbers of one basis may differ.
inline constexpr double basis_tolerance = 1e-6;

/// `work`, whose failures become UserErrors that begin with `prefix`; both must outlive it.
std::function<void()> for_user(const std::string& prefix, const std::function<void()>& work);

/// Positions of the owned nodes [m], shape (owned_nodes, 3).
inline std::span<const double> owned_coordinates(const Mesh& mesh) {
  return std::span(mesh.coordinates).first(3 * static_cast<std::size_t>(mesh.owned_nodes));
}

}  // namespace pounding::checkpoint_format
