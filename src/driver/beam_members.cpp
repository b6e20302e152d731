#include "driver/beam_members.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pounding {
namespace {

/// Beams are in one line whose directions turn by less than about 2.5 degrees.
constexpr double in_line = 0.999;

/// Part of an axis along x, y or z that a clamp of this component must hold.
constexpr double held_part = 0.1;

/// Whether a mask of components holds those of an axis, from `first` on.
bool holds(std::uint8_t mask, int first, const Vector3& axis) {
  for (int d = 0; d < 3; ++d) {
    if (std::abs(axis[static_cast<std::size_t>(d)]) > held_part && (mask >> (first + d) & 1) == 0) {
      return false;
    }
  }
  return true;
}

}  // namespace

double BeamPiece::bending(const Vector3& axis) const {
  const double y = dot(axis, axes[1]);
  const double z = dot(axis, axes[2]);
  return region->material.young *
         (region->section->inertia_y * y * y + region->section->inertia_z * z * z);
}

double BeamPiece::shear() const {
  return region->material.young / (2 * (1 + region->material.poisson)) * region->section->area;
}

double BeamPiece::mass() const {
  return (region->material.density * region->section->area + region->added_mass) * length;
}

BeamChains::BeamChains(const Structure& structure, const GlobalMesh& mesh) : mesh_(mesh) {
  for (const ElementSet& set : mesh.regions) {
    if (is_beam(set.type)) add_beams(structure.regions[static_cast<std::size_t>(set.region)], set);
  }
  if (beams_.empty()) return;
  collect(structure);
  is_arm_.assign(beams_.size(), false);
  trace();
  std::vector<bool> arms(beams_.size(), false);
  for (const BeamChain& chain : chains_) {
    const bool ends_free =
        is_free_end(chain.nodes.front(), chain) || is_free_end(chain.nodes.back(), chain);
    for (const int beam : chain.beams) arms[static_cast<std::size_t>(beam)] = ends_free;
  }
  is_arm_ = std::move(arms);
  trace();
}

void BeamChains::add_beams(const Region& region, const ElementSet& set) {
  for (std::size_t e = 0; e < set.tags.size(); ++e) {
    BeamPiece beam;
    beam.nodes = {set.connectivity[2 * e], set.connectivity[2 * e + 1]};
    beam.region = &region;
    const Vector3 along = minus(mesh_.position(beam.nodes[1]), mesh_.position(beam.nodes[0]));
    beam.length = norm(along);
    const Vector3 x = normalised(along);
    const Vector3 y = normalised(cross(region.section->z_axis, x));
    beam.axes = {x, y, cross(x, y)};
    if (!(norm(y) > 0)) continue;  // refused when it is assembled
    for (const GlobalIndex node : beam.nodes) {
      joints_[node].beams.push_back(static_cast<int>(beams_.size()));
    }
    beams_.push_back(beam);
  }
}

void BeamChains::collect(const Structure& structure) {
  for (const ElementSet& set : mesh_.regions) {
    if (is_beam(set.type)) continue;
    const Region& region = structure.regions[static_cast<std::size_t>(set.region)];
    const auto nodes = static_cast<std::size_t>(traits_of(set.type).layout.nodes);
    for (std::size_t i = 0; i < set.connectivity.size(); ++i) {
      const auto found = joints_.find(set.connectivity[i]);
      if (found == joints_.end()) continue;
      Joint& joint = found->second;
      joint.joined = joint.joined || (has_extent(set.type) && !is_shell(set.type));
      joint.on_shell = joint.on_shell || is_shell(set.type);
      if (traits_of(set.type).family == ElementFamily::point_mass) {
        joint.mass += region.mass * set.share_of(i / nodes);
      }
      if (!is_spring(set.type)) continue;
      for (std::size_t d = 0; d < 3; ++d) {
        joint.spring[d] += region.stiffness[3 + d] * set.share_of(i / nodes);
      }
    }
    if (is_shell(set.type)) find_ribs(set);
  }
  for (const RigidNodes& body : mesh_.rigid) {
    for (const GlobalIndex node : body.nodes) {
      const auto found = joints_.find(node);
      if (found == joints_.end()) continue;
      found->second.in_bodies |= body.kind == RigidKind::tie ? 0x3f : body.components;
    }
  }
}

void BeamChains::find_ribs(const ElementSet& set) {
  const auto count = static_cast<std::size_t>(traits_of(set.type).layout.nodes);
  for (std::size_t i = 0; i < set.connectivity.size(); ++i) {
    const std::size_t element = i / count;
    const GlobalIndex node = set.connectivity[i];
    const GlobalIndex after = set.connectivity[element * count + (i - element * count + 1) % count];
    const auto found = joints_.find(node);
    if (found == joints_.end()) continue;
    for (const int beam : found->second.beams) {
      BeamPiece& piece = beams_[static_cast<std::size_t>(beam)];
      if (std::ranges::find(piece.nodes, after) != piece.nodes.end()) piece.is_rib = true;
    }
  }
}

