#include "output/probe_rows.h"

#include <cmath>

namespace pounding {

std::vector<double> probe_rows(const Trace& trace, std::span<const std::size_t> nodes) {
  const std::size_t width = trace.dofs().size();
  std::vector<double> rows(3 * nodes.size() * width, 0.0);
  std::size_t place = 0;
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    for (std::size_t k = 0; k < 3 * nodes[p]; ++k, ++place) {
      double* const mean = &rows[(3 * p + k % 3) * width];
      for (std::size_t i = 0; i < width; ++i) {
        mean[i] += trace.row(place)[i] / static_cast<double>(nodes[p]);
      }
    }
  }
  return rows;
}

std::size_t first_record_from(double start, double time_step, double interval) {
  const double middle = (time_step - interval) / 2;  // of the first record's interval
  return start > 0 ? static_cast<std::size_t>(std::ceil((start - middle) / interval - 1e-6)) : 0;
}

}  // namespace pounding
