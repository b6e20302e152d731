#include "interactions/pairing/find_interface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>

#include "common/error.h"
#include "interactions/pairing/contact_checks.h"
#include "interactions/pairing/contact_face.h"
#include "interactions/pairing/contact_sides.h"
#include "interactions/pairing/facet_finder.h"
#include "interactions/pairing/gap_field.h"
#include "interactions/pairing/gap_survey.h"
#include "interactions/pairing/stop_rows.h"

namespace pounding::interactions {
namespace {

/// Finds the pairs of one contact.
class PairFinder {
 public:
  PairFinder(const Scene& scene, std::span<const GlobalMesh> meshes, int contact)
      : contacts_(scene.contacts),
        contact_(scene.contacts[contact]),
        number_(contact),
        sides_(find_sides(scene, meshes, contact_)) {
    report_.contact = contact_.name;
    report_.normal = sides_.secondary.face.mean_normal;
    report_.inner_facets = sides_.secondary.face.inner_facets + sides_.primary.face.inner_facets;
    report_.tangent_axes = axes_across(report_.normal);
  }

  void find(Interface& interface) {
    const std::size_t first = first_row_ = interface.constraints.size();
    const std::size_t first_watched = interface.watched.size();
    if (contact_.primary.is_wall()) {
      pair_with_wall(interface);
    } else if (has_crossing_lines()) {
      if (contact_.sliding > 0) refuse_sliding_lines();
      pair_crossings(interface);
    } else {
      const bool both = contact_.passes == 2 || (contact_.passes == 0 && needs_both_passes());
      report_.passes = both ? 2 : 1;
      pair(sides_.secondary, sides_.primary, interface);
      if (both) {
        pair(sides_.primary, sides_.secondary, interface);
        if (!contact_.filler && contact_.sliding == 0) drop_repeated(first, interface, report_);
      } else {
        watch_other_pass(interface);
      }
    }
    if (report_.pairs == 0) refuse_without_pairs();
    const std::span<Constraint> found(&interface.constraints[first],
                                      interface.constraints.size() - first);
    set_gaps(found, std::span(interface.watched).subspan(first_watched));
    set_offsets(found, interface.sliding);
    if (contact_.filler) {
      lay_filler(contact_, has_lines(), common_area_, found, report_);
    }
    interface.reports.push_back(report_);
  }

 private:
  [[noreturn]] void refuse_without_pairs() const {
    const std::string option = side_option(contact_, "secondary");
    refuse_if(report_.left_behind == 0,
              option + ": no node of group '" + contact_.secondary.group + "' faces group '" +
                  contact_.primary.group +
                  "'; check that the two faces overlap across their normal");
    std::ostringstream text;
    text << option << ": the primary " << contact_.primary.structure << ":"
         << contact_.primary.group << " lies behind it, by up to " << report_.farthest_behind
         << " m, more than the elements there are deep: the faces look away from each other, or "
            "the bodies lie within each other; name the faces that look at each other, or move a "
            "mesh";
    throw UserError(text.str());
  }

  [[noreturn]] void refuse_sliding_lines() const {
    throw UserError("option -" + contact_.name +
                    "_sliding: edges and beams that cross keep their pairs; leave it out");
  }

  /// Lines, beams among them: they meet where they cross, mostly between nodes of both.
  bool has_crossing_lines() const {
    return sides_.secondary.face.beams + sides_.primary.face.beams > 0 &&
           sides_.secondary.face.is_line() && sides_.primary.face.is_line();
  }

  /// Some part of either side is lines, which have no area.
  bool has_lines() const {
    return sides_.secondary.face.has_lines() || sides_.primary.face.has_lines();
  }

  /// Nodes of the primary may go between those of the secondary: lines are met along them alone,
  /// and facets that are larger by more than round-off of a mesh hold some between their nodes.
  bool needs_both_passes() const {
    constexpr double as_large = 1.05;
    return has_lines() || sides_.secondary.face.mean_facet_size() >
                              as_large * sides_.primary.face.mean_facet_size();
  }

  /// Keeps the rows of a second pass that is not taken, those of nodes that face each other aside.
  void watch_other_pass(Interface& interface) {
    const InterfaceReport taken = report_;
    Interface other;
    watches_ = true;
    pair(sides_.primary, sides_.secondary, other);
    watches_ = false;
    report_ = taken;
    for (Constraint& row : other.constraints) {
      if (!row.matched) interface.watched.push_back(std::move(row));
    }
  }