Vector3 BeamChains::direction_from(GlobalIndex node, int beam) const {
  const BeamPiece& piece = beams_[static_cast<std::size_t>(beam)];
  const double sign = piece.nodes[0] == node ? 1 : -1;
  const Vector3& x = piece.axes[0];
  return {sign * x[0], sign * x[1], sign * x[2]};
}

/// The beam in which a chain goes on beyond a node; -1: it ends there.
int BeamChains::next(GlobalIndex node, int beam) const {
  const Joint& joint = joints_.at(node);
  const bool is_rib = beams_[static_cast<std::size_t>(beam)].is_rib;
  if (joint.joined || (joint.on_shell && !is_rib)) return -1;
  int found = -1;
  for (const int other : joint.beams) {
    if (other == beam) continue;
    const auto o = static_cast<std::size_t>(other);
    const bool goes_on = dot(direction_from(node, beam), direction_from(node, other)) < -in_line &&
                         beams_[o].is_rib == is_rib;
    if (goes_on && found >= 0) return -1;
    if (goes_on) found = other;
    if (!goes_on && !is_arm_[o] && !(is_rib && beams_[o].is_rib)) return -1;
  }
  return found;
}

void BeamChains::extend(GlobalIndex node, int beam, BeamChain& chain,
                        std::vector<bool>& used) const {
  for (;;) {
    used[static_cast<std::size_t>(beam)] = true;
    const BeamPiece& piece = beams_[static_cast<std::size_t>(beam)];
    node = piece.nodes[0] == node ? piece.nodes[1] : piece.nodes[0];
    chain.beams.push_back(beam);
    chain.nodes.push_back(node);
    chain.length += piece.length;
    beam = next(node, beam);
    if (beam < 0 || used[static_cast<std::size_t>(beam)]) return;
  }
}

void BeamChains::trace() {
  chains_.clear();
  chain_of_.assign(beams_.size(), -1);
  std::vector<bool> used(beams_.size(), false);
  for (std::size_t b = 0; b < beams_.size(); ++b) {
    if (used[b]) continue;
    BeamChain back;  // to the end of the chain, from where it is followed anew
    extend(beams_[b].nodes[1], static_cast<int>(b), back, used);
    for (const int beam : back.beams) used[static_cast<std::size_t>(beam)] = false;
    const int last = back.beams.back();
    BeamChain chain;
    chain.nodes.push_back(back.nodes.back());
    extend(back.nodes.back(), last, chain, used);
    for (const int beam : chain.beams) {
      chain_of_[static_cast<std::size_t>(beam)] = static_cast<int>(chains_.size());
    }
    chains_.push_back(std::move(chain));
  }
}

bool BeamChains::is_free_end(GlobalIndex node, const BeamChain& chain) const {
  const Joint& joint = joints_.at(node);
  if (joint.joined || joint.on_shell || joint.in_bodies != 0) return false;
  if (mesh_.free_components[static_cast<std::size_t>(node)] !=
      mesh_.components[static_cast<std::size_t>(node)]) {
    return false;
  }
  if (joint.spring != std::array<double, 3>{}) return false;
  return std::ranges::all_of(joint.beams, [&](int beam) {
    return beam == chain.beams.front() || beam == chain.beams.back() ||
           is_arm_[static_cast<std::size_t>(beam)];
  });
}

double BeamChains::turning_stiffness(GlobalIndex node, const BeamChain& chain,
                                     const Vector3& axis) const {
  const Joint& joint = joints_.at(node);
  const int own = node == chain.nodes.front() ? chain.beams.front() : chain.beams.back();
  const bool by_shell = joint.on_shell && !beams_[static_cast<std::size_t>(own)].is_rib;
  if (by_shell || is_clamped_about(node, axis) || is_in_body(node, axis)) {
    return std::numeric_limits<double>::infinity();
  }
  double stiffness = 0;
  for (std::size_t d = 0; d < 3; ++d) stiffness += joint.spring[d] * axis[d] * axis[d];
  for (const int other : joint.beams) {
    const auto o = static_cast<std::size_t>(other);
    if (other == own || is_arm_[o]) continue;
    if (std::abs(dot(direction_from(node, own), direction_from(node, other))) > in_line) continue;
    const double length = chains_[static_cast<std::size_t>(chain_of_[o])].length;
    stiffness += 6 * beams_[o].bending(axis) / length;
  }
  return stiffness;
}

bool BeamChains::is_clamped_along(GlobalIndex node, const Vector3& axis) const {
  const auto n = static_cast<std::size_t>(node);
  return holds(mesh_.components[n] & ~mesh_.free_components[n], 0, axis);
}

bool BeamChains::is_clamped_about(GlobalIndex node, const Vector3& axis) const {
  const auto n = static_cast<std::size_t>(node);
  return holds(mesh_.components[n] & ~mesh_.free_components[n], 3, axis);
}

bool BeamChains::is_in_body(GlobalIndex node, const Vector3& axis) const {
  return holds(joints_.at(node).in_bodies, 3, axis);
}

}  // namespace pounding
