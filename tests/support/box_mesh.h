#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding::testing_support {

/// A brick of nx x ny x nz hexahedra with the groups "body", "x_min", "x_max", ... "z_max".
inline GlobalMesh box_mesh(Vector3 origin, Vector3 size, std::array<int, 3> cells,
                           ElementType type = ElementType::hex8) {
  GlobalMesh mesh;
  const auto [nx, ny, nz] = cells;
  const auto node = [&](int i, int j, int k) {
    return static_cast<GlobalIndex>((k * (ny + 1) + j) * (nx + 1) + i);
  };
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        mesh.node_tags.push_back(node(i, j, k) + 1);
        mesh.coordinates.insert(mesh.coordinates.end(),
                                {origin[0] + size[0] * i / nx, origin[1] + size[1] * j / ny,
                                 origin[2] + size[2] * k / nz});
      }
    }
  }
  ElementSet set;
  set.group = "body";
  set.type = type;
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        set.tags.push_back(static_cast<std::int64_t>(set.tags.size()) + 1);
        for (int top = 0; top < 2; ++top) {
          set.connectivity.insert(set.connectivity.end(),
                                  {node(i, j, k + top), node(i + 1, j, k + top),
                                   node(i + 1, j + 1, k + top), node(i, j + 1, k + top)});
        }
      }
    }
  }
  mesh.regions.push_back(std::move(set));
  const auto add_facet = [&](const std::string& group, std::array<GlobalIndex, 4> nodes) {
    Facet facet;
    facet.nodes = nodes;
    facet.count = 4;
    mesh.groups[group].facets.push_back(facet);
    mesh.groups[group].nodes.insert(mesh.groups[group].nodes.end(), nodes.begin(), nodes.end());
  };
  for (int side = 0; side < 2; ++side) {
    for (int a = 0; a < ny; ++a) {
      for (int b = 0; b < nz; ++b) {
        const int i = side * nx;
        add_facet(side == 0 ? "x_min" : "x_max",
                  {node(i, a, b), node(i, a + 1, b), node(i, a + 1, b + 1), node(i, a, b + 1)});
      }
    }
    for (int a = 0; a < nx; ++a) {
      for (int b = 0; b < ny; ++b) {
        const int k = side * nz;
        add_facet(side == 0 ? "z_min" : "z_max",
                  {node(a, b, k), node(a + 1, b, k), node(a + 1, b + 1, k), node(a, b + 1, k)});
      }
    }
  }
  for (auto& [name, group] : mesh.groups) {
    std::sort(group.nodes.begin(), group.nodes.end());
    group.nodes.erase(std::unique(group.nodes.begin(), group.nodes.end()), group.nodes.end());
  }
  mesh.components.assign(mesh.node_tags.size(), 0x07);
  mesh.free_components = mesh.components;
  return mesh;
}

inline void clamp(GlobalMesh& mesh, const std::string& group) {
  for (const GlobalIndex node : mesh.groups.at(group).nodes) {
    mesh.free_components[static_cast<std::size_t>(node)] = 0;
  }
}

/// A structure with one region "body" of the given material.
inline Structure solid_structure(const std::string& name, double young, double poisson,
                                 double density, ElementType type = ElementType::hex8) {
  Structure structure;
  structure.name = name;
  Region region;
  region.group = "body";
  region.element = type;
  region.material = {"solid", young, poisson, density};
  structure.regions.push_back(region);
  return structure;
}

}  // namespace pounding::testing_support
