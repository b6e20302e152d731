#include "driver/soil_report.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numbers>

#include <nlohmann/json.hpp>

#include "common/component_names.h"

namespace pounding {
namespace {

const Foundation& foundation_under(const Structure& structure) {
  return *std::ranges::find(structure.regions, ElementType::soil, &Region::element)->foundation;
}

/// Groups through which waves leave.
std::vector<std::string> groups_of(const Structure& structure, bool base_only) {
  std::vector<std::string> groups;
  for (const AbsorbingFace& face : structure.absorbing) {
    if (face.is_base || !base_only) groups.push_back(face.group);
  }
  return groups;
}

}  // namespace

void print_absorbing(const Structure& structure, const interactions::AbsorbingReport& report) {
  if (structure.absorbing.empty()) return;
  std::printf("  absorbing faces:");
  for (const std::string& group : groups_of(structure, false)) std::printf(" %s", group.c_str());
  std::printf(", %lld nodes, %.6g m2\n", static_cast<long long>(report.nodes), report.area);
  if (!structure.is_driven_from_below()) return;
  std::printf("    the motion enters through");
  for (const std::string& group : groups_of(structure, true)) std::printf(" %s", group.c_str());
  std::printf(", %.6g m2\n", report.base_area);
}

nlohmann::ordered_json describe_absorbing(const Structure& structure,
                                          const interactions::AbsorbingReport& report) {
  return {{"groups", groups_of(structure, false)},
          {"base", groups_of(structure, true)},
          {"nodes", report.nodes},
          {"area", report.area},
          {"base_area", report.base_area}};
}

std::vector<SpreadReport> find_spread_springs(const Structure& structure, const GlobalMesh& mesh) {
  std::vector<SpreadReport> found;
  for (const ElementSet& set : mesh.regions) {
    if (set.share.empty()) continue;
    SpreadReport& report = found.emplace_back();
    report.region = &structure.regions[set.region];
    report.nodes = static_cast<std::int64_t>(set.tags.size());
    for (const double share : set.share) report.extent += share;
  }
  return found;
}

void print_spread_springs(std::span<const SpreadReport> groups) {
  for (const SpreadReport& group : groups) {
    const Region& region = *group.region;
    const auto print = [&](const char* what, const auto& along, const char* unit) {
      if (along[0] == 0 && along[1] == 0 && along[2] == 0) return;
      std::printf("  %s of %s, %lld nodes, spread over %.6g %s: %.4g, %.4g, %.4g %s in all\n", what,
                  region.group.c_str(), static_cast<long long>(group.nodes), group.extent,
                  region.spread == Spread::area ? "m2" : "m", group.extent * along[0],
                  group.extent * along[1], group.extent * along[2], unit);
    };
    print("springs", region.stiffness, "N/m");
    print("dashpots", region.dashpot, "N s/m");
  }
}

nlohmann::ordered_json describe_spread_springs(std::span<const SpreadReport> groups) {
  nlohmann::ordered_json description = nlohmann::ordered_json::array();
  for (const SpreadReport& group : groups) {
    const Region& region = *group.region;
    nlohmann::ordered_json& of = description.emplace_back(
        nlohmann::ordered_json{{"group", region.group}, {"nodes", group.nodes}});
    of[region.spread == Spread::area ? "area" : "length"] = group.extent;
    for (std::size_t d = 0; d < 3; ++d) {
      of["stiffness"].push_back(group.extent * region.stiffness[d]);
      of["dashpot"].push_back(group.extent * region.dashpot[d]);
    }
  }
  return description;
}

double largest_soil_frequency(const Soil& soil, const Foundation& foundation) {
  return largest_a0 * soil.ground.shear_velocity /
         (2 * std::numbers::pi * foundation.footprint.half_width());
}

void print_soil(const Structure& structure) {
  if (!structure.soil) return;
  const Soil& soil = *structure.soil;
  const Foundation& foundation = foundation_under(structure);
  const Footprint& footprint = foundation.footprint;
  std::printf("  soil under %s: ", soil.mat.c_str());
  if (footprint.disk) {
    std::printf("disk of %.4g m", footprint.sides[0]);
  } else {
    std::printf("rectangle of %.4g x %.4g m, %.4g m below the surface", footprint.sides[0],
                footprint.sides[1], footprint.embedment);
  }
  const Vector3& x = foundation.centre;
  std::printf(", its middle at (%.6g, %.6g, %.6g)\n", x[0], x[1], x[2]);
  std::printf(
      "    V_s %.4g m/s, %.4g kg/m3, Poisson's ratio %.4g; holds up to a0 = %.0f, %.3g Hz\n",
      soil.ground.shear_velocity, soil.ground.density, soil.ground.poisson, largest_a0,
      largest_soil_frequency(soil, foundation));
  std::printf("    %-4s %12s %12s %14s %14s %12s\n", "", "stiffness", "dashpot", "inner dashpot",
              "inner mass", "moving mass");
  for (std::size_t c = 0; c < foundation.impedances.size(); ++c) {
    const Impedance& mode = foundation.impedances[c];
    std::printf("    %-4s %12.4e %12.4e %14.4e %14.4e %12.4e\n", motion_names[c].data(),
                mode.stiffness, mode.dashpot, mode.inner_dashpot, mode.inner_mass, mode.mass);
  }
}

nlohmann::ordered_json describe_soil(const Structure& structure) {
  const Soil& soil = *structure.soil;
  const Foundation& foundation = foundation_under(structure);
  nlohmann::ordered_json description{
      {"mat", soil.mat},
      {"shape", foundation.footprint.disk ? "disk" : "rectangle"},
      {"size", foundation.footprint.sides},
      {"embedment", foundation.footprint.embedment},
      {"centre", foundation.centre},
      {"largest_frequency", largest_soil_frequency(soil, foundation)},
      {"frequency_dependence", soil.frequency_dependence}};
  for (const Impedance& mode : foundation.impedances) {
    description["stiffness"].push_back(mode.stiffness);
    description["dashpot"].push_back(mode.dashpot);
    description["inner_dashpot"].push_back(mode.inner_dashpot);
    description["inner_mass"].push_back(mode.inner_mass);
    description["moving_mass"].push_back(mode.mass);
  }
  return description;
}

}  // namespace pounding
