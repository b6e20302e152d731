#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mpi.h>

#include "common/types.h"
#include "laws/element_law.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "stiffness/stiffness.h"
#include "system/coupled_mass.h"
#include "system/mass_scaling.h"
#include "system/rigid_body.h"
#include "system/rotary_scaling.h"
#include "system/slivers.h"

namespace pounding {

class Links;
struct LoadShapes;
struct StartState;
struct SupportShapes;
struct SwitchedModes;

/// A displacement component of a node, by numbers that do not depend on the partition.
struct TracePoint {
  GlobalIndex node = 0;  ///< file order
  int component = 0;     ///< 0-2
  auto operator<=>(const TracePoint&) const = default;
};

/// Generalised coordinates q of a body whose motion is u = Phi q, in place of the nodes of a mesh.
/// One rank owns them all.
struct GeneralisedCoordinates {
  /// iota of each direction [kg^1/2]: M_q^-1 Phi^T M iota with M_q the mass of the coordinates, 1
  /// for a basis orthonormal in M.
  std::array<std::vector<double>, 3> influence;
  std::map<TracePoint, std::size_t> row_of;  ///< places whose displacement is known
  std::vector<double> rows;                  ///< of Phi, shape (places, owned dofs) [kg^-1/2]
};

/// Force of the water in pools with cells by its pressure for a ground that is accelerated by 1
/// along each axis, its pressure on held nodes counted [kg]; on the dofs of this rank that it
/// presses on.
struct WaterLoad {
  std::vector<LocalIndex> dofs;
  std::array<std::vector<double>, 3> force;
};

/// One building as a linear second-order system in the ground frame, whatever its origin:
///
///     (M + S) u'' + C u' + K u = -M iota a_g(t) + sum_l f_l(t) p_l + L^T r
///     C = alpha M + beta K + D
///
/// or, with uniform damping over a band, s G K in place of K (see UniformDamping) and C = D, where
/// the motions u are those that rigid bodies and ties admit (see RigidBody, TiedPart), with M
/// diagonal, D the damping beside alpha and beta (dashpots, and regions damped otherwise), and S
/// the mass that stiff elements are given for a longer time step, mostly none, or the added mass of
/// water, for which the ground's force is -(M iota + w) a_g, see `ground_load`. Arrays hold this
/// rank's owned dofs. Constant during a run; copies share their operators.
struct LinearSystem {
  std::string name;
  MPI_Comm comm = MPI_COMM_SELF;
  Rayleigh damping;
  std::optional<UniformDamping> uniform_damping;  ///< its reference known once the modes are
  GlobalIndex global_dofs = 0;
  std::vector<double> lumped_mass;   ///< M [kg, kg m2]
  std::vector<double> inverse_mass;  ///< [1/kg, 1/(kg m2)]
  /// Per dof, the direction (0-2) in which it is a translation, -1 for rotations: the influence
  /// vector iota of direction d is 1 where this is d. Empty in generalised coordinates.
  std::vector<std::int8_t> direction;
  /// Label of the node of every owned dof in the files that the matrices come from; empty without.
  std::vector<std::string> node_labels;
  /// Null for a model whose dofs are components of nodes.
  std::shared_ptr<GeneralisedCoordinates> generalised;
  std::shared_ptr<stiffness::Stiffness> stiffness;  ///< K of all elements that hold a stiffness
  std::string stiffness_method;                     ///< how it is applied, for the report
  /// Cost of a step of its solids over that of as many nodes extruded; 0 without solids.
  double cost_beside_extruded = 0;
  std::shared_ptr<stiffness::Stiffness> taut;  ///< K with links at their stiffest; null without
  std::shared_ptr<Links> links;                ///< null if there are none
  /// Laws by which elements yield or break: their forces beside K u.
  std::vector<interactions::RegionLaw> laws;
  /// How it follows supports that move on their own; null where the ground moves as one.
  std::shared_ptr<const SupportShapes> supports;
  /// Modes in which it is stepped while nothing strikes it; null: it never is.
  std::shared_ptr<const SwitchedModes> switched;
  /// Loads with a history of their own; null where none acts on it.
  std::shared_ptr<const LoadShapes> loads;
  std::shared_ptr<stiffness::Stiffness> extra_damping;  ///< D [N s/m, N m s]; null if there is none
  /// Per owned dof, whether a law of `laws` may act on it; empty without any.
  std::vector<char> inelastic;
  MassScaling mass_scaling;
  /// Owned dofs without a mass of their own, which follow the parts that hold them, and how many
  /// there are on all ranks.
  std::vector<LocalIndex> condensed;
  GlobalIndex condensed_dofs = 0;
  RotaryScaling rotary_scaling;               ///< in `lumped_mass` already
  std::vector<RigidBodyReport> rigid_bodies;  ///< and ties, of all ranks
  bool wet = false;                           ///< it has pools with cells of water
  WaterLoad water;  ///< empty on ranks that have none of it, and in generalised coordinates
  /// M + S of the dofs in S, the rigid bodies and ties; null if this rank has none of them.
  std::shared_ptr<CoupledMass> coupled_mass;
  Vector3 initial_displacement{0, 0, 0};  ///< of every translation at t = 0 [m]
  Vector3 initial_velocity{0, 0, 0};      ///< of every translation at t = 0 [m/s]
  /// State at t = 0 in place of these two where nodes start differently; null where they do not.
  std::shared_ptr<const StartState> start;
  Vector3 gravity{0, 0, 0};  ///< constant body acceleration [m/s2]
  /// u_0 of the static equilibrium, of the owned dofs, or empty: added to initial_displacement.
  std::vector<double> rest_displacement;
  /// Forces of the element laws there, beside K u_0 [N, N m]; empty without any.
  std::vector<double> rest_law_force;
  double total_mass = 0;  ///< clamped nodes included [kg]
  /// Upper bound of omega_max from single elements, and its element: the one with the largest omega
  /// of its own. Infinite if an element has stiffness but no mass (springs), which is not named;
  /// nor are, here and below, elements inside a rigid body.
  double element_frequency_bound = 0;  ///< [rad/s]
  std::string stiffest_element;
  /// Lower bound of the stable time step from single elements, and which one holds it; infinite
  /// where nothing limits it.
  double element_time_step_bound = 0;  ///< [s]
  std::string limiting_element;
  ScalingOffer scaling_offer;   ///< where mass is not scaled
  std::vector<Sliver> slivers;  ///< the worst of every group that has any

