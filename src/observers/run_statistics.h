#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <mpi.h>

#include "common/facts.h"
#include "common/profile.h"
#include "dynamics/energy_balance.h"
#include "interactions/filler_rows.h"
#include "interactions/interaction.h"
#include "motion/spectrum_shape.h"
#include "observers/floor_spectra.h"
#include "observers/impact_catalogue.h"

namespace pounding {

/// Time and memory of one phase over all ranks.
struct PhaseUse {
  double seconds = 0;       ///< wall time, largest over the ranks [s]
  double peak = 0;          ///< resident memory, sum of the ranks' largest [bytes]
  double largest_rank = 0;  ///< largest of one rank [bytes]
  double held = 0;          ///< at the end of the phase, all ranks together [bytes]
};

struct PhaseReport {
  std::vector<PhaseUse> phases;  ///< per Phase; memory of those of the start-up and of `step` only
  double peak = 0;               ///< of the whole run, sum of the ranks' largest [bytes]
  /// Largest memory of Gmsh's processes, which have gone when the ranks take theirs [bytes].
  double mesher = 0;
  std::size_t dofs = 0;  ///< free ones, for memory per dof
};

/// Time and memory that the ranks noted. Collective.
PhaseReport report_phases(MPI_Comm comm, const Profile& profile, std::size_t dofs);

/// Error of a run's floor spectra by its step or its mesh, from their change when that is
/// halved: ln S_h - ln S_h/2 is 1 - 2^-p of it where it falls with the order p.
struct ErrorPart {
  std::string name;                       ///< "step", "mesh"
  double order = 2;                       ///< p, that it was taken to have
  bool measured = false;                  ///< that order is one of three that were compared
  std::vector<ChannelDistance> channels;  ///< those of the estimate
  std::array<double, compared_bands.size()> rms{};  ///< of all channels, per band [-]

  double extrapolation() const { return 1 / (1 - std::exp2(-order)); }
  /// How many times shorter the step or smaller the elements must be for a share of an accepted
  /// error that leaves as much to the others.
  double refinement(double accepted) const {
    return std::pow(std::sqrt(2.0) * rms[0] / accepted, 1 / order);
  }
  /// Makes the errors of the changes that the channels have, and `rms` of all.
  void extrapolate() {
    for (ChannelDistance& channel : channels) {
      for (double& value : channel.rms) value *= extrapolation();
      channel.largest *= extrapolation();
    }
    for (std::size_t b = 0; b < rms.size(); ++b) rms[b] = rms_of_channels(channels, b);
  }
};

/// Error of a reduced run's floor spectra beside full order, see
/// fidelity/full_order_window.h; the same on every rank, but for the words.
struct FidelityEstimate {
  using Bands = std::array<double, compared_bands.size()>;
  double start = 0;                       ///< of the window [s]
  double end = 0;                         ///< [s]
  std::string reason;                     ///< for the place of the window; rank 0
  std::vector<ChannelDistance> channels;  ///< that move; rms with both parts, the largest of the
                                          ///< window's
  Bands rms{};                            ///< of all channels, per band: root of the sum of the
                                          ///< squares of the two parts [-]
  Bands window{};                         ///< of the part of the window [-]
  Bands spread{};                         ///< and of the run's answer to a small disturbance [-]
  std::vector<ErrorPart> parts;           ///< errors of full order itself
  double disturbance = 0;                 ///< part by which the ground's motion was changed [-]
  double impulse = 0;                     ///< in the window, of the reduced run [N s]
  double full_impulse = 0;                ///< and of full order [N s]
  std::size_t full_dofs = 0;
  double time_step = 0;      ///< of full order [s]
  double wall_time = 0;      ///< of the estimate [s]
  double full_run_time = 0;  ///< that the whole run would take at full order [s]
  /// Steps to scale mass for at full order, per structure, 0 where nothing is gained [s]; empty
  /// where stiff elements do not hold the step.
  std::vector<double> scaled_steps;
  double scaled_run_time = 0;  ///< that the whole run would take so [s]

