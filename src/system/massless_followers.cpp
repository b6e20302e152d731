#include "system/massless_followers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/dense_matrix.h"
#include "common/matrix3.h"

namespace pounding {
namespace {

constexpr double lent_part = 1e-6;
constexpr double least_part = 1e-4;  ///< of a body's mass that resists a motion of one of its dofs
constexpr std::size_t motions = 6;

using MotionRow = std::array<double, motions>;

/// A rigid body's motions about its centre of mass, rotations times a length of the body so that
/// all have one unit.
class Body {
 public:
  Body(const Mesh& mesh, const RigidPart& part, std::span<const double> lumped_mass)
      : mesh_(mesh), part_(part), lumped_mass_(lumped_mass) {
    find_centre();
    if (mass_ > 0) find_inertia();
  }

  void lend(std::vector<LentMass>& lent) const {
    if (mass_ == 0) return;
    double count = 0;
    for_each_dof(
        [&](LocalIndex, std::size_t, LocalIndex dof) { count += lumped_mass_[dof] > 0 ? 0 : 1; });
    for_each_dof([&](LocalIndex node, std::size_t c, LocalIndex dof) {
      if (lumped_mass_[dof] > 0) return;
      const MotionRow row = row_of(node, c);
      double compliance = 0;
      for (std::size_t i = 0; i < motions; ++i) {
        for (std::size_t j = 0; j < motions; ++j) {
          compliance += row[i] * inverse_[motions * i + j] * row[j];
        }
      }
      if (!(compliance * least_part < 1)) return;
      lent.emplace_back(dof, lent_part / count * mass_ / compliance * (c < 3 ? 1 : square_length_));
    });
  }

 private:
  template <typename Visit>
  void for_each_dof(const Visit& visit) const {
    for (const LocalIndex node : part_.nodes) {
      for (int c = 0; c < 6; ++c) {
        const LocalIndex dof = mesh_.dof(node, c);
        if (dof >= 0 && mesh_.follows(node, c)) {
          visit(node, static_cast<std::size_t>(c), dof);
        }
      }
    }
  }

  /// Mass, its centre, and the length: to the farthest node, or the radius of gyration of the parts
  /// that turn at the nodes.
  void find_centre() {
    double rotary = 0;
    for_each_dof([&](LocalIndex node, std::size_t c, LocalIndex dof) {
      if (c >= 3) {
        rotary += lumped_mass_[dof];
        return;
      }
      mass_ += lumped_mass_[dof];
      const Vector3 x = mesh_.position(node);
      for (std::size_t d = 0; d < 3; ++d) centre_[d] += lumped_mass_[dof] * x[d];
    });
    if (mass_ == 0) return;
    for (double& value : centre_) value /= mass_;
    for (const LocalIndex node : part_.nodes) {
      square_length_ = std::max(square_length_, square_between(mesh_.position(node), centre_));
    }
    square_length_ = std::max(square_length_, rotary / mass_);
    if (square_length_ == 0) square_length_ = 1;
  }

  MotionRow row_of(LocalIndex node, std::size_t c) const {
    Vector3 arm = mesh_.position(node);
    const double length = std::sqrt(square_length_);
    for (std::size_t d = 0; d < 3; ++d) arm[d] = (arm[d] - centre_[d]) / length;
    MotionRow row = rigid_motion_row(c, arm);
    for (std::size_t motion = 0; motion < motions; ++motion) {
      if ((part_.components >> motion & 1) == 0) row[motion] = 0;
    }
    return row;
  }

  /// Inverse of the body's mass matrix over its mass; a motion without mass comes out large.
  void find_inertia() {
    constexpr double floor = 1e-4 * least_part;
    inverse_.assign(motions * motions, 0.0);
    for (std::size_t i = 0; i < motions; ++i) inverse_[motions * i + i] = floor;
    for_each_dof([&](LocalIndex node, std::size_t c, LocalIndex dof) {
      const double part = lumped_mass_[dof] / mass_ / (c < 3 ? 1 : square_length_);
      const MotionRow row = row_of(node, c);
      for (std::size_t i = 0; i < motions; ++i) {
        for (std::size_t j = 0; j < motions; ++j) {
          inverse_[motions * i + j] += part * row[i] * row[j];
        }
      }
    });
    if (!invert_definite(inverse_)) mass_ = 0;
  }

  const Mesh& mesh_;
  const RigidPart& part_;
  std::span<const double> lumped_mass_;
  double mass_ = 0;  ///< over all directions [kg]
  Vector3 centre_{0, 0, 0};
  double square_length_ = 0;  ///< [m2]
  std::vector<double> inverse_;
};

/// Followers of a tie move by its carriers, which have mass.
void lend_to_followers(const Mesh& mesh, const RigidPart& part, std::span<const double> lumped_mass,
                       std::vector<LentMass>& lent) {
  for (const TiedNode& tied : part.tied) {
    const LocalIndex follower = mesh.owned_node(tied.node);
    double mass = 0;
    double square = 0;
    for (const Carrier& carrier : tied.carriers) {
      const LocalIndex node = mesh.owned_node(carrier.node);
      square = std::max(square, square_between(mesh.position(node), mesh.position(follower)));
      for (int c = 0; c < 3; ++c) {
        const LocalIndex dof = mesh.dof(node, c);
        if (dof >= 0) mass = std::max(mass, lumped_mass[dof]);
      }
    }
    for (int c = 0; c < 6; ++c) {
      const LocalIndex dof = mesh.dof(follower, c);
      if (dof < 0 || lumped_mass[dof] > 0 || mass == 0) continue;
      lent.emplace_back(dof, 0.1 * lent_part * mass * (c < 3 || square == 0 ? 1 : square));
    }
  }
}

}  // namespace

std::vector<LentMass> lend_mass(const Mesh& mesh, std::span<const double> lumped_mass) {
  std::vector<LentMass> lent;
  for (const RigidPart& part : mesh.rigid) {
    if (part.nodes.empty()) continue;
    if (part.kind == RigidKind::tie) {
      lend_to_followers(mesh, part, lumped_mass, lent);
    } else {
      Body(mesh, part, lumped_mass).lend(lent);
    }
  }
  std::ranges::sort(lent);
  return lent;
}

}  // namespace pounding
