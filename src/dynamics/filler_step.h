#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/saved_state.h"
#include "dynamics/link_records.h"
#include "dynamics/state.h"
#include "dynamics/step_sums.h"
#include "dynamics/structure_step.h"
#include "dynamics/support_step.h"
#include "interactions/filler_rows.h"
#include "interactions/laws/filler_law.h"
#include "scene/scene.h"

namespace pounding {

/// Largest load of the filler of a contact, and what it lost.
struct FillerTotals {
  double peak_pressure = 0;   ///< of a pair [Pa]
  double peak_force = 0;      ///< of all pairs together [N]
  double crushed_strain = 0;  ///< largest that stays, of a pair [-]
  double loss = 0;            ///< what it took and did not keep [J]
};

/// Fillers' part of a step: between the step of the structures without them and contact, what each
/// pair presses (FillerLaw) is solved for, by Gauss-Seidel sweeps where pairs move each other, and
/// v+ and u_{n+1} corrected. The rates that a step ends with come with the state of the next one,
/// and so does its loss. Every member of the rows computes the same; one adds it to the ledger.
class FillerStep {
 public:
  /// `contacts` of the scene. References must outlive this object. Collective over `comm`.
  FillerStep(MPI_Comm comm, const interactions::Interface& interface,
             std::span<const Contact> contacts, std::span<const LinearSystem> systems,
             std::span<const Mesh> meshes, double time_step);

  /// Before the structures' step to t_n: d_n, its rate, what they crush, and what the dofs hold.
  /// Members of the rows communicate.
  void begin(std::span<const StructureState> structures, std::span<StructureStep> steps,
             const SupportStep& supports);
  /// After it: forces, v+, u_{n+1}. `first`: they act for half a step, from v_0. Members
  /// communicate.
  void press(bool first, std::span<const StructureState> structures, std::span<StructureStep> steps,
             const SupportStep& supports);
  /// Ends the step: adds the fillers' energy before it, and their loss in the last one.
  void finish(StepSums& sums);

  /// Per contact of the scene; members only.
  const std::vector<FillerTotals>& totals() const { return totals_; }
  int root() const { return rows_.root(); }
  const interactions::FillerRows& rows() const { return rows_; }
  /// Records some rows from now on, on members. Their work comes with the step after.
  void record(std::vector<std::size_t> rows) { records_.watch(std::move(rows), true); }
  const LinkRecords& records() const { return records_; }

  void save(SavedState& saved) const;
  void load(const SavedState& saved);

 private:
  /// Forces of rows none of which lets go in the step; false if one may.
  bool hold(double share);
  void solve(double share);
  void note_peaks();
  std::vector<std::string> record_names() const;

  interactions::FillerRows rows_;
  bool counts_;  ///< this rank adds to the ledger
  double time_step_;
  std::vector<interactions::FillerLaw> laws_;
  std::vector<double> memory_;        ///< shape (rows, 2), see FillerLaw
  std::vector<double> now_;           ///< d_n
  std::vector<double> rate_;          ///< of d, at the start of the step
  std::vector<double> rate_before_;   ///< at that of the step before
  std::vector<double> before_;        ///< d_{n-1}
  std::vector<double> free_after_;    ///< d_{n+1} without fillers
  std::vector<double> force_;         ///< N_n
  std::vector<double> force_before_;  ///< N_{n-1}
  std::vector<double> held_;          ///< W_{n-1/2}
  std::vector<double> impulse_;
  std::vector<double> reach_;                       ///< sum of the moduli of a row of H [1/kg]
  double support_input_ = 0;                        ///< work of supports against the fillers [J]
  double loss_ = 0;                                 ///< of the step before
  bool made_ = false;                               ///< a step was
  std::vector<StructureStep::Before> before_step_;  ///< per structure
  std::vector<std::vector<double>> velocity_;       ///< per structure, of the trace's dofs
  std::vector<FillerTotals> totals_;
  std::vector<double> contact_force_;  ///< per contact
  LinkRecords records_;
};

}  // namespace pounding
