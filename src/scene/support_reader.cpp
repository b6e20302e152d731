#include "scene/support_reader.h"

#include <algorithm>
#include <array>
#include <set>

#include "scene/motion_reader.h"
#include "scene/option_values.h"
#include "scene/structure_reader.h"

namespace pounding {
namespace {

constexpr std::string_view groups_option = "<support>_groups";

/// Beyond that of any foundation from its underside to the surface [s].
constexpr double longest_travel = 1;

bool turns(const Support& support) {
  return support.embedment.has_value() ||
         std::any_of(support.motion.begin() + 3, support.motion.end(),
                     [](const auto& rotation) { return rotation.has_value(); });
}

std::vector<SupportedGroup> read_groups(OptionReader& options, const std::string& name) {
  std::vector<SupportedGroup> groups;
  for (const std::string& item : split(options.text(groups_option, {name}), ',')) {
    const std::vector<std::string> words = split(item, ':');
    options.refuse_if(
        words.empty() || words.size() > 2 || words.front().empty() || words.back().empty(),
        groups_option, {name}, "'" + item + "' is neither structure:group nor a structure");
    groups.push_back({words[0], words.size() == 2 ? words[1] : ""});
  }
  return groups;
}

/// A rotation about an axis, as a motion whose record is in rad/s2.
std::optional<MotionComponent> read_rotation(OptionReader& options, const std::string& name,
                                             const std::string& axis) {
  const OptionReader::Names names{name, axis};
  if (!options.given("<support>_rotation_<x|y|z>_record", names)) {
    options.forbid_all<SupportRotationOptions>(names,
                                               goes_with("<support>_rotation_<x|y|z>_record"));
    return std::nullopt;
  }
  RecordedMotion record;
  record.file = options.text("<support>_rotation_<x|y|z>_record", names);
  options.read(record, names, std::string("<support>_rotation_<x|y|z>_"));
  MotionComponent component;
  component.source = record;
  component.scale = options.real("<support>_rotation_<x|y|z>_scale", names);
  return component;
}

/// Embedment of a foundation that moves as its soil lets it, and that has no other motion.
std::optional<Embedment> read_embedment(OptionReader& options, const Support& support) {
  Embedment embedment;
  options.read(embedment, {support.name});
  if (!embedment.is_deep()) return std::nullopt;
  options.refuse_if(!(embedment.travel() <= longest_travel), "<support>_vs", {support.name},
                    "a wave would take more than a second from the foundation to the surface; is "
                    "it in m/s, and -<support>_embedment in m?");
  for (std::size_t c = 0; c < support.motion.size(); ++c) {
    if (c == 2 || !support.motion[c]) continue;
    options.refuse("<support>_embedment", {support.name},
                   "its motion follows from that of the surface; not with a " +
                       std::string(c < 3 ? "motion along x or y" : "rotation") + " of its own");
  }
  options.forbid_each(
      "<support>_", {"delay", "factor"}, {support.name},
      "not with -<support>_embedment: its motion follows from that of the surface, as it is");
  return embedment;
}

/// Delay and factor act on the motion of the ground, along axes without a record; an embedment on
/// that along x and y.
void require_effect(const OptionReader& options, const Scene& scene, const Support& support) {
  options.refuse_if(support.embedment && !scene.motion[0] && !scene.motion[1],
                    "<support>_embedment", {support.name},
                    "no effect: there is no -motion_x or -motion_y");
  bool acts = false;
  for (std::size_t d = 0; d < 3; ++d) acts = acts || (scene.motion[d] && !support.motion[d]);
  if (acts) return;
  options.forbid_each("<support>_", {"delay", "factor"}, {support.name},
                      "no effect: along no axis the support goes by -motion_x, _y or _z");
}

/// Refuses options that are not worked out, or tested, for a structure on supports that move on
/// their own; `all_ground`: with all its ground on one of them.
void require_plain(const OptionReader& options, const Scene& scene, const Support& support,
                   const Structure& structure, bool all_ground) {
  const auto refuse_if = [&](bool wrong, const std::string& why) {
    options.refuse_if(wrong, groups_option, {support.name}, why);
  };
  const std::string own = "structure " + structure.name;
  const std::string option = "-" + structure.name;
  refuse_if(
      !structure.matrices.empty(),
      own + ": " + option + "_matrices do not hold the forces of its clamped dofs on the others");
  refuse_if(!structure.absorbing.empty(), own + ": not with " + option + "_absorbing");
  refuse_if(all_ground && turns(support) && structure.p_delta,
            own + ": its weight would not turn with its ground; not with " + option + "_p_delta");
  refuse_if(!scene.export_matrices.empty(),
            "not with -export_matrices: no matrix holds the motion of supports");
  const bool braked = std::ranges::any_of(structure.regions, [&](const Region& region) {
    return structure.damping_of(region).alpha > 0;
  });
  for (const Region& region : structure.regions) {
    refuse_if(region.nonlinear.yields() && !all_ground && braked,
              own +
                  ": damping alpha brakes against the motion of linear elements alone, not of "
                  "yielding ones as " +
                  region.group + "; give beta or damping_uniform");
    const LawKind* const law = is_nonlinear.of(region);
    if (structure.modal && law != nullptr) {
      options.refuse(groups_option, {support.name},
                     own + " is reduced: not with -" +
                         option_name(law->option, {structure.name, region.group}));
    }
  }
}

}  // namespace

Support read_support(OptionReader& options, const std::string& name) {
  Support support;
  support.name = name;
  support.groups = read_groups(options, name);
  options.read(support, {name});
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string axis = direction_names[d];
    support.motion[d] = read_motion(options, axis, name);
    if (!support.motion[d] && options.given("<support>_motion_<x|y|z>_record", {name, axis})) {
      support.factor[d] = 0;  // it is at rest
    }
    support.motion[3 + d] = read_rotation(options, name, axis);
  }
  support.embedment = read_embedment(options, support);
  if (turns(support)) {
    const std::vector<double> point = options.reals("<support>_point", {name}, 3);
    std::copy(point.begin(), point.end(), support.point.begin());
  } else {
    options.forbid("<support>_point", {name}, "the support does not turn; leave it out");
  }
  return support;
}

