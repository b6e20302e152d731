#include "scene/held_nodes_reader.h"

#include <algorithm>

#include "common/types.h"
#include "scene/doubts.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

constexpr std::string_view absorbing = "<structure>_absorbing";
constexpr std::string_view base = "<structure>_absorbing_base";
constexpr std::string_view input = "motion_input";

/// A block that a wave moves is not held by ground at rest, nor braked against it.
void check_driven(const OptionReader& options, const Structure& structure) {
  const auto refuse_if = [&](bool wrong, const std::string& why) {
    options.refuse_if(wrong, input, {}, "structure " + structure.name + " " + why);
  };
  refuse_if(
      !structure.is_driven_from_below(),
      "has no -" + structure.name +
          "_absorbing_base: one on the moving ground and one that a wave moves cannot be in one "
          "scene");
  for (const Region& region : structure.regions) {
    refuse_if(
        is_grounded(region.element),
        "has springs to the ground (" + region.group +
            "), which would be at rest under the wave; clamp nodes that must not move, or leave "
            "them out");
    refuse_if(structure.damping_of(region).alpha > 0,
              "has damping alpha, which would brake it against ground at rest; give beta or "
              "damping_uniform");
  }
}

/// Dashpots carry nothing at rest.
void check_weight(const OptionReader& options, const Structure& structure) {
  for (std::size_t d = 0; d < 3; ++d) {
    if (structure.gravity[d] == 0 || is_held(structure, d)) continue;
    const AbsorbingFace& face = structure.absorbing.front();
    const std::string along = direction_names[d];
    options.refuse(face.is_base ? base : absorbing, {structure.name},
                   "gravity acts along " + along +
                       ", where nothing but dashpots holds the structure; clamp its base there "
                       "(-<structure>_clamp " +
                       face.group + ":" + along + "), or leave gravity out");
  }
}

/// The components behind the last colon of an item, "y+rx+rz".
std::uint8_t components_of(const OptionReader& options, std::string_view pattern,
                           const std::string& structure, const std::string& item) {
  std::uint8_t components = 0;
  for (const std::string& name : split(item.substr(item.rfind(':') + 1), '+')) {
    const auto found = std::ranges::find(motion_names, name);
    options.refuse_if(found == motion_names.end(), pattern, {structure},
                      "'" + item + "': '" + name + "' is no component of x, y, z, rx, ry, rz");
    components |= static_cast<std::uint8_t>(1u << (found - motion_names.begin()));
  }
  return components;
}

}  // namespace

std::vector<Clamp> read_clamps(OptionReader& options, const std::string& structure) {
  constexpr std::string_view pattern = "<structure>_clamp";
  std::vector<Clamp> clamps;
  for (const std::string& item : options.list(pattern, {structure})) {
    const std::vector<std::string> sides = split(item, ':');
    options.refuse_if(sides.size() > 2 || sides[0].empty(), pattern, {structure},
                      "'" + item + "' is not group or group:components");
    Clamp clamp{sides[0]};
    options.refuse_if(std::ranges::count(clamps, clamp.group, &Clamp::group) > 0, pattern,
                      {structure}, "group '" + clamp.group + "' is listed twice");
    if (sides.size() == 2) clamp.components = components_of(options, pattern, structure, item);
    clamps.push_back(clamp);
  }
  return clamps;
}

std::vector<RigidGroup> read_rigid_groups(OptionReader& options, const std::string& structure) {
  std::vector<RigidGroup> groups;
  for (const RigidKind kind : {RigidKind::body, RigidKind::diaphragm, RigidKind::join,
                               RigidKind::pin, RigidKind::level, RigidKind::tie}) {
    const char* const pattern = rigid_option(kind);
    for (const std::string& item : options.list(pattern, {structure})) {
      RigidGroup rigid{kind, item, ""};
      if (kind == RigidKind::body && item.find(':') != std::string::npos) {
        const std::vector<std::string> parts = split(item, ':');
        options.refuse_if(
            parts.size() > 3 || parts[0].empty() || parts[1].empty() || parts[0] == parts[1],
            pattern, {structure}, "'" + item + "' is no group, group:x+y+z or group:group:x+y+z");
        rigid = {kind, parts[0], parts.size() == 3 ? parts[1] : "", false,
                 components_of(options, pattern, structure, item)};
      }
      if (kind == RigidKind::join || kind == RigidKind::tie) {
        const std::vector<std::string> sides = split(item, ':');
        options.refuse_if(
            sides.size() != 2 || sides[0].empty() || sides[1].empty() || sides[0] == sides[1],
            pattern, {structure}, "'" + item + "' does not name two groups");
        rigid = {kind, sides[0], sides[1]};
      }
      options.refuse_if(std::ranges::count(groups, rigid.name(), &RigidGroup::name) > 0, pattern,
                        {structure},
                        "'" + item + "' is given here, or in another such option, already");
      groups.push_back(rigid);
    }
  }
  return groups;
}

void make_mat_rigid(Structure& structure) {
  if (!structure.soil) return;
  const std::string& mat = structure.soil->mat;
  const bool is_rigid = std::ranges::any_of(structure.rigid_groups, [&](const RigidGroup& rigid) {
    return rigid.kind == RigidKind::body && rigid.group == mat && rigid.following == 0x3f;
  });
  if (!is_rigid) structure.rigid_groups.push_back({RigidKind::body, mat, "", true});
}

std::vector<AbsorbingFace> read_absorbing(OptionReader& options, const Structure& structure) {
  std::vector<AbsorbingFace> faces;
  for (const std::string_view pattern : {base, absorbing}) {
    for (const std::string& group : options.list(pattern, {structure.name})) {
      options.refuse_if(std::ranges::count(faces, group, &AbsorbingFace::group) > 0, pattern,
                        {structure.name}, "'" + group + "' is in absorbing and in absorbing_base");
      faces.push_back({group, pattern == base});
    }
    const std::string where = "not with -" + structure.name;
    options.refuse_if(!faces.empty() && !structure.matrices.empty(), pattern, {structure.name},
                      where + "_matrices");
    options.refuse_if(!faces.empty() && structure.modal, pattern, {structure.name},
                      where + "_model modal: waves leave a structure at full order only");
  }
  return faces;
}

void check_absorbing(const OptionReader& options, const Scene& scene) {
  for (const Structure& structure : scene.structures) {
    options.refuse_if(
        !structure.absorbing.empty() && !scene.export_matrices.empty(), "export_matrices", {},
        "structure " + structure.name + " has absorbing faces, which no matrix holds");
    if (!structure.absorbing.empty()) check_weight(options, structure);
    if (scene.motion_from_below) check_driven(options, structure);
    options.refuse_if(
        !scene.motion_from_below && structure.is_driven_from_below(), base, {structure.name},
        "goes with -motion_input below; without it, name the faces in -<structure>_absorbing");
  }
  options.refuse_if(!scene.motion_incoherent.empty() && !scene.motion_from_below,
                    "motion_incoherent", {},
                    "it is part of a wave from below; goes with -motion_input below");
  const bool walls = std::ranges::any_of(
      scene.contacts, [](const Contact& contact) { return contact.primary.is_wall(); });
  options.refuse_if(scene.motion_from_below && walls, input, {},
                    "a wall follows ground that moves; model it as a structure");
}

}  // namespace pounding
