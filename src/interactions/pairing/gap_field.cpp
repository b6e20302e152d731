#include "interactions/pairing/gap_field.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <sstream>

#include "common/error.h"
#include "interactions/pairing/gap_survey.h"

namespace pounding::interactions {
namespace {

constexpr int wave_count = 4096;

/// Gap at a place on the secondary face from the one, two or four values of a contact.
double given_gap(const std::vector<double>& g, const std::array<double, 2>& s) {
  if (g.size() == 1) return g[0];
  if (g.size() == 2) return g[0] * (1 - s[0]) + g[1] * s[0];
  return (g[0] * (1 - s[0]) + g[1] * s[0]) * (1 - s[1]) + (g[3] * (1 - s[0]) + g[2] * s[0]) * s[1];
}

/// FNV-1a, so that contacts of one seed have fields of their own.
std::uint64_t seed_of(const Contact& contact) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char letter : contact.name) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  }
  return hash ^ static_cast<std::uint64_t>(contact.gap.seed) * 0x9E3779B97F4A7C15ULL;
}

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

GapField::GapField(const Contact& contact) {
  if (contact.gap.deviation == 0) return;
  size_ = contact.gap.deviation * std::sqrt(2.0 / wave_count);
  std::mt19937_64 bits(seed_of(contact));
  const auto uniform = [&] { return std::ldexp(static_cast<double>(bits() >> 11), -53); };
  constexpr double turn = 2 * std::numbers::pi;
  for (int i = 0; i < wave_count; ++i) {
    // The share of waves below k is 1 - (1 + length^2 k^2)^(-1/2).
    const double above = 1 - uniform();
    const double number = std::sqrt(1 / (above * above) - 1) / contact.gap.length;
    const double angle = turn * uniform();
    waves_.push_back({{number * std::cos(angle), number * std::sin(angle)}, turn * uniform()});
  }
}

double GapField::at(const std::array<double, 2>& place) const {
  double sum = 0;
  for (const Wave& wave : waves_) {
    sum += std::cos(wave.number[0] * place[0] + wave.number[1] * place[1] + wave.phase);
  }
  return size_ * sum;
}

int patch_at(const Contact& contact, const Constraint& row) {
  int found = static_cast<int>(contact.gap.patches.size()) - 1;
  while (found >= 0 && !contact.gap.patches[found].holds(row.place)) --found;
  return found;
}

void count_patches(const Contact& contact, std::span<const Constraint> rows,
                   InterfaceReport& report) {
  report.patch_pairs.assign(contact.gap.patches.size(), 0);
  for (const Constraint& row : rows) {
    if (row.geometric_gap == open_gap) continue;
    if (const int patch = patch_at(contact, row); patch >= 0) ++report.patch_pairs[patch];
  }
  const auto empty = std::ranges::find(report.patch_pairs, 0);
  if (empty == report.patch_pairs.end()) return;
  BoundingBox places;
  for (const Constraint& row : rows) places.include({row.place[0], row.place[1], 0});
  const auto& [low, high] = places;
  const auto axis = [&](std::size_t t) { return "xyz"[report.tangent_axes[t]]; };
  std::ostringstream text;
  text << "option -" << contact.name << "_gap_patches: patch "
       << empty - report.patch_pairs.begin() + 1
       << " holds no pair that another does not hold after it; the pairs lie between " << low[0]
       << " and " << high[0] << " m along " << axis(0) << ", " << low[1] << " and " << high[1]
       << " m along " << axis(1) << "; move it or make it larger";
  throw UserError(text.str());
}

double GivenGap::of(const Constraint& row) const {
  if (const int patch = patch_at(contact_, row); patch >= 0) return contact_.gap.patches[patch].gap;
  const InitialGap& gap = contact_.gap;
  const double base = !gap.survey.empty()   ? row.surveyed
                      : !gap.values.empty() ? given_gap(gap.values, row.share)
                                            : row.geometric_gap;
  return base - gap.static_closing.at(row.at[2]) + field_.at(row.level);
}

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

std::vector<Patch> node_patches(const GlobalMesh& mesh, const ContactFace& face,
                                const Vector3& normal, const std::array<int, 2>& axes) {
  std::map<GlobalIndex, BoundingBox> boxes;
  for (std::size_t f = 0; f < face.facets.size(); ++f) {
    const auto nodes = face.facets[f].corners();
    std::vector<std::array<double, 2>> places;
    std::array<double, 2> middle{};
    for (const GlobalIndex node : nodes) {
      const auto& [s, t] = places.emplace_back(in_plane(mesh.position(node), normal, axes));
      middle[0] += s / static_cast<double>(nodes.size());
      middle[1] += t / static_cast<double>(nodes.size());
    }
    const double s = places[1][0] - places[0][0];
    const double t = places[1][1] - places[0][1];
    const double half = nodes.size() == 2 ? face.facet_half_width[f] / std::hypot(s, t) : 0;
    const Vector3 across{half * std::abs(t), half * std::abs(s), 0};
    for (std::size_t a = 0; a < places.size(); ++a) {
      for (const auto& place : {places[a], middle}) {
        boxes[nodes[a]].include({place[0] - across[0], place[1] - across[1], 0});
        boxes[nodes[a]].include({place[0] + across[0], place[1] + across[1], 0});
      }
    }
  }
  std::vector<Patch> patches;
  for (const GlobalIndex node : face.nodes) {
    const auto& [low, high] = boxes[node];
    patches.push_back({{{low[0], high[0]}, {low[1], high[1]}}});
  }
  return patches;
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
  refuse_if(lines && !(filler.area > 0),
            "contact " + contact.name +
                ": one of its faces is made of lines, which have no area: give -" + contact.name +
                (contact.crushes() ? "_crushing_area" : "_filler_area"));
  double whole = 0;
  for (const Constraint& constraint : constraints) whole += constraint.filler.area;
  const double wanted = filler.area > 0 ? filler.area : common;
  refuse_if(!(whole > 0),
            "contact " + contact.name +
                ": its faces have no area in common that a node of the secondary one has a "
                "part of; name the face with the finer mesh as the secondary one");
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
