#include <algorithm>
#include <array>
#include <numbers>

#include "common/facts_of.h"
#include "common/types.h"
#include "elements/element_traits.h"
#include "report/report.h"
#include "scene/pool_reader.h"
#include "scene/spring_reader.h"

namespace pounding {
namespace {

/// Cost of a mesh beside an extruded one from which on it is said.
constexpr double told_cost = 1.5;

/// Elements, materials and sections by group, in numbers.
Json regions_of(const Structure& structure) {
  Json regions = Json::object();
  for (const Region& region : structure.regions) {
    Json material;
    Json section;
    if (const Material& of = region.material; of.young > 0) {
      material = FACTS_OF(of, name, young, poisson, density);
    }
    if (const auto& of = region.section) {
      section = FACTS_OF((*of), name, area, inertia_y, inertia_z, torsion, z_axis);
      if (is_flexible_in_shear(region)) {
        section["shear_area"] = {of->shear_area_y, of->shear_area_z};
      }
    }
    const std::string per = per_extent(region.spread);
    Json all = FACTS_OF(region, area, thickness, added_mass, mass, rotary_inertia);
    all.update({{"element", element_name(region.element)},
                {"material", material},
                {"section", section},
                {"stiffness" + per, region.stiffness},
                {"dashpot" + per, region.dashpot},
                {"yield_force", region.nonlinear.yield_force},
                {"sliding_friction", region.nonlinear.friction},
                {"one_way", is_one_way(region)}});
    regions[region.group] = without_nothing(all);
  }
  return regions;
}

/// Facts of the elements by group. A group of shells may have quadrangles and triangles, each in a
/// block of its own.
Facts group_facts(const Mesh& mesh) {
  Facts facts;
  for (const ElementBlock& block : mesh.blocks) {
    facts.values[block.group] =
        facts.values.value(block.group, GlobalIndex{0}) + block.global_count;
    facts.say("  {:-14s} {:7d} {}\n", {block.group, block.global_count, element_name(block.type)});
  }
  return facts;
}

/// Facts of the beams: those that lines were cut into, and rotary inertia that they were given.
Facts beam_facts(const Building& building) {
  Facts facts;
  for (const DividedLines& divided : building.findings.divided) {
    Json& of = facts.values[divided.group]["divided"] =
        Json{{"lines", divided.lines}, {"beams", divided.beams}, {"left_whole", divided.whole}};
    facts.text += told("  {}: {lines} lines cut into {beams} beams", of, {divided.group});
    if (divided.whole > 0) {
      facts.text +=
          told(", {left_whole} left whole, which are edges of surfaces or of other groups too", of);
    }
    facts.say("\n");
  }
  for (const BeamWaves& beams : building.beams) {
    if (beams.heavier == 0) continue;
    Json& of = facts.values[beams.group]["added_rotary_inertia"] =
        Json{{"beams", beams.heavier}, {"largest_part", beams.largest_part}};
    facts.text += told(
        "  {}: {beams} long beams got rotary inertia, at most {largest_part:.2g} of their own; no "
        "frequency of the spectra falls by more than 0.1 %\n",
        of, {beams.group});
  }
  return facts;
}

/// Facts of how the mesh hangs together.
Facts connectivity_facts(const MeshFindings& findings) {
  const Connectivity& connectivity = findings.connectivity;
  Facts facts{{{"pieces", connectivity.pieces.size()},
               {"pieces_not_held", connectivity.loose_pieces()},
               {"held_against_every_rigid_motion", connectivity.wholly_held()}}};
  facts.say("  {pieces} connected piece{}, ", {connectivity.pieces.size() == 1 ? "" : "s"});
  if (connectivity.loose_pieces() == 0) {
    facts.say("held{}\n", {connectivity.wholly_held() ? "" : ", not against every rigid motion"});
  } else {
    facts.say("{pieces_not_held} not held, one at {:.6g}\n", {connectivity.loose_piece().place});
  }
  for (const Piece& piece : connectivity.pieces) {
    if (piece.held) continue;
    facts.values["not_held"].push_back(FACTS_OF(piece, nodes, place));
  }
  const auto add = [&](const char* key, const Places& places, const std::string& what) {
    Json& of = facts.values[key] = Json{{"count", places.count}};
    if (places.count > 0) of["first"] = places.first;
    if (!what.empty()) facts.text += told("[  {count} " + what + ", the first at {first}\n]", of);
  };
  add("coincident_nodes_apart", connectivity.coincident_apart,
      "pairs of nodes of unjoined pieces coincide");
  add("coincident_nodes_inside", connectivity.coincident_inside, "");
  add("line_ends_in_elements", connectivity.ends_inside,
      "ends of lines lie in elements without a node there");
  add("hinges_at_solids", connectivity.hinges,
      "nodes of solids, which hold no rotation, carry beams or shells");
  add("single_beams_at_solids", connectivity.lone_hinges, "of them carry one beam alone: a hinge");
  std::string groups;
  facts.add("groups_without_use", Json::array());
  for (const UnusedElements& unused : findings.unused) {
    groups += (groups.empty() ? "" : ", ") + unused.group;
    facts.values["groups_without_use"].push_back(
        {{"group", unused.group}, {"kind", unused.kind}, {"elements", unused.count}});
  }
  facts.say("[  groups without a use: {}\n]", {groups});
  return facts;
}

/// Facts of the groups that move as one.
Facts rigid_facts(const Building& building) {
  constexpr std::array words{"rigid",  "rigid in its plane", "joined",
                             "pinned", "tied by height",     "tied"};
  Facts facts{Json::array()};
  for (const RigidGroup& rigid : building.structure->rigid_groups) {
    const std::string option = rigid_option(rigid.kind);
    Json& of = facts.values.emplace_back(
        Json{{"group", rigid.name()}, {"kind", option.substr(option.find('_') + 1)}});
    facts.text += told("  {}: {group}", of, {words[static_cast<std::size_t>(rigid.kind)]});
    for (const RigidBodyReport& report : building.system->rigid_bodies) {
      if (report.group != rigid.name()) continue;
      of.update(FACTS_OF(report, bodies, nodes, mass, dofs, motions));
      facts.text += told(", {nodes} nodes of {mass:.0f} kg", of);
      if (report.bodies > 1) facts.text += told(" in {bodies}", of);
      facts.text += told(rigid.kind == RigidKind::tie ? ", {dofs} dofs that follow"
                                                      : ", {dofs} dofs by {motions} motions",
                         of);
    }
    facts.say("\n");
  }
  return facts;
}

/// Water of a pool: its masses against motions along x and y.
Facts pool_facts(const Structure& structure, const Pool& pool) {
  const double mass = pool.density * pool.outline.volume;
  if (!pool.is_tank()) {
    Facts facts{FACTS_OF(pool.outline, corner, sides, depth, wetted, pressures)};
    facts.add("mass", mass);
    facts.say("  pool {}: {mass:.0f} kg of water, {wetted} wetted nodes, no waves\n", {pool.name});
    return facts;
  }
  Facts facts{FACTS_OF(pool.outline, corner, sides, depth, freeboard)};
  facts.add("mass", mass);
  facts.say(
      "  pool {}: {mass:.0f} kg of water, part of the mass, {depth:.4g} m deep in {sides/0} x "
      "{sides/1} m, freeboard {freeboard:.4g} m\n",
      {pool.name});
  for (const std::size_t d : {0, 1}) {
    const TankWater water = pool.water_along(d);
    const auto part = [&](const WaterMass& of) {
      return Json{{"mass", of.mass * mass},
                  {"height", of.height * pool.outline.depth},
                  {"height_with_floor", of.height_with_floor * pool.outline.depth},
                  {"frequency", of.circular_frequency / (2 * std::numbers::pi)}};
    };
    Json& along = facts.values[direction_names[d]] = {{"impulsive", part(water.impulsive)}};
    facts.text += told(
        "    along {}: {impulsive/mass:.0f} kg with the walls, {impulsive/height:.3g} m "
        "above the floor, waves",
        along, {direction_names[d]});
    for (const WaterMass& wave : water.convective) {
      Json& of = along["waves"].emplace_back(part(wave));
      of["damping"] = wave_damping(structure, pool, wave.circular_frequency);
      facts.text += told(" of {frequency:.3g} Hz {mass:.0f} kg ({damping:.2g %})", of);
    }
    facts.say("\n");
  }
  return facts;
}

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

/// Soil of a half-space.
Facts half_space_facts(const Soil& soil, const Foundation& foundation) {
  const bool disk = foundation.footprint.disk;
  Facts facts{{{"mat", soil.mat},
               {"shape", disk ? "disk" : "rectangle"},
               {"size", foundation.footprint.sides},
               {"embedment", foundation.footprint.embedment},
               {"centre", foundation.centre},
               {"largest_frequency",  // up to which the impedances are meant to hold
                largest_a0 * soil.ground.shear_velocity /
                    (2 * std::numbers::pi * foundation.footprint.half_width())},
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
  const auto is_hidden = [](const auto& part) { return part.impedance.inner_dashpot > 0; };
  const auto hidden =
      std::ranges::count_if(fit.parts, is_hidden) + std::ranges::count_if(fit.shared, is_hidden);
  Facts facts{{{"mat", soil.mat},
               {"table", soil.table},
               {"table_mat", soil.table_mat},
               {"mats", fit.mats},
               {"centre", region.foundation->centre},
               {"hidden", hidden},
               {"stiffness", region.stiffness},
               {"dashpot", region.dashpot},
               {"misfits", Json::array()},
               {"parts", Json::array()}}};
  facts.say(
      "  soil under {mat}: {table}, its middle at {centre:.6g}\n"
      "    passive springs, dashpots and masses, {hidden} hidden parts\n");
  if (soil.is_shared()) {
    facts.say(
        "    mat {table_mat} of {mats}, coupled with the others; below the springs of it alone\n");
  }
  for (const FitMisfit& misfit : fit.misfits) {
    const Json& of =
        facts.values["misfits"].emplace_back(FACTS_OF(misfit, motions, largest, largest_at, mean));
    facts.text += told(
        "    {motions}: misfit {largest:.2g %} at most, at {largest_at:.3g} Hz, {mean:.2g %} in "
        "the mean\n",
        of);
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

Facts structure_facts(const Building& building) {
  const Structure& structure = *building.structure;
  const Mesh& mesh = *building.mesh;
  GlobalIndex elements = 0;
  for (const ElementBlock& block : mesh.blocks) elements += block.global_count;
  Facts facts{{{"nodes", mesh.global_nodes},
               {"dofs", mesh.global_dofs},
               {"dofs_before_clamping", mesh.global_dofs_unclamped},
               {"elements", elements},
               {"regions", regions_of(structure)},
               {"mass", building.system->total_mass},
               {"stiffness", building.system->stiffness_method}}};
  facts.say(
      "\nstructure {}: {nodes} nodes, {dofs} dofs ({dofs_before_clamping} before clamping), mass "
      "{mass:.0f} kg\n",
      {building.name()});
  if (const double cost = building.system->cost_beside_extruded; cost >= told_cost) {
    facts.add("cost_beside_extruded", cost,
              "  a step of its solids takes about {cost_beside_extruded:.2g} times that of an "
              "extruded mesh with as many nodes\n");
  }
  facts.add("groups", group_facts(mesh));
  if (const Facts beams = beam_facts(building); !beams.values.empty()) facts.add("beams", beams);
  if (!structure.rigid_groups.empty()) facts.add("rigid_groups", rigid_facts(building));
  facts.add("connectivity", connectivity_facts(building.findings));
  if (const MeshWaves& waves = building.findings.waves; waves.frequency > 0) {
    facts.add("mesh_waves", FACTS_OF(waves, frequency, element_size, group),
              "  the mesh carries waves up to {mesh_waves/frequency:.3g} Hz, by elements of "
              "{mesh_waves/element_size:.3g} m of {mesh_waves/group}\n");
  }
  facts.say("  stiffness: {stiffness}\n");
  if (structure.basis() != nullptr) facts.add("modal", reduction_facts(building));
  facts.add(damping_facts(building));
  if (const auto& compression = building.compression) {
    facts.add("p_delta",
              {{"largest_compression", compression->force}, {"place", compression->place}},
              "  P-Delta: at rest up to {p_delta/largest_compression} N press {p_delta/place}\n");
  }
  if (structure.soil) facts.add("soil", soil_facts(structure));
  for (const Pool& pool : structure.pools) {
    const Facts water = pool_facts(structure, pool);
    facts.values["pools"][pool.name] = water.values;
    facts.text += water.text;
  }
  if (!structure.absorbing.empty()) facts.add("absorbing", absorbing_facts(building));
  if (!building.spread.empty()) facts.add("spread_springs", spread_facts(building));
  facts.add(mode_facts(building));
  const Facts scaling = scaling_facts(building);
  facts.values.update(scaling.values);
  if (!building.basis) facts.text += scaling.text;
  facts.add(step_limit_facts(building));
  return facts;
}

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
  Facts facts{FACTS_OF(report, nodes, area, base_area)};
  facts.values.update({{"groups", groups}, {"base", base}});
  facts.say("  absorbing faces:{}, {nodes} nodes, {area:.6g} m2\n", {listed(groups)});
  if (structure.is_driven_from_below()) {
    facts.say("    the motion enters through{}, {base_area:.6g} m2\n", {listed(base)});
  }
  return facts;
}

}  // namespace pounding
