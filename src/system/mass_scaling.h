#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Time step [s] above which central differences with lagged damping let a motion x grow, from its
/// Rayleigh quotients c = x^T C x / x^T M x [1/s] and k = x^T K x / x^T M x [1/s2]:
///
///     4 - 2 dt c - dt^2 k = 0,      dt = 4 / (c + sqrt(c^2 + 4 k))
///
/// The scheme is stable if and only if dt is below this for every x, that is, if 4 M - 2 dt C -
/// dt^2 K is positive definite. Infinite where c and k are 0.
inline double critical_time_step(double damping_rate, double squared_frequency) {
  return 4 / (damping_rate + std::hypot(damping_rate, 2 * std::sqrt(squared_frequency)));
}

/// Selective mass scaling: the few stiff beams, bars (but not tension-only ones) and springs that
/// would hold the time step of a structure below the wanted one get mass in proportion to their
/// stiffness, S_e = c_e K_e, with
///
///     c_e = max(0, (2 dt beta + dt^2) / 4 - (1 - dt alpha / 2) / omega_e^2)
///
/// and omega_e the element's own largest frequency. Then, at the wanted dt,
///
///     4 (M_e + S_e) - 2 dt C_e - dt^2 K_e >= 0,      C_e = alpha M_e + beta K_e
///
/// so that these elements do not limit the step any more, damping included. Rigid motions have no
/// part in S_e; a mode of frequency omega changes by c omega^2 times the share of its strain energy
/// in these elements.
struct MassScaling {
  double time_step = 0;       ///< wanted [s]; 0: nothing is scaled
  GlobalIndex elements = 0;   ///< scaled, over all ranks
  GlobalIndex dofs = 0;       ///< that S couples, over all ranks
  double largest_factor = 0;  ///< largest c_e [s2]
  /// Root of the largest row sum of |K_e| over the lumped mass, scaled elements and those that meet
  /// rigid bodies [rad/s]: the bound of omega_max without S and bodies.
  double row_frequency = 0;
};

/// Offer to scale mass: the step for which an earthquake costs least. Found from the bounds of
/// single elements.
struct ScalingOffer {
  double time_step = 0;      ///< to scale for [s]; 0: nothing is to be gained
  double allowed = 0;        ///< that it is sure to give [s]
  double cost = 1;           ///< of such a step, over one without scaled mass
  double share = 0;          ///< of the dofs that the scaled mass couples
  GlobalIndex elements = 0;  ///< that allow less than `time_step` by themselves
  std::string groups;        ///< of them
};

/// c_e [s2]; `frequency` [rad/s] is infinite for an element that holds dofs without mass;
/// `stiffening` is the factor on K for the fastest motions.
double mass_scaling_factor(double time_step, const Rayleigh& damping, double frequency,
                           double stiffening = 1);

/// Step [s] up to which scaled mass moves no frequency below 400 Hz by more than 1 %, whatever it
/// scales: dt / 4 (2 beta + s dt) (2 pi f)^2 / 2 = 1 %, with s = `stiffening`.
double longest_scaled_step(const Rayleigh& damping, double stiffening);

/// Whether elements of a type get scaled mass where they hold the step; for a target of the time
/// step beams, bars and springs alone.
bool may_scale(const Structure& structure, ElementType type);

/// Part of the wanted step that shells and solids must not allow by themselves to be scaled: those
/// of a regular mesh allow together up to 1.3 times the step of each.
inline constexpr double holding_part_of_meshes = 0.7;

/// That part for elements of a type; all of the step for beams, bars and springs.
double holding_part(ElementType type);

/// Whether an element holds a dof to which it gives no mass: it has no frequency of its own.
/// `stiffness` of shape (n, n), `lumped_mass` of shape (n).
bool holds_massless(std::span<const double> stiffness, std::span<const double> lumped_mass);

/// Adds S_e, shape (n, n) [kg, kg m2], of an element with the given matrices, and returns c_e. Does
/// nothing and returns 0 where the element allows `part` of the wanted step by itself.
double add_element_mass(double time_step, const Rayleigh& damping,
                        std::span<const double> stiffness, std::span<const double> lumped_mass,
                        std::span<double> added, double stiffening = 1, double part = 1);

/// Blocks that the factor of one group may have beside its diagonal, each kept twice: 0.6 GB.
inline constexpr std::size_t most_factor_blocks = 1000000;

/// Nodes that scaled elements, links, rigid bodies or water connect, group by group: M + S couples
/// the dofs of the ones, the step solves for forces or motion of the others together, so one rank
/// must own them. Elements that meet a rigid body are not scaled.
/// `structure_number` is copied. Throws UserError where alpha alone forbids the wanted step or the
/// factor of a group has more than `most_blocks`. Serial.
std::vector<NodeCluster> coupled_nodes(const Structure& structure, const GlobalMesh& mesh,
                                       int structure_number,
                                       std::size_t most_blocks = most_factor_blocks);

}  // namespace pounding