  /// A pair for each place where an edge of one side crosses one of the other; a place at a node is
  /// met by several edges and counts once.
  void pair_crossings(Interface& interface) {
    const FaceSide& secondary = sides_.secondary;
    const FaceSide& primary = sides_.primary;
    const Vector3& normal = secondary.face.mean_normal;
    std::set<std::pair<std::set<GlobalIndex>, std::set<GlobalIndex>>> known;
    for (std::size_t f = 0; f < secondary.face.facets.size(); ++f) {
      for (std::size_t g = 0; g < primary.face.facets.size(); ++g) {
        const Facet& edge = secondary.face.facets[f];
        const Facet& other = primary.face.facets[g];
        const auto crossing = cross_edges(*secondary.mesh, edge, *primary.mesh, other, normal);
        if (!crossing) continue;
        if (crossing->gap < -std::max(secondary.face.facet_depth[f], primary.face.facet_depth[g])) {
          ++report_.left_behind;
          report_.farthest_behind = std::max(report_.farthest_behind, -crossing->gap);
          continue;
        }
        Constraint constraint;
        const auto held = add_edge(primary.structure, other, crossing->second, 1, constraint);
        const auto holds = add_edge(secondary.structure, edge, crossing->first, -1, constraint);
        if (!known.insert({held, holds}).second) continue;
        constraint.matched = held.size() == 1 && holds.size() == 1;
        constraint.geometric_gap = crossing->gap;
        constraint.facet_size = primary.face.facet_size(g);
        if (contact_.filler) constraint.filler.area = 1;  // all places alike
        note_half_thickness(secondary, secondary.face.facet_half_thickness[f]);
        note_half_thickness(primary, primary.face.facet_half_thickness[g]);
        const Vector3 x = secondary.mesh->position(edge.nodes[0]);
        const Vector3 y = secondary.mesh->position(edge.nodes[1]);
        Vector3 place{};
        for (std::size_t d = 0; d < 3; ++d) place[d] = x[d] + crossing->first * (y[d] - x[d]);
        const auto [s, t] = in_plane(place, report_.normal, report_.tangent_axes);
        const double half =
            std::max(secondary.face.facet_half_width[f], primary.face.facet_half_width[g]);
        constraint.patch = {{{s - half, s + half}, {t - half, t + half}}};
        keep(place, std::move(constraint), interface);
      }
    }
  }

  /// Terms of a place on an edge, and the nodes that have a part in it.
  std::set<GlobalIndex> add_edge(int structure, const Facet& edge, double place, double sign,
                                 Constraint& constraint) const {
    std::set<GlobalIndex> nodes;
    for (const auto& [node, weight] :
         {std::pair(edge.nodes[0], 1 - place), std::pair(edge.nodes[1], place)}) {
      if (weight == 0) continue;
      add_terms(structure, node, sign * weight, sides_.secondary.face.mean_normal, constraint);
      nodes.insert(node);
    }
    return nodes;
  }

  /// Keeps the nodes of one side out of the facets of the other.
  void pair(const FaceSide& nodes, const FaceSide& facets, Interface& interface) {
    const double reach = (nodes.thickness + facets.thickness) / 2;
    const FacetFinder finder(*facets.mesh, facets.face, reach);
    if (contact_.filler && !watches_) {
      areas_ = has_lines() ? node_areas(nodes.face) : common_area(nodes, facets, finder);
      common_area_ += std::accumulate(areas_.begin(), areas_.end(), 0.0) / report_.passes;
    }
    lay_patches(nodes);
    std::optional<SlidingBuilder> sliding;
    if (contact_.sliding > 0 && !watches_) {
      sliding.emplace(contact_, number_, nodes, facets, finder, interface.sliding);
    }
    std::vector<FacetFinder::Result> results;
    std::vector<char> has_row;
    for (std::size_t i = 0; i < nodes.face.nodes.size(); ++i) {
      results.push_back(finder.find(nodes.mesh->position(nodes.face.nodes[i]),
                                    nodes.face.node_normals[i], nodes.face.node_half_thickness[i],
                                    nodes.face.node_depth[i]));
      has_row.push_back(results.back().faced || (sliding && sliding->may_face(i)) ? 1 : 0);
    }
    const std::vector<char> is_left_out = left_out(nodes, has_row);
    for (std::size_t i = 0; i < nodes.face.nodes.size(); ++i) {
      if (is_left_out[i] != 0) {
        ++report_.carried;
        continue;
      }
      const FacetFinder::Result& result = results[i];
      if (result.faced) {
        add_pair(nodes, i, facets, *result.faced, reach, interface);
        if (sliding) sliding->add_row(i, interface.constraints);
        continue;
      }
      if (sliding && sliding->may_face(i)) {
        Constraint open;
        open.geometric_gap = open_gap;
        finish(nodes, i, std::move(open), interface);
        sliding->add_row(i, interface.constraints);
      }
      if (&nodes == &sides_.primary) continue;  // the secondary's are reported
      ++report_.unmatched_nodes;
      if (result.behind < 0) {
        ++report_.left_behind;
        report_.farthest_behind = std::max(report_.farthest_behind, -result.behind);
      }
    }
  }

