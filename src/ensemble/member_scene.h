#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "interactions/pairing/find_interface.h"
#include "interactions/pairing/gap_field.h"
#include "modal/modal_basis.h"
#include "model/model.h"
#include "scene/member_table.h"
#include "scene/scene_reader.h"
#include "stiffness/batch_stiffness.h"

/// The scenes of the members of an ensemble, and their own parts of the model.
namespace pounding {

/// Scene of one member.
struct MemberScene {
  std::string place;  ///< in the table, as messages begin
  Scene scene;
  std::vector<double> stiffness_factors;  ///< per structure
};

/// Refuses scenes that cannot be stepped together: pairs that are found anew, records beside those
/// of probes. Throws UserError.
void require_ensemble_scene(const Scene& scene);

/// The scene of a member; `shared`: that of the ensemble, whose options are `scene`. Throws
/// UserError with the line of the table.
MemberScene read_member(const Scene& shared, const OptionsDatabase& scene, const MemberTable& table,
                        std::size_t member);

/// Lays the foundations on soil and the water that a scene got from its meshes into that of a
/// member.
void lay_foundations(const Scene& scene, MemberScene& member);

/// Gives a row the initial gap of the scene of a member, or that of the meshes, and its filler;
/// `gaps` are those of its contacts. Throws UserError as fill_joint does. Returns the width of the
/// joint there [m].
double set_gap(const Scene& scene, std::span<const interactions::GivenGap> gaps,
               interactions::Constraint& row);

/// Model that the members share on a rank.
struct EnsembleModel {
  const Model* model = nullptr;  ///< of the ensemble's scene, on this rank alone
  /// Bases of reduced structures, with rows, without a factor; empty at full order.
  std::vector<std::optional<ModalBasis>> bases;
  /// K in eight runs of structures at full order that batches step; see multiply_together.
  std::vector<std::unique_ptr<stiffness::BatchStiffness>> elements;

  /// Every run steps the structure by itself: where most elements lie in rows, which are as fast
  /// by themselves; with mass that is coupled, laws of elements, damping beside Rayleigh's, or a
  /// sparse matrix.
  bool steps_alone(std::size_t structure) const;
  /// Makes `elements`, before the first batch.
  void multiply_together();
  /// Memory of eight runs of the structures at full order [bytes].
  double memory() const;
};

/// The part of the model that is a member's own, for this process alone: systems and limits of its
/// structures, gaps, motion, its rest. It borrows from both. Throws UserError with the line of the
/// table.
Model member_model(const MemberScene& member, const EnsembleModel& shared);

/// Limits of the time step of a member, its fillers included.
StepLimits member_limits(const MemberScene& member, const EnsembleModel& shared);

}  // namespace pounding