  /// M + S is not diagonal, or rigid bodies or ties couple it, on some rank.
  bool mass_is_coupled() const { return mass_scaling.elements > 0 || !rigid_bodies.empty() || wet; }
  /// Dofs over all ranks; rigid bodies count by their motions, followers of a tie do not count.
  GlobalIndex independent_dofs() const;
  /// K for eigenvalues: every link at its stiffest.
  const stiffness::Stiffness& stiffest() const { return taut ? *taut : *stiffness; }
  Mat stiffest_matrix() const { return stiffest().matrix(); }
  /// Factor of K for the fastest motions [-].
  double stiffening() const { return uniform_damping ? uniform_damping->at_once() : 1; }
  /// Elements that yield or act in one direction only resist with what K does not hold, or with
  /// less than the modes do.
  bool has_laws_beside = false;
  /// Some elements follow laws apart, see RegionLaw.
  bool has_laws(bool apart) const {
    return std::ranges::find(laws, apart, &interactions::RegionLaw::apart) != laws.end();
  }
  /// Forces beside K u, alpha M v and beta K v.
  /// Water with cells that wets nodes of this rank.
  std::span<const AddedMass> waters() const {
    if (!coupled_mass) return {};
    return coupled_mass->waters();
  }
  bool has_extra_damping() const { return extra_damping != nullptr; }
  /// iota of a direction [-].
  std::vector<double> influence(int d) const;
  /// M iota + w of a direction, w the force of the water [kg]: the load of -1 m/s2 of the ground.
  std::vector<double> ground_load(int d) const;
  LocalIndex owned_dofs() const { return static_cast<LocalIndex>(lumped_mass.size()); }
};

/// Describes a system from the structure's options and mesh, nothing assembled yet.
LinearSystem describe_system(const Structure& structure, const Mesh& mesh);

/// Once the lumped mass is complete: its inverse, and the directions of the dofs.
void finish_system(const Mesh& mesh, LinearSystem& system);

/// A new distributed vector over the owned dofs. Collective.
VecHandle create_vector(const LinearSystem& system);

/// Distributed vector over the owned dofs that uses `storage` as its memory (size: owned_dofs).
VecHandle wrap_vector(const LinearSystem& system, std::vector<double>& storage);

}  // namespace pounding
