#pragma once

#include <array>
#include <string>

#include "scene/option_row.h"

namespace pounding {

/// Item of equipment on a floor: its capacity, a test response spectrum, is set beside the response
/// spectrum that the floor asks for.
struct Equipment {
  std::string name;
  std::string probe;                        ///< that records the place where it is mounted
  std::array<bool, 3> directions{};         ///< of the motion that the capacity holds for
  std::string capacity_file;                ///< of frequency [Hz] and acceleration
  bool capacity_in_g = false;               ///< else that acceleration is in m/s2
  double damping = 0;                       ///< ratio of both spectra [-]
  double margin = 0;                        ///< of the capacity over what is required [-]
  double broadening = 0;                    ///< of the floor's spectrum, to both sides [-]
  std::array<double, 2> band{0, 1e300};     ///< of the frequencies that count [Hz]
  std::array<double, 2> high_band{20, 40};  ///< whose ratio is reported apart [Hz]
  double dip = 0;                           ///< allowed at single frequencies [-]
  double cabinet_frequency = 0;             ///< of a cabinet between floor and item [Hz]; 0: none
  double cabinet_damping = 0;               ///< ratio of the cabinet [-]

  bool has_cabinet() const { return cabinet_frequency > 0; }

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&Equipment::probe, "<equipment>_probe", text("name", required, "the name of a probe"), "the probe at the place where it is mounted");
    option("<equipment>_direction", word("x|y|z|horizontal|all", "all"), "directions of the motion that its capacity holds for, each by itself");
    option(&Equipment::capacity_file, "<equipment>_capacity", text("file", required, "a file of frequency and acceleration"), "its test response spectrum: a text file of two columns, frequency in Hz and acceleration, linear between in logarithms; frequencies beyond it do not count");
    option(&Equipment::capacity_in_g, "<equipment>_capacity_unit", word("m/s2|g", required), "unit of the accelerations of that file");
    option(&Equipment::damping, "<equipment>_damping", real("-", "0.05", damping_ratio), "damping ratio of both spectra, one of spectra_damping");
    option(&Equipment::margin, "<equipment>_margin", real("-", "0.1", not_negative), "margin: it passes where its capacity is 1 + margin times what is required");
    option(&Equipment::broadening, "<equipment>_broadening", real("-", "0.15", below_1), "part by which the floor's spectrum is widened to both sides before, for the uncertainty of the building's frequencies");
    option(&Equipment::band, "<equipment>_band", reals("Hz", absent("all that both spectra have"), "two frequencies low,high", positive), "frequencies that count");
    option(&Equipment::high_band, "<equipment>_high_band", reals("Hz", "20,40", "two frequencies low,high", positive), "frequencies whose smallest ratio is reported apart: relays and contactors chatter there");
    option(&Equipment::dip, "<equipment>_dip", real("-", "0", below_1), "part of the required ratio that may lack where the frequencies a sixth of an octave below and above have all of it");
    option(&Equipment::cabinet_frequency, "<equipment>_cabinet_frequency", real("Hz", absent("left out: it is mounted on the floor"), positive), "frequency of the cabinet in which it is mounted, an oscillator on the floor");
    option(&Equipment::cabinet_damping, "<equipment>_cabinet_damping", real("-", "0.05", damping_ratio), "damping ratio of the cabinet", needs(&Equipment::has_cabinet));
    // clang-format on
  }
};

}  // namespace pounding
