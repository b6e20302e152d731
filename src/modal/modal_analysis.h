#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesh/location.h"
#include "mesh/mesh.h"
#include "modal/lanczos.h"
#include "system/linear_system.h"

namespace pounding {

/// One natural mode of an undamped structure, mass-normalised.
struct Mode {
  double frequency = 0;                   ///< [Hz]
  std::array<double, 6> participation{};  ///< Gamma = phi^T M R, with the sign of phi
  std::array<double, 6>
      effective_modal_mass{};     ///< Gamma^2: along x, y, z [kg]; about x, y, z through
                                  ///< the centre of mass [kg m2]
  std::string direction;          ///< "x" ... "rz": where most of the mass moves
  double direction_fraction = 0;  ///< of the mass (rotary inertia) in that direction
  double damping_weight = 1;      ///< see ModalBasis::damping_weights
  double scaled_part = 0;         ///< scaled mass, and lent one, in phi^T (M + S) phi = 1 [-]
  RegionShare region;             ///< with most of its kinetic energy; none of a reduced structure
  std::string location;           ///< where it moves most, of modes near zero only
  std::vector<double> shape;      ///< phi over the owned dofs; empty unless asked
};

struct ModalResult {
  std::string method;       ///< how they were found, where no factorisation was made
  std::vector<Mode> modes;  ///< increasing frequency
  double mass = 0;          ///< of the free dofs [kg]
  Vector3 centre_of_mass{0, 0, 0};

  /// The lowest that vibrates [Hz]; 0: none is known.
  double first_frequency() const;
};

/// A mode is near zero below this part of the largest frequency of a single element (of the bound
/// by rows where springs have none), which is some thirty times the round-off of its frequency.
inline constexpr double near_zero = 1e-6;

/// The largest circular frequency and where its mode lives.
struct LargestFrequency {
  double omega_max = 0;  ///< upper bound [rad/s], see Lanczos; at most that of the elements
  std::string location;  ///< node and component with the largest share of the mode's mass
  double excess = 0;     ///< part of it by which it may be too large [-]; 0: 1e-10
  int products = 0;      ///< with K that it took
};

/// A mode from omega^2 [1/s2], its participation factors along x, y, z and about them, and the
/// structure's mass and rotary inertia along and about them.
Mode describe_mode(double eigenvalue, const std::array<double, 6>& participation,
                   const std::array<double, 6>& inertia);

/// Frequency of the first mode that vibrates, to six digits, where uniform damping leaves the
/// stiffness as it is [Hz]. Throws UserError where none does.
double reference_frequency(const Structure& structure, const ModalResult& modal);

/// The lowest `count` modes by SLEPc's Krylov-Schur on M^-1/2 K M^-1/2, shift-and-invert with a
/// Cholesky factorisation (MUMPS), the shift just below zero so that free structures pass; on K
/// and M + S where mass is coupled. The law of inertia counts the eigenvalues up to the last one,
/// and copies of a frequency that were not seen are sought. By `iterate_lowest`, uncounted, where
/// `must_iterate` says so of `choice`.
/// Frequencies of rigid-body modes come out as 0. Participation: Gamma = phi^T M iota, effective
/// mass Gamma^2. `keep_shapes`: with phi, phi^T M phi = 1. Needs the matrix of the system unless
/// `count` is 0. Throws UserError when SLEPc finds fewer than asked. Collective.
ModalResult lowest_modes(const LinearSystem& system, const Mesh& mesh, int count,
                         bool keep_shapes = false, SolverChoice choice = SolverChoice::automatic);

/// omega_max by Lanczos on the same matrix, of which it needs products only. Collective.
LargestFrequency largest_frequency(const LinearSystem& system, const Mesh& mesh,
                                   const EigenvalueEffort& effort = {});

/// Rigid-body motions of the free nodes: along x, y, z, and about them through the centre of mass.
class RigidMotions {
 public:
  /// Collective over the system's communicator. `system` must outlive this object.
  RigidMotions(const LinearSystem& system, const Mesh& mesh);

  double mass() const { return mass_; }  ///< of the free dofs [kg]
  const Vector3& centre() const { return centre_; }
  /// R^T M R of each motion R [kg, kg m2].
  const std::array<double, 6>& inertia() const { return inertia_; }
  /// R^T M^1/2 y of each motion for y over the owned dofs; y = M^1/2 phi gives the participation
  /// factors of a mode. Collective.
  std::array<double, 6> participation(const double* y) const;

 private:
  /// a^T M a on this rank.
  double weighted_square(const std::vector<double>& a) const;

  const LinearSystem& system_;
  double mass_ = 0;
  Vector3 centre_{0, 0, 0};
  std::array<std::vector<double>, 6> motions_;
  std::array<double, 6> inertia_{};
};

}  // namespace pounding
