#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "scene/hysteresis.h"

namespace pounding::interactions {

/// Mean strains of a shell in local axes, exx, eyy, gxy, kxx, kyy, 2 kxy [-, 1/m], or the forces
/// and moments per length with which it answers, Nxx, Nyy, Nxy, Mxx, Myy, Mxy [N/m, N].
using ShellVector = std::array<double, 6>;

/// Shell of reinforced concrete that cracks by two damages, d1 of the face that negative curvatures
/// stretch and d2 of the other one, after the law GLRC_DM of Code_Aster (R7.01.32). Its energy per
/// area, with principal strains e_i, principal curvatures k_i and their sums,
///
///     psi = min over e3 of  lambda/2 xi(tr e) (tr e + e3)^2 + mu (sum xi(e_i) e_i^2 + e3^2)
///         + lambda_f/2 xi_f(tr k) (tr k)^2 + mu_f sum xi_f(k_i) k_i^2
///
///     xi(x)   = (1 + g d1) / (1 + d1) / 2 + (1 + g d2) / (1 + d2) / 2,   g = tension if x > 0,
///                                                                           compression else
///     xi_f(x) = (a + bending d) / (a + d),                               d = d2 if x > 0, d1 else
///
/// where x of xi(tr e) is tr e; forces are d psi / d strain, and -d psi / d d_j <= Y0 makes the
/// damages grow. psi + Y0 (d1 + d2) is convex: given e3, each damage is the root of an equation of
/// its own that falls monotonically, and e3 that of one that rises. Pure.
class CrackingShell {
 public:
  struct Damage {
    double lower = 0;  ///< d1
    double upper = 0;  ///< d2
    bool any() const { return lower > 0 || upper > 0; }
  };

  /// `cracking`: tension and bending below 1, force and moment above 0. [Pa, -, m]
  CrackingShell(double young, double poisson, double thickness, const ShellCracking& cracking);

  /// A law with ratios of its energy in place of slopes of force and moment: a strip that is
  /// pulled or bent along one axis, free to contract across, has these slopes over the sound one's
  /// as its damages grow. Given ones at Poisson's ratio 0; a tension above 1 has none.
  static ShellCracking with_slopes(ShellCracking slopes, double poisson);

  /// Largest damages that strains have made, from those before them.
  Damage grown(const ShellVector& strains, const Damage& before) const;
  /// psi [J/m2].
  double energy(const ShellVector& strains, const Damage& damage) const;
  /// d psi / d strains.
  ShellVector forces(const ShellVector& strains, const Damage& damage) const;
  /// Strains over those, in their proportion, at which damage begins; 1 at the threshold.
  double loading(const ShellVector& strains) const;
  /// Upper bound of its square, without principal values.
  double loading_bound(const ShellVector& strains) const;

  /// Forces of the sound shell, D0 e.
  ShellVector sound_forces(const ShellVector& strains) const;
  /// a . D0^-1 b of two vectors of forces [J/m2].
  double complementary(const ShellVector& a, const ShellVector& b) const;

  double threshold() const { return threshold_; }  ///< Y0 [J/m2]

 private:
  struct Drive;
  Drive drive_of(const ShellVector& strains) const;
  Damage grown_at(const Drive& drive, double sum, const Damage& before) const;
  double grown_one(double membrane, double bending, double before) const;
  double retained(double strain, const Damage& damage) const;        ///< xi
  double retained_in_bending(double strain, const Damage& d) const;  ///< xi_f
  double ratio(double strain) const { return strain > 0 ? tension_ : compression_; }
  double sum_of_strains(double trace, double retained) const {  ///< tr e + e3
    return 2 * mu_ * trace / (2 * mu_ + lambda_ * retained);
  }

  double tension_, compression_, bending_;
  double poisson_;
  double lambda_ = 0, mu_ = 0;      ///< [N/m]
  double lambda_f_ = 0, mu_f_ = 0;  ///< [N m]
  double threshold_ = 0;
  double alpha_ = 0;  ///< a
};

/// Law of a step of central differences for a CrackingShell, made passive as HystereticLaw is: with
/// |N|^2 = N . D0^-1 N it holds per area
///
///     E_{n+1/2} = |N_n|^2 / 2 + U_n + 1/2 N_n . (e_{n+1} - e_n),          U_n >= 0
///
/// and loses ((N_{n-1} + m)^2 - (N_n - m)^2) / 2 + U_{n-1} - U_n >= 0, m = D0 (e_n - e_{n-1}) / 2.
/// N_n is d psi / d e, U_n the rest of psi, both as far as that allows. The memory starts at 0.
class CrackingLaw {
 public:
  explicit CrackingLaw(const CrackingShell& shell) : shell_(shell) {}

  static constexpr std::size_t memory_size() { return numbers; }
  /// Brings a memory to strains e_n.
  void advance(const ShellVector& strains, std::span<double> memory) const;
  ShellVector strains(std::span<const double> memory) const { return vector(memory, strains_now); }
  ShellVector forces(std::span<const double> memory) const { return vector(memory, forces_now); }
  /// E_{n+1/2} less 1/2 N_n . (e_{n+1} - e_n) [J/m2].
  double stored(std::span<const double> memory) const;
  double lost(std::span<const double> memory) const { return memory[lost_so_far]; }
  double loading(std::span<const double> memory) const { return memory[most]; }
  /// Whether nothing is damaged: N_n = D0 e_n.
  bool is_sound(std::span<const double> memory) const { return !damage(memory).any(); }
  CrackingShell::Damage damage(std::span<const double> memory) const {
    return {memory[damage_now], memory[damage_now + 1]};
  }
  const CrackingShell& shell() const { return shell_; }

 private:
  enum Number : std::size_t {
    strains_now,
    forces_now = 6,
    damage_now = 12,
    beyond = 14,  ///< U
    lost_so_far,
    most,  ///< largest loading
    numbers
  };
  static ShellVector vector(std::span<const double> memory, std::size_t first);

  CrackingShell shell_;
};

}  // namespace pounding::interactions
