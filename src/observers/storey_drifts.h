#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

namespace pounding {

/// Two floors, one above the other, or the lowest floor above the base of its structure.
struct Storey {
  std::string structure;
  std::string upper;     ///< its probe
  std::string lower;     ///< likewise; "base": the ground or the supports
  int upper_probe = 0;   ///< among the probes of a record
  int lower_probe = -1;  ///< likewise; -1: the base
  int base = -1;         ///< among the bases that move; -1: it follows the ground
  double height = 0;     ///< between them [m]
};

/// Largest drift of a storey in one direction: difference of the displacements over the height.
struct DriftPeak {
  double drift = 0;  ///< [-]
  double time = 0;   ///< [s]
};

/// Collects the drifts of storeys along x and y.
class StoreyDrifts {
 public:
  StoreyDrifts() = default;
  explicit StoreyDrifts(std::vector<Storey> storeys);

  /// A record at `time` [s]: displacements of all probes, shape (probes, 3), and of all bases that
  /// move, shape (bases, 3) [m].
  void note(double time, std::span<const double> displacement, std::span<const double> bases);
  const std::vector<Storey>& storeys() const { return storeys_; }
  const std::vector<std::array<DriftPeak, 2>>& peaks() const { return peaks_; }  ///< per storey

 private:
  std::vector<Storey> storeys_;
  std::vector<std::array<DriftPeak, 2>> peaks_;
};

}  // namespace pounding