  /// Nodes without friction of their own, since those that they follow have it.
  std::vector<char> left_out(const FaceSide& nodes, const std::vector<char>& has_row) const {
    if (contact_.friction == 0 || contact_.filler) return std::vector<char>(has_row.size(), 0);
    return carried_nodes(*nodes.mesh, nodes.face, has_row);
  }

  void pair_with_wall(Interface& interface) {
    if (contact_.filler) {
      areas_ = node_areas(sides_.secondary.face);
      common_area_ = std::accumulate(areas_.begin(), areas_.end(), 0.0);
    }
    lay_patches(sides_.secondary);
    const std::vector<char> all(sides_.secondary.face.nodes.size(), 1);
    const std::vector<char> is_left_out = left_out(sides_.secondary, all);
    for (std::size_t i = 0; i < sides_.secondary.face.nodes.size(); ++i) {
      if (is_left_out[i] != 0) {
        ++report_.carried;
        continue;
      }
      Constraint constraint;
      constraint.matched = true;
      finish(sides_.secondary, i, std::move(constraint), interface);
    }
  }

  void add_pair(const FaceSide& nodes, std::size_t i, const FaceSide& facets,
                const FacedFacet& faced, double reach, Interface& interface) {
    const Facet& facet = facets.face.facets[faced.facet];
    const std::array<double, 4> weights = snapped(faced.point.weights);
    const Vector3& normal = nodes.face.node_normals[i];
    Constraint constraint;
    constraint.matched = std::ranges::find(weights, 1.0) != weights.end();
    for (std::size_t a = 0; a < static_cast<std::size_t>(facet.count); ++a) {
      if (weights[a] != 0) {
        add_terms(facets.structure, facet.nodes[a], weights[a], normal, constraint);
      }
    }
    constraint.geometric_gap = faced.gap;
    constraint.facet_size = facets.face.facet_size(faced.facet);
    if (facet.count == 2) constraint.facet_size = std::min(constraint.facet_size, reach);
    note_half_thickness(nodes, nodes.face.node_half_thickness[i]);
    note_half_thickness(facets, facets.face.facet_half_thickness[faced.facet]);
    finish(nodes, i, std::move(constraint), interface);
  }

  void note_half_thickness(const FaceSide& side, double half_thickness) {
    double& largest = report_.half_thickness[&side == &sides_.secondary ? 0 : 1];
    largest = std::max(largest, half_thickness);
  }

  void lay_patches(const FaceSide& nodes) {
    patches_ = node_patches(*nodes.mesh, nodes.face, report_.normal, report_.tangent_axes);
  }

  /// Adds the node's own terms, and keeps the constraint.
  void finish(const FaceSide& nodes, std::size_t i, Constraint&& constraint, Interface& interface) {
    const GlobalIndex node = nodes.face.nodes[i];
    if (contact_.filler && !watches_) constraint.filler.area = areas_[i];
    constraint.patch = patches_[i];
    add_terms(nodes.structure, node, -1, nodes.face.node_normals[i], constraint);
    keep(nodes.mesh->position(node), std::move(constraint), interface);
  }

  /// Keeps a constraint with its terms, which acts at a place.
  void keep(const Vector3& x, Constraint&& constraint, Interface& interface) {
    constraint.contact = number_;
    constraint.friction = contact_.friction;
    if (contact_.sliding > 0 && !watches_) constraint.facet_size = 2 * contact_.sliding;
    constraint.at = x;
    constraint.place = {x[report_.tangent_axes[0]], x[report_.tangent_axes[1]]};
    constraint.level = in_plane(x, report_.normal, report_.tangent_axes);
    if (constraint.geometric_gap < open_gap) ++report_.pairs;
    report_.matched += constraint.matched ? 1 : 0;
    interface.constraints.push_back(std::move(constraint));
  }

