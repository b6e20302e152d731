#include "ensemble/coordinate_rows.h"

#include <algorithm>
#include <numeric>

#include "common/row_products.h"

namespace pounding {
BatchValue StatesOfRuns::value(const StatePart& part, std::size_t i) const {
  if (batch != nullptr) return (batch->state().*part.of_batch)[i];
  BatchValue value{};
  for (std::size_t run = 0; run < batch_size && own[run] != nullptr; ++run) {
    value[run] = (own[run]->*part.of_run)[i];
  }
  return value;
}

CoordinateRows::CoordinateRows(std::size_t rows, const LinearSystem& system)
    : rows_(rows), width_(system.generalised ? system.lumped_mass.size() : 0) {
  values_.assign(rows_ * width_, 0.0);
}

void CoordinateRows::add(std::size_t row, double factor, const Trace& trace, std::size_t k,
                         double divisor) {
  if (width_ == 0) {
    if (trace.dof(k) >= 0) entries_.push_back({row, trace.dof(k), factor / divisor});
    return;
  }
  const std::span<const double> of_point = trace.row(k);
  for (std::size_t i = 0; i < width_; ++i) {
    values_[row * width_ + i] += factor * of_point[i] / divisor;
  }
}

void CoordinateRows::multiply(const StatesOfRuns& states, const StatePart& part,
                              BatchValue* products) const {
  if (width_ > 0) {
    const std::vector<BatchValue>& x = states.batch->state().*part.of_batch;
    multiply_rows(values_.data(), rows_, width_, x.data(), products);
    return;
  }
  std::fill(products, products + rows_, BatchValue{});
  for (const Entry& entry : entries_) {
    products[entry.row] +=
        states.value(part, static_cast<std::size_t>(entry.dof)) * entry.coefficient;
  }
}

double CoordinateRows::product(std::size_t row, std::span<const double> x) const {
  if (width_ > 0) return std::inner_product(x.begin(), x.end(), &values_[row * width_], 0.0);
  double sum = 0;
  for (const Entry& entry : entries_) {
    if (entry.row == row && !x.empty()) sum += entry.coefficient * x[entry.dof];
  }
  return sum;
}

CoordinateRows mean_rows(std::span<const ResolvedProbe* const> probes, const LinearSystem& system,
                         const Trace& trace) {
  CoordinateRows rows(3 * probes.size(), system);
  std::size_t place = 0;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    const std::size_t nodes = probes[p]->nodes.size();
    for (std::size_t k = 0; k < 9 * nodes; ++k) {
      const double weight = probes[p]->weight(k / 9, k / 3 % 3)[k % 3];
      if (weight == 0) continue;
      rows.add(3 * p + k / 3 % 3, weight, trace, place + k / 9 * 3 + k % 3,
               static_cast<double>(nodes));
    }
    place += 3 * nodes;
  }
  return rows;
}

}  // namespace pounding
