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

/// Dashpots in a step at mid-step, as DashpotLaw has it, a product each way in their modes:
///
///     w+ = w_free - U diag(g) U^T (w_free + w-),     g = h lambda / (1 + h lambda),     h = dt/2
///
/// (half of that h where forces act for half a step). `Value`: double, or Octet for eight runs of
/// the structure that share mass and dashpots. Local; nothing allocates after construction.
template <typename Value>
class DashpotBrake {
 public:
  explicit DashpotBrake(DashpotModes modes)
      : modes_(std::move(modes)),
        parts_(modes_.lambda.size(), Value{}),
        pull_(modes_.inverse_mass.size(), Value{}),
        sums_(modes_.inverse_mass.size(), Value{}) {}

  /// `velocity`: v_free of all coordinates, becomes v+; `before`: v-; `share`: of a step, for which
  /// forces act.
  void brake(double share, std::span<const Value> before, std::span<Value> velocity) {
    const Value zero{};
    const std::size_t size = velocity.size();
    share_ = share;
    for (std::size_t i = 0; i < size; ++i) sums_[i] = velocity[i] + before[i];
    multiply_rows(modes_.rows.data(), parts_.size(), size, sums_.data(), parts_.data());
    for (std::size_t j = 0; j < parts_.size(); ++j) {
      const double braked = share * modes_.time_step / 2 * modes_.lambda[j];
      parts_[j] = (zero + braked / (1 + braked)) * parts_[j];
    }
    multiply_transposed_rows(modes_.rows.data(), parts_.size(), size, parts_.data(), pull_.data());
    for (std::size_t i = 0; i < size; ++i) {
      velocity[i] = velocity[i] - (zero + modes_.inverse_mass[i]) * pull_[i];
      sums_[i] = velocity[i] + before[i];
    }
  }

  /// Energy that dashpots lost in that step [J]; `after`: v+ with contact.
  Value loss(std::span<const Value> before, std::span<const Value> after) const {
    Value sum{};
    for (std::size_t i = 0; i < pull_.size(); ++i) sum += loss_rate(i) * (after[i] + before[i]);
    return sum;
  }
  /// Its change with v+ of a coordinate after the dashpots [J s/m].
  Value loss_rate(std::size_t i) const { return (Value{} + 1 / (2 * share_)) * pull_[i]; }

  /// v- + v+ of that step, before contact.
  std::span<const Value> sums() const { return sums_; }

 private:
  DashpotModes modes_;
  std::vector<Value> parts_;  ///< per motion
  std::vector<Value> pull_;   ///< - M (v+ - v_free), per coordinate [kg m/s]
  std::vector<Value> sums_;   ///< per coordinate
  double share_ = 1;
};

}  // namespace pounding::interactions
