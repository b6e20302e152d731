#include "mesh/pool_water.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "common/error.h"
#include "common/facts.h"
#include "elements/rigid_tank.h"
#include "mesh/facet_point.h"
#include "scene/pool_reader.h"

namespace pounding {
namespace {

/// Share of each node in an area [m2], or in a mass [-].
using Shares = std::map<GlobalIndex, double>;

/// Floor or wall of a tank.
struct Side {
  Shares wetted;    ///< of facets that are under the water's surface, or cut by it
  double area = 0;  ///< of all of it [m2]
  double top = -1e300;
};

/// Water of one pool.
class Water {
 public:
  Water(const Structure& structure, const Pool& pool, GlobalMesh& mesh)
      : structure_(structure), pool_(pool), mesh_(mesh) {
    find_box();
    for (const std::string& group : pool.faces) sort_facets(mesh.groups.at(group).facets);
    check_sides();
    tank_ = {pool_.water_along(0), pool_.water_along(1)};
  }

  const PoolOutline& outline() const { return pool_.outline; }

  /// The elements of its region `number` of the structure, one after the other.
  void add(const WaterRegion& water, int number) {
    set_ = {};
    set_.group = structure_.regions[static_cast<std::size_t>(number)].group;
    set_.region = number;
    set_.type = structure_.regions[static_cast<std::size_t>(number)].element;
    switch (water.part) {
      case WaterPart::impulsive:
        add_impulsive(water.direction);
        break;
      case WaterPart::convective:
        add_convective(water.direction);
        break;
      case WaterPart::wave:
        add_springs(water.direction, water.mode);
        break;
      case WaterPart::dashpot:
        add_dashpots(water.direction, water.mode);
    }
    mesh_.regions.push_back(std::move(set_));
  }

 private:
  [[noreturn]] void refuse_faces(const std::string& why) const {
    std::string faces;
    for (const std::string& group : pool_.faces) faces += (faces.empty() ? "" : ",") + group;
    throw UserError("option -" + pool_.name + "_faces " + faces + ": " + why);
  }
  [[noreturn]] void refuse_level(const std::string& why) const {
    throw UserError("option -" + pool_.name + "_level " + number_text(pool_.level) + ": " + why);
  }

  /// Box around the faces; its lowest part is the floor.
  void find_box() {
    for (const std::string& group : pool_.faces) {
      const auto found = mesh_.groups.find(group);
      if (found == mesh_.groups.end() || found->second.facets.empty()) {
        refuse_faces("no element of the scene uses faces of a group '" + group + "' of " +
                     structure_.mesh + ", which has: " + group_names(mesh_));
      }
      for (const GlobalIndex node : found->second.nodes) box_.include(mesh_.position(node));
    }
    PoolOutline& outline = pool_.outline;
    outline.corner = box_.low;
    outline.sides = {box_.sides()[0], box_.sides()[1]};
    outline.depth = pool_.level - box_.low[2];
    outline.volume = outline.sides[0] * outline.sides[1] * outline.depth;
    if (!(outline.depth > 0)) {
      refuse_level("the floor is at z = " + number_text(box_.low[2]) +
                   " m: there is no water; leave the pool out of -pools");
    }
  }

  double tolerance() const { return 1e-6 * box_.diagonal(); }

  static std::string number_text(double value) { return sentence("{}", {value}); }

  void sort_facets(const std::vector<Facet>& facets) {
    for (const Facet& facet : facets) {
      if (facet.count < 3) continue;
      Side* const side = side_of(facet);
      if (side == nullptr) {
        refuse_faces("the facet at " + place_text(mesh_.position(facet.nodes[0])) +
                     " lies neither on a level floor nor on one of four walls along x and "
                     "y: the tank is no rectangle");
      }
      const bool wetted = std::ranges::any_of(
          facet.corners(), [&](GlobalIndex node) { return height_of(node) < 1 - 1e-9; });
      const std::array<double, 4> shares = facet_shares(mesh_, facet);
      for (std::size_t a = 0; a < facet.corners().size(); ++a) {
        side->area += shares[a];
        side->top = std::max(side->top, mesh_.position(facet.nodes[a])[2]);
        if (wetted) side->wetted[facet.nodes[a]] += shares[a];
      }
    }
  }

