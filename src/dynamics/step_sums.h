#pragma once

#include <array>

#include "dynamics/update.h"
#include "interactions/interaction.h"

namespace pounding {

/// Sums over the owned dofs of a structure that one step leaves for the energy balance, with
/// v- = v_{n-1/2}, v+ = v_{n+1/2}, s = v+ + v-, and those of interactions. The support input
/// is that of the loads on the dofs as well.
struct StepSums : interactions::LedgerPart {
  double stiffness_work = 0;         ///< q^T s [W]
  double mass_sum = 0;               ///< s^T M s [J]
  std::array<double, 3> momentum{};  ///< iota_d^T M s [kg m/s]
  double filtered = 0;               ///< (f - q)^T s, f the force that uniform damping filters [W]
  double device = 0;                 ///< x^T s, x the force of the extra damping [W]
  double load = 0;                   ///< sum_l f_l p_l^T s of loads [W], in the support input too
  double kinetic_before = 0;         ///< v-^T M v- [J], if energies are asked for
  double added_kinetic_before = 0;   ///< v-^T S v- [J] likewise
  double stiffness_before = 0;       ///< v-^T K v- [W] likewise
  double strain_before = 0;          ///< u_n^T K u_{n-1} [J] likewise
  double strain_back = 0;            ///< u_{n-1}^T K u_n [J] likewise: the same as K is symmetric
  double displacement_mass = 0;      ///< u_n^T M u_n [kg m2] likewise
  double extra_damping_before = 0;   ///< v-^T D v- [W], D the damping beside alpha M + beta K
  double rest_before = 0;            ///< (K u_0)^T (u_0 / 2 - u_n + dt/2 v-) where uniform damping
                                     ///< acts about a rest u_0 [J], if energies are asked for
};

/// Adds the lanes of dofs to the sums of their structure.
template <typename Value>
void add_to(const DofSums<Value>& from, StepSums& sums) {
  sums.stiffness_work += add_up(from.stiffness_work);
  sums.mass_sum += add_up(from.mass_sum);
  sums.filtered += add_up(from.filtered);
}

/// Adds the energies of dofs likewise.
template <typename Value>
void add_to(const DofEnergies<Value>& from, StepSums& sums) {
  sums.kinetic_before += add_up(from.kinetic_before);
  sums.stiffness_before += add_up(from.stiffness_before);
  sums.strain_before += add_up(from.strain_before);
  sums.strain_back += add_up(from.strain_back);
  sums.displacement_mass += add_up(from.displacement_mass);
}

}  // namespace pounding
