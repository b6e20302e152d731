#pragma once

#include <array>
#include <string>

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
};

}  // namespace pounding
