#include "observers/storey_drifts.h"

#include <cmath>

namespace pounding {

StoreyDrifts::StoreyDrifts(std::vector<Storey> storeys)
    : storeys_(std::move(storeys)), peaks_(storeys_.size()) {}

void StoreyDrifts::note(double time, std::span<const double> displacement,
                        std::span<const double> bases) {
  const auto at = [](std::span<const double> values, int place, std::size_t d) {
    return place < 0 ? 0.0 : values[3 * static_cast<std::size_t>(place) + d];
  };
  for (std::size_t s = 0; s < storeys_.size(); ++s) {
    const Storey& storey = storeys_[s];
    for (std::size_t d = 0; d < 2; ++d) {
      const double below = storey.lower_probe < 0 ? at(bases, storey.base, d)
                                                  : at(displacement, storey.lower_probe, d);
      const double drift = (at(displacement, storey.upper_probe, d) - below) / storey.height;
      if (std::abs(drift) > std::abs(peaks_[s][d].drift)) peaks_[s][d] = {drift, time};
    }
  }
}

}  // namespace pounding
