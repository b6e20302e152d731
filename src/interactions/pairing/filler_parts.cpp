#include "interactions/pairing/filler_parts.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "common/error.h"

namespace pounding::interactions {
namespace {

/// Part of the joint by which a filler may be thicker for round-off.
constexpr double thicker = 1e-9;

void require_room(const Contact& contact, const Constraint& constraint) {
  const double thickness = contact.filler->thickness;
  const double width = constraint.initial_gap;
  if (contact.crushes()) {
    if (width >= 0) return;
    std::ostringstream text;
    text << "contact " << contact.name << ": the faces overlap by " << -width
         << " m somewhere, and the strip to crush is intact at the start; give -" << contact.name
         << "_gap, or move a mesh";
    throw UserError(text.str());
  }
  if (width > 0 && thickness <= width * (1 + thicker)) return;
  std::ostringstream text;
  text << "contact " << contact.name << ": the joint is " << width << " m wide somewhere, ";
  if (width > 0) {
    text << "less than its filler of " << thickness << " m; give a thinner one with -"
         << contact.name << "_filler_thickness, or leave that out";
  } else {
    text << "with no room for a filler; give -" << contact.name << "_gap, or move a mesh";
  }
  throw UserError(text.str());
}

}  // namespace

std::vector<double> node_areas(const ContactFace& face) {
  std::map<GlobalIndex, double> share;
  for (std::size_t f = 0; f < face.facets.size(); ++f) {
    for (const GlobalIndex node : face.facets[f].corners()) {
      share[node] += face.facet_area(f) / static_cast<double>(face.facets[f].count);
    }
  }
  std::vector<double> areas;
  for (const GlobalIndex node : face.nodes) areas.push_back(share[node]);
  return areas;
}

void fill_joint(const Contact& contact, Constraint& constraint) {
  if (contact.is_elastic()) {
    constraint.filler = {1, 0, constraint.initial_gap};
    return;
  }
  require_room(contact, constraint);
  const Filler& filler = *contact.filler;
  FillerPart& part = constraint.filler;
  if (contact.crushes()) {
    part.thickness = part.depth = filler.thickness;
    part.clearance = constraint.initial_gap;
    constraint.initial_gap += part.depth;
    return;
  }
  part.thickness = filler.thickness > 0 ? filler.thickness : constraint.initial_gap;
  part.clearance = constraint.initial_gap - part.thickness;
  constraint.initial_gap -= part.thickness * (1 - filler.dense());
}

void lay_filler(const Contact& contact, bool lines, double common,
                std::span<Constraint> constraints, InterfaceReport& report) {
  const Filler& filler = *contact.filler;
  if (lines && !(filler.area > 0)) {
    throw UserError("contact " + contact.name +
                    ": one of its faces is made of lines, which have no area: give -" +
                    contact.name + (contact.crushes() ? "_crushing_area" : "_filler_area"));
  }
  double whole = 0;
  for (const Constraint& constraint : constraints) whole += constraint.filler.area;
  const double wanted = filler.area > 0 ? filler.area : common;
  if (!(whole > 0)) {
    throw UserError("contact " + contact.name +
                    ": its faces have no area in common that a node of the secondary one has a "
                    "part of; name the face with the finer mesh as the secondary one");
  }
  report.filler_area = wanted;
  for (Constraint& constraint : constraints) {
    fill_joint(contact, constraint);
    FillerPart& part = constraint.filler;
    part.area *= wanted / whole;
    const bool first = &constraint == constraints.data();
    auto& [least, most] = report.filler_thickness;
    least = first ? part.thickness : std::min(least, part.thickness);
    most = first ? part.thickness : std::max(most, part.thickness);
  }
}

}  // namespace pounding::interactions
