#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "elements/element_traits.h"
#include "interactions/interaction.h"
#include "laws/element_law.h"
#include "mesh/halo.h"
#include "mesh/mesh.h"
#include "system/linear_system.h"
#include "system/trace.h"

namespace pounding::interactions {

/// Elements of one structure that follow an element law. What they resist with beside K u, g_n, is
/// known from u_n and their history and acts with K u in the free step,
///
///     g_n + beta (g_n - g_{n-1}) / dt
///
/// so that Rayleigh's beta damps the elastic part of their motion alone, and uniform damping
/// filters g_n with K u_n. A rank computes every element that touches a node of its own, the same
/// force as its neighbours. The ledger's part, beside that of K, is
///
///     E_{n+1/2} = 1/2 g_n . u_{n+1} - W_n,      loss = g_n . (u_{n+1} - u_{n-1}) / 2 - change of E
///
/// over the owned dofs, W_n of counted elements (ElementLaw). On supports that move on their own u
/// is the whole displacement here, and their work on g_n is an input; the work of the second term
/// of beta is one of damping.
///
/// Elements apart (RegionLaw) are not damped with K: a trace takes M^-1 g_n off the free velocity,
/// in generalised coordinates as well. All of one that can move lives on one rank. Allocates
/// nothing in a step.
class InelasticElements final : public Interaction {
 public:
  /// Elements of structure number `structure` of the step, all of them apart or none. Mesh and
  /// system must outlive this object. Collective over the structure's communicator.
  InelasticElements(std::size_t structure, const Mesh& mesh, const LinearSystem& system,
                    double time_step, std::vector<RegionLaw> laws);
  ~InelasticElements() override;

  void attach(std::span<SteppedStructure* const> structures) override;
  void begin(const Step& step) override;
  void push(const Step& step) override;
  void finish(const Step& step) override;
  void keep(const StateKeeper& state) override;

  /// One of the laws in one dimension of an element that this rank counts.
  struct Part {
    std::size_t group = 0;
    std::size_t element = 0;  ///< of its block
    std::size_t number = 0;   ///< of the law
  };
  const std::vector<Part>& parts() const { return parts_; }
  const ElementBlock& block_of(const Part& part) const {
    return mesh_.blocks[groups_[part.group].block];
  }
  std::string name_of(const Part& part) const {
    return groups_[part.group].law->parts()[part.number];
  }
  PartState state_of(const Part& part) const;
  double ductility(const Part& part) const;
  /// g_n of the elements apart at an owned dof [N, N m], in the step just made.
  double force_apart(LocalIndex dof) const { return trace_ ? force_[dof] : 0; }
  /// Records some of these parts from now on, numbers into `parts()`.
  void record(std::vector<std::size_t> parts);
  const LinkRecords& records() const { return records_; }

 private:
  /// Elements of one block, which share a law.
  struct Group {
    std::size_t block = 0;  ///< of the mesh
    std::size_t first = 0;  ///< of its elements, among those of the law
    ElementLayout layout;
    const ElementLaw* law = nullptr;
    /// Dofs of an element on which the law may act; then `ground` for the ground under a dof that
    /// went before, where springs are on ground that moves.
    struct Acting {
      std::size_t dof = 0;
      bool ground = false;
    };
    std::vector<Acting> acting;
    /// Places of these in displacement_, -1 where none counts; shape (elements, acting).
    std::vector<LocalIndex> slots;
    std::vector<unsigned char> counted;  ///< per element, whether this rank counts it
    std::vector<double> memory;          ///< shape (elements, numbers of the law)
  };

  /// A held component, or the ground under a component of a node.
  struct HeldDof {
    LocalIndex node = 0;
    int component = 0;
    bool ground = false;  ///< that under the node
    bool operator==(const HeldDof&) const = default;
  };

  /// g over the slots out of `displacement_`, histories brought there; returns W of the elements
  /// that this rank counts.
  double respond();
  /// History of the element of a part.
  std::span<const double> memory_of(const Part& part) const;
  /// Prepares `halo_` once the slots are known. Collective.
  void find_ghosts();
  /// Sets the ghosts among the slots to values that `halo_` brought.
  void take_ghosts(std::vector<double>& values) const;
  /// Brings `displacement_` to u_n less so much time times its rate.
  void exchange(const Step& step, double back);
  /// Finds how far a unit of each column of the supports' motion carries every slot.
  void find_carried();
  /// Finds `acting` and `slots` of a group.
  void find_slots(Group& group);
  /// Slot of a component: its local dof, one beyond these where supports move it, -1 if held;
  /// `ground`: of the ground under the node.
  LocalIndex slot_of(LocalIndex node, int component, bool ground);
  /// Values over `dofs_` out of those of the structure's dofs, where elements are apart.
  void measure(const std::vector<double>& owned, std::vector<double>& values) {
    trace_->apply(owned.data(), values.data(), 1);
  }
  /// How far the supports carry a slot: at t_n and t_{n+1}, and in the mean of the ways to both.
  struct Carried {
    double now = 0, next = 0, way = 0;
  };
  Carried carried(const Step& step, std::size_t slot) const;
  double carried_by(const SupportColumn& column, const HeldDof& held) const;
  /// 1/2 g_n . u_{n+1} of held components, which is kept with W_n.
  double held_by_supports(const Step& step) const;
  /// Histories of a group, to a saved state and back. Collective over the structure's communicator.
  void put_history(const Group& group, const StateKeeper& state) const;
  void take_history(Group& group, const SavedState& saved) const;
  std::string name_of(const Group& group, const char* numbers) const;
  std::string energy_name() const {
    return "inelastic " + mesh_.structure + (trace_ ? " apart" : " held");
  }
  std::vector<std::string> record_names() const;

  std::size_t structure_;
  const Mesh& mesh_;
  const LinearSystem& system_;
  double time_step_;
  std::vector<RegionLaw> laws_;
  std::vector<Group> groups_;
  std::unique_ptr<Halo> halo_;      ///< of the ghosts among the slots
  std::vector<LocalIndex> ghosts_;  ///< their local dofs, in the order that halo_ was given
  std::vector<LocalIndex> dofs_;    ///< owned dofs that these elements act on, increasing
  std::vector<HeldDof> held_;       ///< that supports move; their slots are behind the local dofs
  std::vector<std::vector<double>> carried_;  ///< per column of the supports, over the slots
  std::vector<double> displacement_;  ///< over the slots, set at dofs_, ghosts, held_ [m, rad]
  std::vector<double> force_;         ///< g over the slots likewise; of held_ of counted elements
  std::vector<double> now_;           ///< g_n over dofs_
  std::vector<double> before_;        ///< g_{n-1} likewise
  std::vector<double> acting_;        ///< the force of the step
  double offset_ = 0;                 ///< W_n [J]
  double held_energy_ = 0;            ///< E_{n+1/2} at the end of a step [J]
  Before state_;                      ///< u_n and v- over dofs_
  std::optional<Trace> trace_;        ///< of dofs_; null if the elements are not apart
  Before stepped_{0};                 ///< u_n and v- of the dofs of the trace
  std::vector<double> velocity_;      ///< v+ likewise
  std::vector<double> after_;         ///< v+ over dofs_, impulses before
  std::vector<Part> parts_;
  LinkRecords records_;
  std::vector<double> taken_;  ///< by each recorded part up to the last step [J]
};

}  // namespace pounding::interactions
