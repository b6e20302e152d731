#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/row_products.h"
#include "system/linear_system.h"

namespace pounding::interactions {

/// The dashpots of a structure in generalised coordinates as rows over these.
struct DashpotRows {
  std::vector<double> rows;       ///< B, shape (dashpots, coordinates)
  std::vector<double> strengths;  ///< c [N s/m, N m s]

  bool operator==(const DashpotRows& other) const = default;
};

/// The links of a structure in generalised coordinates as rows over these, shape (links,
/// coordinates). Local.
std::vector<double> link_rows(const LinearSystem& system);

/// The dashpots of a structure whose links are all dashpots, which no wave drives and no support
/// carries; none of any other. Local.
std::optional<DashpotRows> dashpot_rows(const LinearSystem& system);

/// The dashpots of a structure in generalised coordinates, all of them together. In w = M^1/2 v
/// their matrix is diagonal in its eigenvectors,
///
///     M^-1/2 B^T diag(c) B M^-1/2 = U diag(lambda) U^T.
///
/// Mats are stiff: hundreds of dashpots under one brake some dozens of motions. Those that nothing
/// is left of in a run are left out. Local.
struct DashpotModes {
  DashpotModes(const LinearSystem& system, const DashpotRows& dashpots, double step);

  std::vector<double> inverse_mass;  ///< per coordinate
  std::vector<double> lambda;        ///< per motion [1/s]
  std::vector<double> rows;          ///< U^T M^1/2, shape (motions, coordinates)
  double time_step;                  ///< [s]
};

/// The matrix of those dashpots in a step at mid-step, as DashpotLaw has it:
///
///     G = M^1/2 U diag(g) U^T M^1/2,     g = h lambda / (1 + h lambda),     h = dt/2
///
/// (half of that h where forces act for half a step). Local; nothing allocates after construction.
class DashpotMatrix {
 public:
  explicit DashpotMatrix(DashpotModes modes);

  /// Makes it the matrix of steps in which forces act for this share of the time step.
  void set_share(double share);

  /// out = G x. As rows of motions, both ways, or as a full matrix, whichever is less to multiply.
  template <typename Value>
  void multiply(std::span<const Value> x, std::span<Value> parts, std::span<Value> out) const {
    if (full_.empty()) {
      multiply_both_ways(modes_.rows.data(), weights_.data(), weights_.size(), x.size(), x.data(),
                         parts.data(), out.data());
    } else {
      multiply_rows(full_.data(), x.size(), x.size(), x.data(), out.data());
    }
  }

  std::size_t motions() const { return weights_.size(); }
  double share() const { return share_; }
  /// Per coordinate.
  const std::vector<double>& inverse_mass() const { return modes_.inverse_mass; }

 private:
  DashpotModes modes_;
  std::vector<double> weights_;  ///< g, per motion
  std::vector<double> full_;     ///< G, shape (coordinates, coordinates); empty as rows
  double share_ = 0;
};

/// The brake of dashpots on velocities in a step, a product in all:
///
///     w+ = w_free - U diag(g) U^T (w_free + w-)
///
/// `Value`: double, or BatchValue for eight runs of the structure that share mass and dashpots.
/// Local; nothing allocates after construction.
template <typename Value>
class DashpotBrake {
 public:
  explicit DashpotBrake(DashpotModes modes)
      : matrix_(std::move(modes)),
        parts_(matrix_.motions(), Value{}),
        pull_(matrix_.inverse_mass().size(), Value{}),
        sums_(pull_) {}

  /// `velocity`: v_free of all coordinates, becomes v+; `before`: v-; `share`: of a step, for which
  /// forces act.
  void brake(double share, std::span<const Value> before, std::span<Value> velocity) {
    const std::size_t size = velocity.size();
    const std::vector<double>& inverse_mass = matrix_.inverse_mass();
    for (std::size_t i = 0; i < size; ++i) sums_[i] = velocity[i] + before[i];
    matrix_.set_share(share);
    matrix_.multiply<Value>(sums_, parts_, pull_);
    for (std::size_t i = 0; i < size; ++i) {
      velocity[i] = velocity[i] - (Value{} + inverse_mass[i]) * pull_[i];
      sums_[i] = velocity[i] + before[i];
    }
  }

  /// Energy that dashpots lost in that step [J]; `after`: v+ with contact.
  Value loss(std::span<const Value> before, std::span<const Value> after) const {
    Value sum{};
    for (std::size_t i = 0; i < pull_.size(); ++i) sum += loss_rate(i) * (after[i] + before[i]);
    return sum;
  }
  /// Change of the loss with v+ of a coordinate after the dashpots [J s/m].
  Value loss_rate(std::size_t i) const { return (Value{} + 1 / (2 * matrix_.share())) * pull_[i]; }

  /// v- + v+ of that step, before contact.
  std::span<const Value> sums() const { return sums_; }

 private:
  DashpotMatrix matrix_;
  std::vector<Value> parts_;  ///< per motion
  std::vector<Value> pull_;   ///< - M (v+ - v_free), per coordinate [kg m/s]
  std::vector<Value> sums_;   ///< per coordinate
};

}  // namespace pounding::interactions
