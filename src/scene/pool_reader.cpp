#include "scene/pool_reader.h"

#include <algorithm>
#include <numbers>

#include "elements/rigid_tank.h"

namespace pounding {
namespace {

Region region_of(const Pool& pool, const WaterRegion& water) {
  Region region;
  const std::string direction = direction_names[water.direction];
  region.of_water = true;
  const bool is_mass = water.part == WaterPart::impulsive || water.part == WaterPart::convective;
  region.element = is_mass ? ElementType::point_mass : ElementType::spring;
  region.mass_along = {};
  region.mass_along[water.direction] = 1;
  switch (water.part) {
    case WaterPart::impulsive:
      region.group = pool.name + " along " + direction;
      break;
    case WaterPart::convective:
      region.group = pool.name + " waves along " + direction;
      break;
    case WaterPart::wave:
    case WaterPart::dashpot:
      region.group = pool.name + (water.part == WaterPart::wave ? " wave " : " dashpot ") +
                     std::to_string(2 * water.mode + 1) + direction;
  }
  return region;
}

/// Damping ratio that a wave has of its structure's damping: in modes a factor takes that away.
double ratio_of_structure(const Structure& structure, double omega) {
  if (structure.uniform_damping) return structure.uniform_damping->ratio_at(omega);
  return structure.modal ? 0 : structure.damping.beta * omega / 2;
}

/// Stiffness [1/s2] per mass of a spring on which it swings at omega: uniform damping leaves less
/// of it for slow motions.
double spring_of(const Structure& structure, double omega) {
  double without = omega;
  for (int i = 0; structure.uniform_damping && i < 20; ++i) {
    const double turns = 2 * std::numbers::pi;
    without *= omega / (turns * structure.uniform_damping->moved(without / turns));
  }
  return without * without;
}

/// Takes the damping of the structure off the masses of waves at full order, and off their modes.
void spare(const Structure& structure, WaterPart part, Region& region) {
  const Rayleigh& own = structure.damping;
  if (structure.modal) {
    if (part == WaterPart::wave && !structure.uniform_damping) region.damping_factor = 0;
  } else if (part == WaterPart::convective && own.alpha > 0) {
    region.damping = {0, own.beta};
  }
}

/// Refuses options beside which the added mass of water with cells would be left out.
void refuse_beside_cells(const OptionReader& options, const Pool& pool,
                         const Structure& structure) {
  const std::string prefix = "-" + structure.name + "_";
  const bool by_alpha =
      structure.modal && structure.damping.alpha > 0 && structure.modal->damping_ratios.empty();
  const bool starts =
      structure.modal && (structure.starts_in_motion() || structure.starts_displaced());
  const std::string other = starts                       ? "model modal and a start of its own"
                            : structure.step_target      ? "time_step_target"
                            : structure.mass_scaling > 0 ? "mass_scaling"
                            : structure.switched         ? "model switched"
                            : by_alpha                   ? "damping_alpha of a structure in modes"
                                                         : "";
  if (other.empty()) return;
  options.refuse("<pool>_water", {pool.name},
                 "not with " + prefix + other + ", which leaves the mass of the water out");
}

}  // namespace

std::vector<WaterRegion> water_regions(const Pool& pool) {
  std::vector<WaterRegion> regions;
  if (!pool.is_tank()) return regions;
  for (const std::size_t d : {0, 1, 2}) regions.push_back({WaterPart::impulsive, d});
  for (const std::size_t d : {0, 1}) {
    regions.push_back({WaterPart::convective, d});
    for (int n = 0; n < pool.modes; ++n) {
      regions.push_back({WaterPart::wave, d, n});
      regions.push_back({WaterPart::dashpot, d, n});
    }
  }
  return regions;
}

std::vector<Pool> read_pools(OptionReader& options, std::span<const std::string> names) {
  std::vector<Pool> pools(names.size());
  for (std::size_t p = 0; p < names.size(); ++p) {
    pools[p].name = names[p];
    options.read(pools[p], {names[p]});
  }
  return pools;
}

void take_pools(const OptionReader& options, std::span<const Pool> pools, Structure& structure) {
  for (const Pool& pool : pools) {
    if (pool.structure != structure.name) continue;
    const OptionReader::Names names{pool.name};
    options.refuse_if(!structure.matrices.empty(), "<pool>_structure", names,
                      "not with -" + structure.name +
                          "_matrices; write the water into the matrices and leave the pool out");
    if (!pool.is_tank()) refuse_beside_cells(options, pool, structure);
    options.refuse_if(pool.is_tank() && structure.switched && structure.damping.alpha > 0,
                      "<pool>_structure", names,
                      "in modes the damping alpha would brake its waves; not with -" +
                          structure.name + "_model switched; give beta or damping_uniform");
    options.refuse_if(
        pool.is_tank() && structure.uniform_damping && structure.uniform_damping->reference == 0,
        "<pool>_structure", names,
        "the first mode is a wave now; give -" + structure.name +
            "_damping_reference, the frequency of one of its own");
    std::vector<std::string> groups = pool.faces;
    std::ranges::sort(groups);
    const auto twice = std::ranges::adjacent_find(groups);
    if (twice != groups.end()) {
      options.refuse("<pool>_faces", names, "group '" + *twice + "' is listed twice");
    }
    for (const WaterRegion& water : water_regions(pool)) {
      structure.regions.push_back(region_of(pool, water));
    }
    structure.pools.push_back(pool);
  }
}

double wave_damping(const Structure& structure, const Pool& pool, double omega) {
  return std::max(pool.damping, ratio_of_structure(structure, omega));
}

void fill_pools(std::span<const PoolOutline> outlines, Structure& structure) {
  auto region = std::ranges::find(structure.regions, true, &Region::of_water);
  for (std::size_t p = 0; p < structure.pools.size(); ++p) {
    Pool& pool = structure.pools[p];
    pool.outline = outlines[p];
    const double mass = pool.density * pool.outline.volume;
    for (const auto& [part, direction, n] : water_regions(pool)) {
      Region& water = *region++;
      water.mass = mass;
      if (direction == 2) continue;
      const TankWater tank = pool.water_along(direction);
      if (part == WaterPart::impulsive) water.mass *= tank.impulsive.mass;
      spare(structure, part, water);
      if (part == WaterPart::impulsive || part == WaterPart::convective) continue;
      const WaterMass& wave = tank.convective[static_cast<std::size_t>(n)];
      const double omega = wave.circular_frequency;
      const double ratio =
          wave_damping(structure, pool, omega) - ratio_of_structure(structure, omega);
      water.mass = 0;
      if (part == WaterPart::wave) {
        water.stiffness[direction] = mass * wave.mass * spring_of(structure, omega);
      } else {
        water.dashpot[direction] = 2 * ratio * mass * wave.mass * omega;
      }
    }
  }
}

}  // namespace pounding