void check_supports(const OptionReader& options, const Scene& scene) {
  std::set<std::pair<std::string, std::string>> seen;
  for (const Support& support : scene.supports) {
    const auto refuse_if = [&](bool wrong, const std::string& why) {
      options.refuse_if(wrong, groups_option, {support.name}, why);
    };
    for (const SupportedGroup& item : support.groups) {
      const auto& [name, group] = item;
      const Structure& structure = named_structure(
          options, scene, groups_option, {support.name}, name,
          item.is_all_ground() ? "; a group is named with its structure before it" : "");
      refuse_if(seen.contains({name, group}),
                "'" + name + (group.empty() ? "" : ":" + group) + "' is on a support already");
      const auto first = seen.lower_bound({name, ""});  // all ground comes before groups
      refuse_if(first != seen.end() && first->first == name &&
                    (first->second.empty() || item.is_all_ground()),
                "'" + name +
                    "' means all ground of the structure, and another support, or another name "
                    "here, has a group of it");
      seen.emplace(name, group);
      require_plain(options, scene, support, structure, item.is_all_ground());
    }
    refuse_if(scene.motion_from_below, "not with -motion_input below");
    require_effect(options, scene, support);
  }
}

int support_of_all_ground(const Scene& scene, const Structure& structure) {
  for (std::size_t s = 0; s < scene.supports.size(); ++s) {
    for (const SupportedGroup& item : scene.supports[s].groups) {
      if (item.structure == structure.name && item.is_all_ground()) return static_cast<int>(s);
    }
  }
  return -1;
}

std::size_t axis_of_motion(std::size_t component) {
  constexpr std::array<std::size_t, 6> axes{0, 1, 2, 1, 0, 2};
  return axes[component];
}

bool moves_otherwise(const Support& support, std::size_t component, bool ground_moves) {
  if (support.motion[component]) return true;
  if (support.embedment && axis_of_motion(component) < 2) return ground_moves;
  return component < 3 && ground_moves && (support.delay > 0 || support.factor[component] != 1);
}

bool stands_on_moving_support(const Scene& scene, const Structure& structure) {
  return std::ranges::any_of(scene.supports, [&](const Support& support) {
    bool moves = false;
    for (std::size_t c = 0; c < 6; ++c) {
      moves = moves || moves_otherwise(support, c, scene.motion[axis_of_motion(c)].has_value());
    }
    return moves &&
           std::ranges::count(support.groups, structure.name, &SupportedGroup::structure) > 0;
  });
}

}  // namespace pounding
