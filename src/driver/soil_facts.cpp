#include <algorithm>
#include <array>
#include <numbers>

#include "common/component_names.h"
#include "driver/subject_facts.h"
#include "scene/soil_file.h"

namespace pounding {
namespace {

/// Groups through which waves leave.
std::vector<std::string> groups_of(const Structure& structure, bool base_only) {
  std::vector<std::string> groups;
  for (const AbsorbingFace& face : structure.absorbing) {
    if (face.is_base || !base_only) groups.push_back(face.group);
  }
  return groups;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += " " + name;
  return text;
}

/// Sums along x, y and z of springs or dashpots that are spread over a group.
std::array<double, 3> sums_of(const SpreadReport& group, const std::array<double, 6>& spread) {
  return {group.extent * spread[0], group.extent * spread[1], group.extent * spread[2]};
}

/// Frequency of a0 = 2, up to which the impedances of a mat's soil are meant to hold [Hz].
double largest_soil_frequency(const Soil& soil, const Foundation& foundation) {
  return largest_a0 * soil.ground.shear_velocity /
         (2 * std::numbers::pi * foundation.footprint.half_width());
}

/// Soil of a half-space.
Facts half_space_facts(const Soil& soil, const Foundation& foundation) {
  const bool disk = foundation.footprint.disk;
  Facts facts{{{"mat", soil.mat},
               {"shape", disk ? "disk" : "rectangle"},
               {"size", foundation.footprint.sides},
               {"embedment", foundation.footprint.embedment},
               {"centre", foundation.centre},
               {"largest_frequency", largest_soil_frequency(soil, foundation)},
               {"frequency_dependence", soil.frequency_dependence}}};
  facts.say(disk ? "  soil under {mat}: disk of {size/0:.4g} m"
                 : "  soil under {mat}: rectangle of {size/0:.4g} x {size/1:.4g} m, "
                   "{embedment:.4g} m below the surface");
  facts.say(
      ", its middle at {centre:.6g}\n"
      "    V_s {:.4g} m/s, {:.4g} kg/m3, Poisson's ratio {:.4g}; holds up to a0 = {:.0f}, "
      "{largest_frequency:.3g} Hz\n"
      "            stiffness      dashpot  inner dashpot     inner mass  moving mass\n",
      {soil.ground.shear_velocity, soil.ground.density, soil.ground.poisson, largest_a0});
  for (std::size_t c = 0; c < foundation.impedances.size(); ++c) {
    const Impedance& mode = foundation.impedances[c].impedance;
    facts.values["stiffness"].push_back(mode.stiffness);
    facts.values["dashpot"].push_back(mode.dashpot);
    facts.values["inner_dashpot"].push_back(mode.inner_dashpot);
    facts.values["inner_mass"].push_back(mode.inner_mass);
    facts.values["moving_mass"].push_back(mode.mass);
    facts.say("    {:-4s} {:12.4e} {:12.4e} {:14.4e} {:14.4e} {:12.4e}\n",
              {motion_names[c], mode.stiffness, mode.dashpot, mode.inner_dashpot, mode.inner_mass,
               mode.mass});
  }
  return facts;
}

/// Springs, dashpots and masses of a file of soil.
Facts fit_facts(const Soil& soil, const Region& region) {
  const FittedSoil& fit = *soil.fitted;
  const auto hidden = std::ranges::count_if(
      fit.parts, [](const DirectedImpedance& part) { return part.impedance.inner_dashpot > 0; });
  Facts facts{{{"mat", soil.mat},
               {"table", soil.table},
               {"centre", region.foundation->centre},
               {"hidden", hidden},
               {"stiffness", region.stiffness},
               {"dashpot", region.dashpot},
               {"misfits", Json::array()},
               {"parts", Json::array()}}};
  facts.say(
      "  soil under {mat}: {table}, its middle at {centre:.6g}\n"
      "    passive springs, dashpots and masses, {hidden} hidden parts\n");
  for (const FitMisfit& misfit : fit.misfits) {
    Json values{{"motions", names_of_motions(misfit.motions)},
                {"largest", misfit.largest},
                {"largest_at", misfit.largest_at},
                {"mean", misfit.mean}};
    facts.text += told(
        "    {motions}: misfit {largest:.2g %} at most, at {largest_at:.3g} Hz, {mean:.2g %} in "
        "the "
        "mean\n",
        values);
    facts.values["misfits"].push_back(std::move(values));
  }
  for (std::size_t c = 0; c < region.stiffness.size(); ++c) {
    facts.say("    {:-4s} stiffness {:12.4e}, dashpot {:12.4e}\n",
              {motion_names[c], region.stiffness[c], region.dashpot[c]});
  }
  for (const DirectedImpedance& part : fit.parts) {
    facts.values["parts"].push_back({{"motion", part.motion},
                                     {"stiffness", part.impedance.stiffness},
                                     {"dashpot", part.impedance.dashpot},
                                     {"moving_mass", part.impedance.mass},
                                     {"inner_stiffness", part.impedance.inner_stiffness},
                                     {"inner_dashpot", part.impedance.inner_dashpot},
                                     {"inner_mass", part.impedance.inner_mass}});
  }
  return facts;
}

}  // namespace

Facts soil_facts(const Structure& structure) {
  const Soil& soil = *structure.soil;
  const Region& region = *std::ranges::find(structure.regions, ElementType::soil, &Region::element);
  return soil.fitted ? fit_facts(soil, region) : half_space_facts(soil, *region.foundation);
}

Facts spread_facts(const Building& building) {
  Facts facts{Json::array()};
  for (const SpreadReport& group : building.spread) {
    const Region& region = building.structure->regions[static_cast<std::size_t>(group.region)];
    const bool area = region.spread == Spread::area;
    const auto stiffness = sums_of(group, region.stiffness);
    const auto dashpot = sums_of(group, region.dashpot);
    const Json& of = facts.values.emplace_back(Json{{"group", region.group},
                                                    {"nodes", group.nodes},
                                                    {area ? "area" : "length", group.extent},
                                                    {"stiffness", stiffness},
                                                    {"dashpot", dashpot}});
    const auto say = [&](const char* what, const std::array<double, 3>& sums, const char* unit) {
      if (sums == std::array{0.0, 0.0, 0.0}) return;
      facts.text += told(
          "  {} of {group}, {nodes} nodes, spread over {:.6g} {}: {:.4g}, {:.4g}, {:.4g} {} in "
          "all\n",
          of, {what, group.extent, area ? "m2" : "m", sums[0], sums[1], sums[2], unit});
    };
    say("springs", stiffness, "N/m");
    say("dashpots", dashpot, "N s/m");
  }
  return facts;
}

Facts absorbing_facts(const Building& building) {
  const Structure& structure = *building.structure;
  const interactions::AbsorbingReport& report = building.absorbing;
  const std::vector<std::string> groups = groups_of(structure, false);
  const std::vector<std::string> base = groups_of(structure, true);
  Facts facts{{{"groups", groups},
               {"base", base},
               {"nodes", report.nodes},
               {"area", report.area},
               {"base_area", report.base_area}}};
  facts.say("  absorbing faces:{}, {nodes} nodes, {area:.6g} m2\n", {listed(groups)});
  if (structure.is_driven_from_below()) {
    facts.say("    the motion enters through{}, {base_area:.6g} m2\n", {listed(base)});
  }
  return facts;
}

}  // namespace pounding
