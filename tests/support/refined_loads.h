#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/element_graph.h"
#include "mesh/global_mesh.h"
#include "support/partition_loads.h"

namespace pounding::testing_support {

/// Parts of a mesh of equal cubes, of which every one is divided into k^3, k at least 2, without
/// that mesh: the cubes within one are of its part, and a new node belongs to the part of most of
/// the cubes around it. All nodes inside a cube, inside a face, or inside an edge between two nodes
/// of the undivided mesh have one owner: a cube's nodes, edges, faces and inside are the 3^3 points
/// of a lattice of half its edge. Serial.
class RefinedMesh {
 public:
  using Place = std::array<int, 3>;  ///< on the lattice: odd inside, even between cubes

  RefinedMesh(const GlobalMesh& mesh, int k) : mesh_(mesh), k_(k) {
    const ElementSet& cubes = mesh.regions.front();
    const auto first = cubes.nodes_of(0);
    double edge = 0;
    for (const GlobalIndex node : first) {
      edge = std::max(edge, mesh.position(node)[0] - mesh.position(first[0])[0]);
    }
    Vector3 low = mesh.position(0), high = low;
    for (GlobalIndex n = 0; n < mesh.node_count(); ++n) {
      for (std::size_t d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], mesh.position(n)[d]);
        high[d] = std::max(high[d], mesh.position(n)[d]);
      }
    }
    places_.resize(static_cast<std::size_t>(mesh.node_count()));
    for (GlobalIndex n = 0; n < mesh.node_count(); ++n) {
      for (std::size_t d = 0; d < 3; ++d) {
        places_[n][d] = 2 * static_cast<int>(std::lround((mesh.position(n)[d] - low[d]) / edge));
      }
    }
    for (std::size_t d = 0; d < 3; ++d) {
      size_[d] = 2 * static_cast<int>(std::lround((high[d] - low[d]) / edge)) + 1 + 2 * margin;
    }
    number_points(cubes);
  }

  /// Points of the lattice that are there, and the cubes at each of them.
  std::size_t count() const { return static_cast<std::size_t>(count_); }
  const Place& place_of(GlobalIndex node) const { return places_[node]; }

  /// Cubes at each point, point after point.
  void add_cubes(NodeElements& at, idx_t first_cube) const {
    const std::size_t begin = at.first.size() - 1;
    at.first.resize(begin + count() + 1, 0);
    const auto each = [&](const auto& visit) {
      for (std::size_t e = 0; e < cubes_.size(); ++e) {
        each_point(cubes_[e], [&](const Place& p) { visit(begin + numbers_[index(p)], e); });
      }
    };
    std::vector<std::size_t> next(count() + 1, 0);
    each([&](std::size_t point, std::size_t) { ++next[point - begin + 1]; });
    next.front() = at.first[begin];
    for (std::size_t p = 0; p < count(); ++p) next[p + 1] += next[p];
    std::copy(next.begin() + 1, next.end(), at.first.begin() + begin + 1);
    at.elements.resize(at.first.back());
    each([&](std::size_t point, std::size_t e) {
      at.elements[next[point - begin]++] = first_cube + static_cast<idx_t>(e);
    });
  }
  /// Owners of all points, in their order.
  void set_owners(std::span<const int> owners) {
    for (int& number : numbers_) number = number < 0 ? -1 : owners[number];
  }

  /// Part that owns the new nodes inside a point's cube, face or edge, or the node; -1: none.
  int owner(const Place& place) const { return numbers_[index(place)]; }
  /// Nodes there.
  std::int64_t nodes(const Place& place) const {
    std::int64_t nodes = 1;
    for (const int x : place) nodes *= x % 2 != 0 ? k_ - 1 : 1;
    return nodes;
  }

  /// Adds the loads of this mesh, exchanges apart. After `set_owners`.
  Exchange add_loads(std::vector<PartLoad>& loads) const {
    const std::int64_t cost = mesh_.regions.front().cost();
    for (const Place& cube : cubes_) count_cubes(cube, cost, loads);
    Exchange exchange;
    Place place{};
    for (place[2] = 0; place[2] < size_[2] - 2 * margin; ++place[2]) {
      for (place[1] = 0; place[1] < size_[1] - 2 * margin; ++place[1]) {
        for (place[0] = 0; place[0] < size_[0] - 2 * margin; ++place[0]) {
          if (owner(place) >= 0 && !held_[index(place)]) count_nodes(place, loads, exchange);
        }
      }
    }
    return exchange;
  }

 private:
  static constexpr int margin = 1;  ///< points on each side that are not there
  static constexpr int dofs = 3;    ///< of a node

  /// Nodes or cubes that follow each other along an axis: how far the cubes at them, or their nodes,
  /// reach on the lattice, and how many they are.
  struct Run {
    int low = 0;
    int high = 0;
    std::int64_t count = 1;
  };
  using Runs = std::array<Run, 3>;

  std::size_t index(const Place& p) const {
    return static_cast<std::size_t>(((p[2] + margin) * size_[1] + p[1] + margin) * size_[0] + p[0] +
                                    margin);
  }
  template <typename Visit>
  void each_point(const Place& cube, const Visit& visit) const {
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) visit(Place{cube[0] + x, cube[1] + y, cube[2] + z});
      }
    }
  }

  void number_points(const ElementSet& cubes) {
    const std::size_t all = static_cast<std::size_t>(size_[0]) * size_[1] * size_[2];
    numbers_.assign(all, -1);
    held_.assign(all, true);
    for (std::size_t e = 0; e < cubes.tags.size(); ++e) {
      Place cube = places_[cubes.nodes_of(e).front()];
      for (const GlobalIndex node : cubes.nodes_of(e)) {
        for (std::size_t d = 0; d < 3; ++d) cube[d] = std::min(cube[d], places_[node][d]);
      }
      for (int& x : cube) ++x;
      cubes_.push_back(cube);
      each_point(cube, [&](const Place& point) {
        int& number = numbers_[index(point)];
        if (number < 0) number = count_++;
      });
      // What lies between nodes of which one is free is free.
      for (const GlobalIndex node : cubes.nodes_of(e)) {
        if (mesh_.free_components[node] == 0) continue;
        const Place& free = places_[node];
        each_point(cube, [&](const Place& point) {
          bool beside = true;
          for (std::size_t d = 0; d < 3; ++d) beside = beside && std::abs(point[d] - free[d]) <= 1;
          if (beside) held_[index(point)] = false;
        });
      }
    }
  }

  std::array<Run, 3> cube_runs() const { return {{{-1, 0}, {0, 0, k_ - 2}, {0, 1}}}; }
  std::array<Run, 3> node_runs(int x) const {
    if (x % 2 == 0 || k_ == 2) return {{{-1, 1}, {0, 0, 0}, {0, 0, 0}}};
    return {{{-1, 0}, {0, 0, k_ - 3}, {0, 1}}};
  }

  /// Appends the owners of the points within [low, high] of a place.
  void find_owners(const Place& place, const Place& low, const Place& high,
                   std::vector<int>& owners) const {
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) {
          const int part = owner({place[0] + x, place[1] + y, place[2] + z});
          if (std::ranges::find(owners, part) == owners.end()) owners.push_back(part);
        }
      }
    }
  }
  bool alone(const Place& place) const {
    const int own = owner(place);
    bool alone = true;
    each_point(place, [&](const Place& p) { alone = alone && owner(p) == own; });
    return alone;
  }

  void count_cubes(const Place& cube, std::int64_t cost, std::vector<PartLoad>& loads) const {
    std::vector<int> owners;
    const std::array<Run, 3> runs = cube_runs();
    for (int i = 0; i < 27; ++i) {
      const Runs r{runs[i % 3], runs[i / 3 % 3], runs[i / 9]};
      const std::int64_t count = r[0].count * r[1].count * r[2].count;
      if (count == 0) continue;
      owners.clear();
      find_owners(cube, {r[0].low, r[1].low, r[2].low}, {r[0].high, r[1].high, r[2].high}, owners);
      for (const int part : owners) {
        loads[part].elements += count;
        loads[part].cost += count * cost;
        if (owners.size() == 1) loads[part].inner += count;
      }
    }
  }

  void count_nodes(const Place& place, std::vector<PartLoad>& loads, Exchange& exchange) const {
    const int own = owner(place);
    loads[own].dofs += dofs * nodes(place);
    if (alone(place)) return;
    const std::array runs{node_runs(place[0]), node_runs(place[1]), node_runs(place[2])};
    std::vector<int> owners;
    std::map<int, std::int64_t> sent;
    for (int i = 0; i < 27; ++i) {
      const Runs r{runs[0][i % 3], runs[1][i / 3 % 3], runs[2][i / 9]};
      const std::int64_t count = r[0].count * r[1].count * r[2].count;
      if (count == 0) continue;
      owners.assign(1, own);
      for (int octant = 0; octant < 8; ++octant) find_beside(place, r, octant, owners);
      for (std::size_t o = 1; o < owners.size(); ++o) sent[owners[o]] += dofs * count;
    }
    for (const auto& [part, count] : sent) exchange[{own, part}] += count;
  }
  /// Owners of the nodes of the small cube in one of the eight directions from a node.
  void find_beside(const Place& place, const Runs& runs, int octant,
                   std::vector<int>& owners) const {
    Place low{}, high{}, cube = place;
    for (std::size_t d = 0; d < 3; ++d) {
      const bool up = (octant >> d & 1) != 0;
      (up ? high : low)[d] = up ? runs[d].high : runs[d].low;
      if (place[d] % 2 == 0) cube[d] += up ? 1 : -1;
    }
    if (owner(cube) >= 0) find_owners(place, low, high, owners);
  }

  const GlobalMesh& mesh_;
  int k_;
  std::vector<Place> places_;  ///< of the mesh's nodes
  std::vector<Place> cubes_;
  Place size_{};              ///< of the lattice, margins included
  std::vector<int> numbers_;  ///< of points, then their owners; -1: not there
  std::vector<bool> held_;    ///< no node there is free
  int count_ = 0;
};