  /// The floor (4), or the wall at the low or high end of x (0, 1) or y (2, 3); null: no side.
  Side* side_of(const Facet& facet) {
    const auto lies_at = [&](std::size_t axis, double place) {
      return std::ranges::all_of(facet.corners(), [&](GlobalIndex node) {
        return std::abs(mesh_.position(node)[axis] - place) <= tolerance();
      });
    };
    if (lies_at(2, box_.low[2])) return &sides_[4];
    for (std::size_t side = 0; side < 4; ++side) {
      if (lies_at(side / 2, (side % 2 == 0 ? box_.low : box_.high)[side / 2])) return &sides_[side];
    }
    return nullptr;
  }

  void check_sides() {
    double lowest = box_.high[2];
    for (std::size_t side = 0; side < sides_.size(); ++side) {
      const auto& [wetted, area, top] = sides_[side];
      const bool floor = side == 4;
      const std::array<double, 2>& plan = pool_.outline.sides;
      const double whole = floor ? plan[0] * plan[1] : plan[1 - side / 2] * (top - box_.low[2]);
      const std::string name =
          floor ? "the floor"
                : std::string("the wall at ") + direction_names[side / 2] + " = " +
                      number_text((side % 2 == 0 ? box_.low : box_.high)[side / 2]) + " m";
      if (area == 0) refuse_faces(name + " has none: the tank is open there");
      if (std::abs(area - whole) > 1e-6 * whole) {
        refuse_faces(name + " has " + number_text(area) + " m2, and as a rectangle it has " +
                     number_text(whole) + " m2");
      }
      if (!floor) lowest = std::min(lowest, top);
    }
    if (pool_.level > lowest + tolerance()) {
      refuse_level("the lowest top of its walls is at z = " + number_text(lowest) + " m");
    }
    pool_.outline.freeboard = pool_.freeboard.value_or(std::max(0.0, lowest - pool_.level));
  }

  /// Height of a node over the floor, over the depth.
  double height_of(GlobalIndex node) const {
    return (mesh_.position(node)[2] - box_.low[2]) / pool_.outline.depth;
  }

  /// Weights of a wall's nodes that add up to 1/2 at a mean height: those of `profile` by the
  /// height, times area, bent linearly over the height. Empty where that makes one negative.
  template <typename Profile>
  Shares weights(const Shares& wall, double mean, Profile&& profile) const {
    std::array<double, 3> moments{};
    Shares found;
    for (const auto& [node, share] : wall) {
      const double z = height_of(node);
      const double weight = share * profile(z);
      if (!(weight > 0)) continue;
      found[node] = weight;
      for (std::size_t k = 0; k < 3; ++k) {
        moments[k] += weight * std::pow(z - mean, static_cast<double>(k));
      }
    }
    const double spread = moments[0] * moments[2] - moments[1] * moments[1];
    const bool level = spread <= 1e-12 * moments[0] * moments[0];
    if (level && std::abs(moments[1]) > 1e-6 * moments[0]) return {};
    const double even = level ? 0.5 / moments[0] : 0.5 * moments[2] / spread;
    const double slope = level ? 0 : -0.5 * moments[1] / spread;
    for (auto& [node, weight] : found) {
      weight *= even + slope * (height_of(node) - mean);
      if (weight < 0) return {};
    }
    return found;
  }

  /// Both walls across a direction.
  template <typename Profile>
  Shares of_walls(std::size_t direction, double mean, Profile&& profile) const {
    Shares all;
    for (const std::size_t end : {0, 1}) {
      const Shares one = weights(sides_[2 * direction + end].wetted, mean, profile);
      if (one.empty()) return {};
      for (const auto& [node, weight] : one) all[node] += weight;
    }
    return all;
  }