  void set_gaps(std::span<Constraint> constraints, std::span<Constraint> watched) {
    if (!contact_.gap.survey.empty()) {
      lay_survey(contacts_, contact_, constraints, watched, report_);
    }
    const GivenGap gap(contact_);
    const auto [low, high] = bounding_box(*sides_.secondary.mesh, sides_.secondary.face.nodes);
    const auto place_gap = [&, low = low, high = high](Constraint& row) {
      for (std::size_t t = 0; t < 2; ++t) {
        const int d = report_.tangent_axes[t];
        row.share[t] = high[d] > low[d] ? (row.place[t] - low[d]) / (high[d] - low[d]) : 0;
      }
      row.initial_gap = gap.of(row);
    };
    for (Constraint& row : watched) {
      place_gap(row);
      if (contact_.filler) fill_joint(contact_, row);
    }
    report_.smallest_gap = std::numeric_limits<double>::max();
    report_.largest_gap = -report_.smallest_gap;
    report_.geometric_gap = {report_.smallest_gap, report_.largest_gap};
    for (Constraint& constraint : constraints) {
      place_gap(constraint);
      if (constraint.geometric_gap == open_gap) continue;
      if (constraint.initial_gap < report_.smallest_gap) {
        report_.smallest_gap = constraint.initial_gap;
        report_.survey.narrowest = constraint.at;
      }
      report_.survey.mean_gap += constraint.initial_gap / report_.pairs;
      report_.largest_gap = std::max(report_.largest_gap, constraint.initial_gap);
      report_.overlapping += constraint.initial_gap < 0 ? 1 : 0;
      report_.geometric_gap = {std::min(report_.geometric_gap[0], constraint.geometric_gap),
                               std::max(report_.geometric_gap[1], constraint.geometric_gap)};
    }
    count_patches(contact_, constraints, report_);
    if (contact_.primary.is_wall()) {
      report_.geometric_gap.fill(std::numeric_limits<double>::quiet_NaN());
    }
  }

  /// Gaps given count from the places of the faces; a row that faces nothing yet gets the mean.
  void set_offsets(std::span<Constraint> constraints, SlidingFaces& sliding) const {
    const auto is_open = [](const Constraint& row) { return row.geometric_gap == open_gap; };
    double sum = 0;
    for (const Constraint& row : constraints) {
      if (!is_open(row)) sum += row.initial_gap - row.geometric_gap;
    }
    for (Constraint& row : constraints) {
      if (is_open(row)) row.initial_gap = open_gap;
    }
    const auto paired = static_cast<std::size_t>(
        std::ranges::count_if(constraints, [&](const Constraint& row) { return !is_open(row); }));
    for (SlidingFaces::Row& row : sliding.rows) {
      if (row.contact != number_) continue;
      const Constraint& own = constraints[static_cast<std::size_t>(row.constraint) - first_row_];
      row.offset =
          is_open(own) ? sum / static_cast<double>(paired) : own.initial_gap - own.geometric_gap;
    }
  }

  std::span<const Contact> contacts_;
  const Contact& contact_;
  int number_;
  bool watches_ = false;       ///< rows that are found are only looked at
  std::size_t first_row_ = 0;  ///< of the contact, in the interface
  ContactSides sides_;
  InterfaceReport report_;
  std::vector<Patch> patches_;  ///< of the nodes that are being paired
  std::vector<double> areas_;   ///< filler: of the nodes that are being paired [m2]
  double common_area_ = 0;      ///< filler: of the faces [m2]
};

}  // namespace

Interface find_interface(const Scene& scene, std::span<const GlobalMesh> meshes) {
  Interface interface;
  interface.model_size = bounding_box(meshes).longest_side();
  for (const GlobalMesh& mesh : meshes) interface.extents.push_back(bounding_box({&mesh, 1}));
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    if (scene.contacts[c].stop) {
      add_stop_rows(scene, meshes, static_cast<int>(c), interface);
    } else {
      PairFinder(scene, meshes, static_cast<int>(c)).find(interface);
    }
  }
  check_contacts(scene, interface);
  return interface;
}

}  // namespace pounding::interactions
