#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "driver/model.h"
#include "dynamics/energy_balance.h"
#include "dynamics/gap_watch.h"
#include "dynamics/octet_step.h"
#include "ensemble/member_scene.h"
#include "interactions/contact_problem.h"
#include "output/impact_catalogue.h"

namespace pounding {

/// Numbers of one member of an ensemble, as ensemble.h5 holds them.
struct MemberResult {
  std::vector<double> spectra;      ///< PSA, shape (channels, damping ratios, frequencies) [m/s2]
  std::vector<double> episodes;     ///< per contact, as the next ones
  std::vector<double> first_time;   ///< [s]; not a number without an impact
  std::vector<double> impulse_sum;  ///< [N s]
  std::vector<double> impulse_largest;   ///< of an episode [N s]
  std::vector<double> force_peak;        ///< [N]
  std::vector<double> smallest_gap;      ///< [m]
  std::vector<double> displacement;      ///< largest per channel [m]
  std::vector<double> acceleration;      ///< largest per channel after the low-pass [m/s2]
  std::vector<double> energy_residual;   ///< one number: largest, relative
  std::vector<double> contact_residual;  ///< one number: of complementarity, largest [-]
};

/// One member of a group, as far as it goes alone in its lane: it looks at its gaps when its own
/// bound asks for it, solves its contact, keeps its ledger and its impacts. The free step of all
/// members of the group is that of OctetStep.
class MemberRun {
 public:
  /// The arguments must outlive this object.
  MemberRun(const MemberScene& member, const EnsembleModel& shared, std::size_t lane);

  const LinearSystem& system(std::size_t structure) const { return model_.systems[structure]; }
  /// State at t_0.
  const State& initial() const { return state_; }

  /// The ground at t_n [m/s2].
  const std::array<double, 3>& begin(double time);
  /// Rows of the interface of a structure, shape (places, coordinates); none without contacts.
  std::span<const double> interface_rows(std::size_t structure) const;
  /// Gaps of u_n, if the bound asks for it or if they are to be recorded: then `places` holds, per
  /// structure, the displacements at the places of all lanes; else it is empty.
  void look(std::int64_t step, std::span<const std::vector<Octet>> places,
            std::span<const OctetStep> steps, std::span<const OctetState> states);
  /// Contact impulses after the free step, if gaps are closed.
  void resolve(std::span<OctetStep> steps, std::span<OctetState> states);
  /// The ledger of the step, and its impulses; `records`: the gaps count as recorded ones.
  void close(double time, double duration, bool records, std::span<const OctetStep> steps);
  /// A line of the ledger: stops the ensemble if this member's numbers cannot be trusted.
  void close_ledger(std::int64_t step, std::span<const OctetState> states);
  bool needs_energies() const { return energy_.needs_energies(); }
  std::int64_t looks() const { return looks_; }

  /// Impacts, gaps and the ledger's residual.
  void fill(MemberResult& result);

 private:
  std::size_t contacts() const { return smallest_gaps_.size(); }
  void set_displacement(std::size_t structure, std::span<const std::vector<Octet>> places,
                        const OctetState& state);
  /// Brings the state of this member to the bound of its gap rates.
  void measure(std::span<const OctetState> states);
  void note_gaps();

  std::size_t lane_;
  Model model_;
  std::unique_ptr<interactions::ContactProblem> contact_;  ///< null without contacts
  std::unique_ptr<GapWatch> watch_;
  EnergyBalance energy_;
  ImpactCatalogue catalogue_;
  State state_;                 ///< of this member alone, as far as it was last looked at
  std::vector<double> places_;  ///< displacements at the places of one structure
  std::vector<OctetStep::Before> before_;
  std::vector<std::vector<double>> velocity_;  ///< per structure, after contact
  std::vector<StepSums> sums_;
  std::vector<double> smallest_gaps_;  ///< per contact, of all recorded ones [m]
  std::array<double, 3> acceleration_{};
  bool known_ = false;
  bool touching_ = false;
  std::int64_t looks_ = 0;
};

}  // namespace pounding
