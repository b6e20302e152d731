#include "interactions/pairing/stop_rows.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "common/error.h"
#include "common/matrix3.h"
#include "interactions/pairing/contact_sides.h"
#include "interactions/pairing/gap_field.h"

namespace pounding::interactions {
namespace {

/// Distance of two nodes from which on a line joins them, over the model's longest side.
constexpr double same_place = 1e-9;

/// Nodes of one side of a stop.
struct StopSide {
  int structure = 0;
  const GlobalMesh* mesh = nullptr;  ///< null: a rigid wall
  std::vector<GlobalIndex> nodes;    ///< file order

  Vector3 position(GlobalIndex node) const { return mesh->position(node); }
  bool moves(GlobalIndex node) const {
    return mesh != nullptr && (mesh->free_components[node] & 0x07) != 0;
  }
};

GlobalIndex nearest_to(const Vector3& point, const GlobalMesh& mesh,
                       std::span<const GlobalIndex> nodes) {
  const auto away = [&](GlobalIndex node) { return norm(minus(mesh.position(node), point)); };
  return *std::ranges::min_element(nodes, {}, away);
}

StopSide stop_side(const Scene& scene, std::span<const GlobalMesh> meshes, const Contact& contact,
                   const std::string& name) {
  const ContactSide& side = name == "secondary" ? contact.secondary : contact.primary;
  StopSide found;
  if (side.is_wall()) return found;
  found.structure = static_cast<int>(structure_number(scene, side.structure));
  found.mesh = &meshes[static_cast<std::size_t>(found.structure)];
  const auto group = found.mesh->groups.find(side.group);
  refuse_if(group == found.mesh->groups.end(),
            side_option(contact, name) + ": group '" + side.group + "' is not in the mesh of " +
                side.structure + ", which has: " + group_names(*found.mesh) + "; a point is x,y,z");
  found.nodes = group->second.nodes;
  return found;
}

/// Finds the rows of one stop.
class StopRows {
 public:
  StopRows(const Scene& scene, std::span<const GlobalMesh> meshes, int number, Interface& interface)
      : contact_(scene.contacts[static_cast<std::size_t>(number)]),
        number_(number),
        interface_(interface),
        secondary_(stop_side(scene, meshes, contact_, "secondary")),
        primary_(stop_side(scene, meshes, contact_, "primary")) {
    report_.contact = contact_.name;
    const auto [least, most] = std::ranges::minmax(contact_.gap.values);
    report_.smallest_gap = least;
    report_.largest_gap = most;
    report_.geometric_gap.fill(std::numeric_limits<double>::quiet_NaN());
  }

  void find() {
    for (const GlobalIndex node : secondary_.nodes) add_node(node);
    interface_.reports.push_back(report_);
  }

 private:
  void add_node(GlobalIndex node) {
    const Vector3 here = secondary_.position(node);
    const bool wall = primary_.mesh == nullptr;
    const GlobalIndex other = wall ? 0 : nearest_to(here, *primary_.mesh, primary_.nodes);
    refuse_if(
        !wall && primary_.structure == secondary_.structure && other == node,
        side_option(contact_, "primary") + ": both sides of the stop are the same node; name two");
    refuse_if(!secondary_.moves(node) && !(!wall && primary_.moves(other)),
              side_option(contact_, "secondary") + ": neither the node at " + text(here) +
                  " nor what stops it can move; leave the stop out, or free one");
    const Vector3 way = wall ? Vector3{0, 0, 0} : minus(primary_.position(other), here);
    const Vector3 ahead = direction(here, way);
    if (report_.pairs == 0) {
      report_.normal = ahead;
      report_.tangent_axes = axes_across(ahead);
    }
    for (std::size_t side = 0; side < contact_.gap.values.size(); ++side) {
      const double sign = side == 0 ? 1 : -1;
      const Vector3 normal{sign * ahead[0], sign * ahead[1], sign * ahead[2]};
      Constraint row;
      row.contact = number_;
      if (!wall) add_terms(primary_.structure, other, 1, normal, row);
      add_terms(secondary_.structure, node, -1, normal, row);
      row.matched = true;
      row.initial_gap = contact_.gap.values[side];
      row.geometric_gap = dot(normal, way);
      row.friction = contact_.friction;
      row.at = here;
      for (std::size_t t = 0; t < 2; ++t) {
        row.place[t] = here[static_cast<std::size_t>(report_.tangent_axes[t])];
      }
      if (contact_.is_elastic()) fill_joint(contact_, row);
      row.share = {static_cast<double>(side), 0};
      interface_.constraints.push_back(std::move(row));
      ++report_.pairs;
      ++report_.matched;
    }
  }

  Vector3 direction(const Vector3& here, const Vector3& way) const {
    if (contact_.stop->along) return *contact_.stop->along;
    refuse_if(!(norm(way) > same_place * interface_.model_size),
              "option -" + contact_.name + "_along line: both nodes lie at " + text(here) +
                  ", and no line joins them; give a direction x,y,z");
    return normalised(way);
  }

  static std::string text(const Vector3& x) {
    std::ostringstream out;
    out << "(" << x[0] << ", " << x[1] << ", " << x[2] << ") m";
    return out.str();
  }

  const Contact& contact_;
  int number_;
  Interface& interface_;
  StopSide secondary_;
  StopSide primary_;
  InterfaceReport report_;
};

}  // namespace

void add_stop_rows(const Scene& scene, std::span<const GlobalMesh> meshes, int number,
                   Interface& interface) {
  StopRows(scene, meshes, number, interface).find();
}

}  // namespace pounding::interactions
