#include "scene/rigid_reader.h"

#include <algorithm>

#include "scene/option_values.h"

namespace pounding {

std::vector<RigidGroup> read_rigid_groups(OptionReader& options, const std::string& structure) {
  std::vector<RigidGroup> groups;
  for (const RigidKind kind : {RigidKind::body, RigidKind::diaphragm, RigidKind::join,
                               RigidKind::pin, RigidKind::level, RigidKind::tie}) {
    const char* const pattern = rigid_option(kind);
    for (const std::string& item : options.list(pattern, {structure})) {
      RigidGroup rigid{kind, item, ""};
      if (kind == RigidKind::join || kind == RigidKind::tie) {
        const std::vector<std::string> sides = split(item, ':');
        if (sides.size() != 2 || sides[0].empty() || sides[1].empty() || sides[0] == sides[1]) {
          options.refuse(pattern, {structure}, "'" + item + "' does not name two groups");
        }
        rigid = {kind, sides[0], sides[1]};
      }
      if (std::ranges::count(groups, rigid.name(), &RigidGroup::name) > 0) {
        options.refuse(pattern, {structure},
                       "'" + item + "' is given here, or in another such option, already");
      }
      groups.push_back(rigid);
    }
  }
  return groups;
}

void make_mat_rigid(Structure& structure) {
  if (!structure.soil) return;
  const std::string& mat = structure.soil->mat;
  const bool is_rigid = std::ranges::any_of(structure.rigid_groups, [&](const RigidGroup& rigid) {
    return rigid.kind == RigidKind::body && rigid.group == mat;
  });
  if (!is_rigid) structure.rigid_groups.push_back({RigidKind::body, mat, "", true});
}

}  // namespace pounding
