#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "driver/closing_watch.h"
#include "driver/forces.h"
#include "driver/loops.h"
#include "driver/phase_report.h"
#include "driver/stated_peaks.h"
#include "driver/uplift_watch.h"
#include "dynamics/energy_balance.h"
#include "interactions/filler_rows.h"
#include "interactions/slide_watch.h"
#include "output/impact_catalogue.h"
#include "output/recorder.h"

namespace pounding {

/// Findings of a run, beside the model; complete on rank 0.
struct RunStatistics {
  double wall_time = 0;                 ///< of everything [s]
  double step_time = 0;                 ///< of the time loop [s]
  std::int64_t steps = 0;               ///< that it made: after the checkpoint if it continues one
  EnergyLine energy;                    ///< last line
  double energy_residual = 0;           ///< largest, relative to the largest term [-]
  double complementarity_residual = 0;  ///< largest [-]
  int contact_rows = 0;
  int coupled_rows = 0;
  int interface_ranks = 0;
  std::int64_t interface_looks = 0;   ///< steps that looked at the gaps
  std::vector<ImpactTotals> impacts;  ///< per contact
  ImpactTotals all_impacts;
  std::vector<interactions::FillerTotals> fillers;  ///< per contact; empty without fillers
  std::vector<LoopReport> loops;                    ///< per item of the option
  std::vector<ForceReport> forces;                  ///< per item of the option; rank 0
  std::vector<interactions::Slide> slides;          ///< per contact
  std::vector<JointClosing> closings;               ///< per contact, of the samples of the gaps
  std::vector<ContactRatio> contact_ratios;  ///< per structure; empty where nothing may lift off
  StatedPeaks peaks;                         ///< rank 0
  std::vector<std::string> overpressed;      ///< structures with a pendulum whose slope was cut
  std::vector<std::string> warnings;         ///< one line each: what the run came upon
  PhaseReport phases;                        ///< time and memory
};

}  // namespace pounding