  double run_time_step = 0;    ///< of the run itself [s]
  std::size_t split_dofs = 0;  ///< on the mesh split once; 0: it was not judged
  double split_time = 0;       ///< that the error of the mesh took, or would take at least [s]
  double split_memory = 0;     ///< and the memory of that, about [bytes]
  std::string mesh;            ///< why the mesh is not judged, or of which structures it is not

  /// "step" or "mesh"; null where it was not judged.
  const ErrorPart* part(std::string_view name) const {
    const auto found = std::ranges::find(parts, name, &ErrorPart::name);
    return found == parts.end() ? nullptr : &*found;
  }
  /// The part that is the largest over all frequencies, null where that is the reduction.
  const ErrorPart* governs() const {
    const ErrorPart* largest = nullptr;
    for (const ErrorPart& part : parts) {
      if (part.rms[0] > (largest == nullptr ? rms[0] : largest->rms[0])) largest = &part;
    }
    return largest;
  }
  /// All errors of the run: root of the sum of the squares.
  double whole(std::size_t band) const {
    double sum = rms[band];
    for (const ErrorPart& part : parts) sum = joined(sum, part.rms[band]);
    return sum;
  }
};

/// How far the pairs of a contact have closed since the start of a run.
struct JointClosing {
  double largest = 0;  ///< of all pairs [m]
  /// Least over the pairs of gap at the start over closing: as long as everything stays linear, so
  /// many times all that moves them from the start (scaled_by_closing) just closes the first of
  /// them [-]. Infinite where none closes.
  double factor = std::numeric_limits<double>::infinity();
};

/// Motion of a pair of a contact.
struct PairMotion {
  double least_gap = std::numeric_limits<double>::infinity();  ///< of the samples [m]
  double time = 0;                                             ///< when it had that first [s]
  /// Largest of the components x, y and z, without their signs, of the displacement of the primary
  /// relative to the secondary since the start, at every tenth look (OtherPass::look_interval) [m].
  Vector3 displacement{};

  double gap_then = least_gap;  ///< at `time`: round-off of a pair that touches is no later one [m]

  static constexpr std::int64_t looks = 10;
  static constexpr double round_off = 1e-12;  ///< [m]
  void note(double gap, double at) {
    if (gap < gap_then - round_off) {
      gap_then = gap;
      time = at;
    }
    least_gap = std::min(least_gap, gap);
  }
};

/// How far the two sides of a contact have slid along each other.
struct Slide {
  double distance = 0;    ///< of the pair that slid farthest beside the size of its facet [m]
  double facet_size = 0;  ///< of that pair's facet; 0: a wall, endless [m]
  double since = -1;      ///< when a pair was first seen beyond `limit` [s]; below 0: none was

  /// Part of a facet beyond which a node may face another one, or none.
  static constexpr double limit = 0.5;
};

/// How far nodes of a contact's primary went into its secondary, in a pass that is not taken.
struct OtherPass {
  double depth = 0;               ///< the largest that was seen [m]
  double facet_size = 0;          ///< of the secondary's facet there [m]
  std::array<double, 2> place{};  ///< of the node on the tangent axes [m]
  double time = 0;                ///< when [s]

  /// Faces slide and sway with their structures: a look this often sees it [s].
  static constexpr double look_interval = 1e-3;
  /// Depths that count, in metres and as a part of the facet.
  static constexpr double deep = 1e-3;
  static constexpr double deep_part = 0.01;
};

/// Findings of a run, beside the model; complete on rank 0.
struct RunStatistics {
  bool complete = false;                ///< the run came to its end, no signal stopped it
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
  std::vector<Slide> slides;                        ///< per contact
  std::vector<PairMotion> pairs;                    ///< per row of the interface
  std::vector<OtherPass> other_passes;              ///< per contact
  std::vector<JointClosing> closings;               ///< per contact, of the samples of the gaps
  StatedPeaks peaks;                                ///< rank 0
  std::vector<std::string> overpressed;      ///< structures with a pendulum whose slope was cut
  std::vector<std::string> warnings;         ///< of the run, one line each
  Facts findings;                            ///< that outputs bring to the summary; rank 0
  PhaseReport phases;                        ///< time and memory
  std::optional<FidelityEstimate> fidelity;  ///< with -fidelity_window; channels on rank 0
};

}  // namespace pounding
