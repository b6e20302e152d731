#include "output/storey_drifts.h"

#include <cmath>

namespace pounding {

StoreyDrifts::StoreyDrifts(std::vector<Storey> storeys)
    : storeys_(std::move(storeys)), peaks_(storeys_.size()) {}

void StoreyDrifts::note(double time, std::span<const double> displacement) {
  const auto at = [&](int probe, std::size_t d) {
    return probe < 0 ? 0.0 : displacement[3 * static_cast<std::size_t>(probe) + d];
  };
  for (std::size_t s = 0; s < storeys_.size(); ++s) {
    const Storey& storey = storeys_[s];
    for (std::size_t d = 0; d < 2; ++d) {
      const double drift = (at(storey.upper_probe, d) - at(storey.lower_probe, d)) / storey.height;
      if (std::abs(drift) > std::abs(peaks_[s][d].drift)) peaks_[s][d] = {drift, time};
    }
  }
}

}  // namespace pounding
