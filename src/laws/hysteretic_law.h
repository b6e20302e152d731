#pragma once

#include <algorithm>
#include <memory>
#include <span>

#include "laws/hysteresis_path.h"

namespace pounding::interactions {

/// Law in one dimension of a step of central differences, a HysteresisPath F(e) made passive. With
/// its first slope k0 it holds between two elongations one step apart
///
///     E_{n+1/2} = f_n^2 / (2 k0) + U_n + 1/2 f_n (e_{n+1} - e_n),         U_n >= 0
///
/// so that the stable step is that of k0, and loses, with f* = f_{n-1} + k0 (e_n - e_{n-1}),
///
///     D_n = (f_n + f_{n-1}) (f* - f_n) / (2 k0) + U_{n-1} - U_n           >= 0
///
/// f_n is the force of the path, U_n the rest of the energy that it can give back, both as far as
/// D_n allows: a corner of the path inside of a step can make the mean force of the step give more
/// than the path does. Then U_n is less, and later losses fill it first; where none is left
/// f_n is the next force that gives nothing, for that step. Pure; the memory starts at 0.
class HystereticLaw {
 public:
  explicit HystereticLaw(const Hysteresis& law);

  /// Numbers of one memory.
  std::size_t memory_size() const { return of_the_law + path_->memory_size(); }
  /// Brings a memory to an elongation e_n [m]; `strength`: that of the path in this step.
  void advance(double elongation, std::span<double> memory, double strength = 1) const;

  /// Force f_n of a memory [N], after `advance` like all that follow.
  double force(std::span<const double> memory) const { return memory[force_now]; }
  /// E_{n+1/2} less 1/2 f_n (e_{n+1} - e_n) [J].
  double stored(std::span<const double> memory) const {
    return memory[force_now] * memory[force_now] / (2 * stiffness_) + memory[beyond];
  }
  double elongation(std::span<const double> memory) const { return memory[elongation_now]; }
  /// Sum of D_n [J].
  double lost(std::span<const double> memory) const { return memory[lost_so_far]; }
  /// Largest elongation over that of the first break of its direction, by the strength of its step,
  /// both less the elastic part in series; 0 before any.
  double ductility(std::span<const double> memory) const {
    return std::max(memory[most_plus], memory[most_minus]);
  }
  /// Whether it never went beyond the first break of a direction: f_n = k0 e_n.
  bool is_elastic(std::span<const double> memory) const { return within(ductility(memory)); }
  double tangent() const { return stiffness_; }

 private:
  enum Number : std::size_t {
    elongation_now,
    force_now,
    beyond,       ///< U
    lost_so_far,  ///< sum of D [J]
    on_path,
    most_plus,
    most_minus,
    of_the_law
  };

  bool within(double ductility) const {
    return first_plus_ > 0 && first_minus_ > 0 && ductility <= 1;
  }
  /// `advance` beyond the first corner.
  void yield(double elongation, std::span<double> memory, double strength) const;

  double stiffness_;
  double flexibility_;     ///< of the elastic part in series, see Hysteresis
  double first_plus_ = 0;  ///< elongations of the first breaks; 0: carries nothing
  double first_minus_ = 0;
  std::unique_ptr<HysteresisPath> path_;
};

}  // namespace pounding::interactions