/// The meshes of a partition with their cubes divided, owners set.
inline std::vector<RefinedMesh> refined_meshes(std::span<const GlobalMesh> meshes,
                                               const Partition& partition, int k) {
  std::vector<RefinedMesh> refined;
  NodeElements at{{0}, {}};
  std::vector<idx_t> owner;
  std::vector<idx_t> cost;
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    refined.emplace_back(meshes[s], k).add_cubes(at, static_cast<idx_t>(owner.size()));
    const std::vector<int>& owners = partition.element_owner[s];
    owner.insert(owner.end(), owners.begin(), owners.end());
    cost.resize(owner.size(), meshes[s].regions.front().cost());
  }
  const std::vector<int> owners = node_owners(at, owner, cost, partition.parts);
  std::size_t first = 0;
  for (RefinedMesh& mesh : refined) {
    mesh.set_owners(std::span(owners).subspan(first, mesh.count()));
    first += mesh.count();
  }
  return refined;
}

/// Loads of the parts of those meshes, as `part_loads`.
inline std::vector<PartLoad> refined_loads(std::span<const RefinedMesh> meshes, int parts,
                                           int cores) {
  std::vector<PartLoad> loads(static_cast<std::size_t>(parts));
  std::vector<Exchange> structures;
  for (const RefinedMesh& mesh : meshes) structures.push_back(mesh.add_loads(loads));
  add_exchange(structures, cores, loads);
  return loads;
}

}  // namespace pounding::testing_support