  [[noreturn]] void refuse_coarse(std::size_t direction) const {
    refuse_level(std::string("the walls across ") + direction_names[direction] +
                 " have too few rows of nodes below it to carry the water at its heights; "
                 "mesh them finer");
  }

  void add_impulsive(std::size_t direction) {
    Shares shares = sides_[4].wetted;
    if (direction < 2) {
      const double length = pool_.outline.sides[direction];
      shares = of_walls(direction, tank_[direction].impulsive.height, [&](double z) {
        return impulsive_pressure(z, pool_.outline.depth, length);
      });
      if (shares.empty()) refuse_coarse(direction);
    } else {
      const double area = pool_.outline.sides[0] * pool_.outline.sides[1];
      for (auto& [node, share] : shares) share /= area;
    }
    for (const auto& [node, share] : shares) add_element({node}, share);
  }

  /// Nodes of the waves, at a quarter of the length, where none lies on another.
  void add_convective(std::size_t direction) {
    first_wave_ = mesh_.node_count();
    for (const WaterMass& wave : tank_[direction].convective) {
      const GlobalIndex node = mesh_.node_count();
      const PoolOutline& outline = pool_.outline;
      Vector3 x = outline.corner;
      for (const std::size_t d : {0, 1}) x[d] += outline.sides[d] / (d == direction ? 4 : 2);
      x[2] += wave.height * outline.depth;
      mesh_.coordinates.insert(mesh_.coordinates.end(), x.begin(), x.end());
      mesh_.node_tags.push_back(mesh_.node_tags.back() + 1);
      mesh_.components.push_back(static_cast<std::uint8_t>(1U << direction));
      mesh_.free_components.push_back(mesh_.components.back());
      add_element({node}, wave.mass);
    }
  }

  /// Springs to the nodes of the walls around the height of a wave, so close to it that they hold
  /// the walls hardly against turning.
  void add_springs(std::size_t direction, int mode) {
    const double height = tank_[direction].convective[static_cast<std::size_t>(mode)].height;
    Shares shares;
    for (double reach = 1.0 / 64; shares.empty(); reach *= 2) {
      if (reach > 4) refuse_coarse(direction);
      shares = of_walls(direction, height, [&](double z) { return reach - std::abs(z - height); });
    }
    for (const auto& [node, share] : shares) add_element({first_wave_ + mode, node}, share);
  }

  /// Dashpots to the nearest node of each wall.
  void add_dashpots(std::size_t direction, int mode) {
    const GlobalIndex wave = first_wave_ + mode;
    for (const std::size_t end : {0, 1}) {
      const Shares& wall = sides_[2 * direction + end].wetted;
      const auto nearest = std::ranges::min_element(wall, {}, [&](const auto& node) {
        return std::round(distance(mesh_.position(node.first), mesh_.position(wave)) / tolerance());
      });
      add_element({wave, nearest->first}, 0.5);
    }
  }

  void add_element(std::initializer_list<GlobalIndex> nodes, double share) {
    set_.tags.push_back(mesh_.node_tags[static_cast<std::size_t>(*(nodes.end() - 1))]);
    set_.connectivity.insert(set_.connectivity.end(), nodes);
    set_.share.push_back(share);
  }

  const Structure& structure_;
  Pool pool_;
  GlobalMesh& mesh_;
  BoundingBox box_;
  std::array<Side, 5> sides_;
  std::array<TankWater, 2> tank_;
  ElementSet set_;              ///< at hand
  GlobalIndex first_wave_ = 0;  ///< node of the first wave of a direction
};

}  // namespace

void add_pools(const Structure& structure, GlobalMesh& mesh) {
  const auto first = std::ranges::find(structure.regions, true, &Region::of_water);
  auto number = static_cast<int>(first - structure.regions.begin());
  auto body = mesh.water.begin();
  for (const Pool& pool : structure.pools) {
    if (!pool.is_tank()) {
      mesh.pools.push_back(body++->outline);
      continue;
    }
    Water water(structure, pool, mesh);
    for (const WaterRegion& region : water_regions(pool)) water.add(region, number++);
    mesh.pools.push_back(water.outline());
  }
}

}  // namespace pounding
