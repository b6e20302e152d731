#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "common/profile.h"
#include "dynamics/cd_lagrange.h"
#include "dynamics/filler_step.h"
#include "dynamics/gap_watch.h"
#include "interactions/contact_problem.h"
#include "interactions/pairing/interface.h"
#include "mesh/mesh.h"
#include "motion/ground_motion.h"
#include "system/linear_system.h"

namespace pounding {

/// The contact problem and the scheme of a model, put together in one place for the program and its
/// benchmarks.
class Solver {
 public:
  /// Parts of a solver; all that is referred to must outlive it.
  struct Parts {
    MPI_Comm comm = MPI_COMM_NULL;
    std::span<const LinearSystem> systems;
    std::span<const Mesh> meshes;
    const interactions::Interface* interface = nullptr;
    const GroundMotion* motion = nullptr;
    double gap_tolerance = 0;            ///< [m]
    double time_step = 0;                ///< [s]
    std::vector<double> energy_margins;  ///< per structure, at the time step [-]
    Profile* profile = nullptr;
    double progress_interval = std::numeric_limits<double>::infinity();  ///< [s], see Progress
    std::span<const Contact> contacts;        ///< of the scene, needed where joints have fillers
    const SupportMotion* supports = nullptr;  ///< null where the ground moves as one
  };

  /// Puts contact and scheme together, at t_0. Collective.
  explicit Solver(Parts parts);
  /// Back to t_0: what was stepped is forgotten, the bounds of the gap rates are kept. Contact and
  /// stepper are new objects. Collective.
  void restart();

  interactions::ContactProblem* contact() { return contact_.get(); }  ///< null without contacts
  const interactions::ContactProblem* contact() const { return contact_.get(); }
  FillerStep* fillers() { return fillers_.get(); }
  const FillerStep* fillers() const { return fillers_.get(); }  ///< null without fillers
  CdLagrange& stepper() { return *stepper_; }
  const CdLagrange& stepper() const { return *stepper_; }

 private:
  /// Fillers and stepper.
  void make_stepper();

  Parts parts_;
  std::vector<GapWatch::Bound> bounds_;
  std::unique_ptr<interactions::ContactProblem> contact_;
  std::unique_ptr<FillerStep> fillers_;
  std::unique_ptr<CdLagrange> stepper_;
};

}  // namespace pounding
