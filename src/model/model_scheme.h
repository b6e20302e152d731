#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "common/profile.h"
#include "dynamics/cd_lagrange.h"
#include "dynamics/unilateral_contact.h"
#include "interactions/contact_problem.h"
#include "interactions/filler_rows.h"
#include "interactions/inelastic_elements.h"
#include "interactions/pairing/interface.h"
#include "interactions/soil_rows.h"
#include "interactions/structure_links.h"
#include "mesh/mesh.h"
#include "model/model.h"
#include "motion/ground_motion.h"
#include "motion/load_histories.h"
#include "system/linear_system.h"

namespace pounding {

/// The contact problem and the scheme of a model, put together in one place for the program and its
/// benchmarks.
class ModelScheme {
 public:
  /// Parts of a scheme; all that is referred to must outlive it.
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
    const LoadHistories* loads = nullptr;     ///< null where no load acts
    BatchSlot batch{};                        ///< of a member of an ensemble
    /// The places of the interface are carried (see ContactProblem::carry): no energy bounds the
    /// gap rates, and gaps are looked at in every step.
    bool carried = false;
  };

  /// Puts contact and scheme together, at t_0. Collective.
  explicit ModelScheme(Parts parts);
  /// Back to t_0: all steps are forgotten, the bounds of the gap rates are kept. Contact and
  /// stepper are new objects. Collective.
  void restart();

  interactions::ContactProblem* contact() { return contact_.get(); }  ///< null without contacts
  const interactions::ContactProblem* contact() const { return contact_.get(); }
  /// Null without fillers.
  interactions::FillerRows* fillers() { return fillers_; }
  const interactions::FillerRows* fillers() const { return fillers_; }
  /// Soil between mats; null if there is none.
  const interactions::SoilRows* soil() const { return soil_; }
  /// The links of a structure on this rank; null if it has none.
  interactions::StructureLinks* links(std::size_t structure) { return links_[structure]; }
  const interactions::StructureLinks* links(std::size_t structure) const {
    return links_[structure];
  }
  /// The inelastic elements of a structure: those damped with K, those apart.
  std::span<interactions::InelasticElements* const> inelastic(std::size_t structure) const {
    return inelastic_[structure];
  }
  /// Impulses act in the step just made, on rows that this rank holds.
  bool touching() const { return unilateral_ != nullptr && unilateral_->touching(); }
  /// Some row may act in it on some rank of the contacts; the same on all of them, false elsewhere.
  bool rows_may_act() const {
    return gives_way_ ? interface_known() : unilateral_ != nullptr && unilateral_->may_touch();
  }
  /// Some row that this rank counts may act in it, hard contact, faces that are crushed or a stop
  /// that gives way; false where no contact is known.
  bool rows_act() const {
    return touching() || (gives_way_ && contact_->member() && fillers_->strikes());
  }
  /// Impulses and works per row of the interface in the step just made.
  struct RowActions {
    std::span<const double> impulses;  ///< [N s]
    std::span<const double> works;     ///< [J]
  };
  /// Rows of hard contact, of crushing and of stops that give way, of those that this rank counts.
  RowActions row_actions();
  /// This rank holds the gaps and impulses of its rows in that step.
  bool interface_known() const { return unilateral_ != nullptr && unilateral_->interface_known(); }
  /// See UnilateralContact; 0 without contacts.
  std::int64_t looks() const { return unilateral_ != nullptr ? unilateral_->looks() : 0; }
  /// See GapWatch::energies_known.
  void note_energies(std::int64_t step, std::span<const StructureEnergy> energies,
                     std::span<const double> round_off) {
    if (unilateral_ != nullptr) unilateral_->energies_known(step, energies, round_off);
  }
  CdLagrange& stepper() { return *stepper_; }
  const CdLagrange& stepper() const { return *stepper_; }

 private:
  /// The scheme with its interactions: links, fillers, contact.
  void make_stepper();

  Parts parts_;
  std::vector<GapWatch::Bound> bounds_;
  std::unique_ptr<interactions::ContactProblem> contact_;
  std::unique_ptr<CdLagrange> stepper_;
  std::vector<interactions::StructureLinks*> links_;  ///< per structure, of the stepper
  std::vector<std::vector<interactions::InelasticElements*>> inelastic_;  ///< per structure
  interactions::SoilRows* soil_ = nullptr;                                ///< of the stepper
  interactions::FillerRows* fillers_ = nullptr;                           ///< of the stepper
  UnilateralContact* unilateral_ = nullptr;                               ///< of the stepper
  bool gives_way_ = false;        ///< some stop does, or some faces are crushed
  std::vector<double> impulses_;  ///< see row_actions; room where something gives way
  std::vector<double> works_;
};

/// Parts of the scheme of a model; `meshes`: those of its structures.
ModelScheme::Parts scheme_parts(MPI_Comm comm, const Scene& scene, const Model& model,
                                std::span<const Mesh> meshes, Profile& profile);

/// Bounds of the gap rates of structures at a time step [s] with their energy margins (see
/// EnergyNorm), the same on all ranks; `contact` may be null. `progress_interval` [s]: see
/// Progress. Collective over `comm`.
std::vector<GapWatch::Bound> gap_bounds(MPI_Comm comm, std::span<const LinearSystem> systems,
                                        std::span<const double> energy_margins, double time_step,
                                        const interactions::ContactProblem* contact,
                                        double progress_interval);

}  // namespace pounding
