#pragma once

#include <span>
#include <string>
#include <vector>

#include "motion/signal_treatment.h"

namespace pounding {

/// Options of pounding-spectra; see spectra_help().
struct SpectraOptions {
  std::vector<std::string> files;
  std::vector<std::string> channels;  ///< of a history: probe or probe.direction; empty: all
  std::vector<int> columns{0};        ///< of a record, 1-based; 0: the only one beside the time
  std::string unit;                   ///< of a record; "": as its header says
  double time_step = 0;               ///< of a record [s]; 0: as the file says
  bool relative = false;              ///< history: less the acceleration of the ground
  double start = 0;                   ///< samples before do not count [s]
  std::vector<double> damping_ratios{0.05};
  std::vector<double> frequencies;  ///< [Hz], increasing, above 0
  bool true_peaks = false;          ///< columns of the true peaks beside the pseudo ones
  bool envelope = false;            ///< the envelope of all channels instead of each
  std::vector<double> rotated;      ///< percentiles over all horizontal directions; empty: none
  double broadening = 0;            ///< [-]
  std::string after;                ///< "auto", "free_vibration" or "ignored"
  std::vector<Treatment> treatments{Treatment::complete};
  std::string impacts;                ///< impacts.csv; "": beside the history
  std::vector<std::string> contacts;  ///< whose impacts make the peaks; empty: all
  double margin = 0;                  ///< [s]
  double dirac_step = 0;              ///< [s]; 0: the time step of the run
  std::string output;                 ///< CSV; "": standard output
  std::string peaks;                  ///< CSV of the peaks; "": none
  std::string samples;                ///< CSV of the samples; "": none
  std::string rules;  ///< table of rules that judge the motions; "": spectra instead
  int digits = 9;     ///< significant ones of every number
};

/// The page of --help.
std::string spectra_help();

/// Reads the words of the command line after the program's name. Throws UserError for options that
/// are unknown, out of range, or make no sense together.
SpectraOptions read_spectra_options(std::span<const std::string> words);

}  // namespace pounding
