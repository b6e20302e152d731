#pragma once

#include <cstddef>

#include "common/lanes.h"

/// Products of blocks of six by six numbers, for fields with six values per node.
namespace pounding {

/// Six values as four and two.
struct Six {
  Lanes low{};
  HalfLanes high{};
};

inline void load_six(const double* from, Six& to) {
  load(from, to.low);
  load(from + lane_count, to.high);
}
inline void store_six(double* to, const Six& from) {
  store(to, from.low);
  store(to + lane_count, from.high);
}

/// y -= B x or y += B x, B column by column, in two chains of sums.
template <bool subtract>
inline __attribute__((always_inline)) void accumulate(const double* block, const double* x,
                                                      Six (&y)[2]) {
  for (std::size_t c = 0; c < 6; ++c) {
    Six column;
    load_six(block + 6 * c, column);
    const double value = subtract ? -x[c] : x[c];
    add_product(column.low, Lanes{value, value, value, value}, y[c % 2].low);
    add_product(column.high, HalfLanes{value, value}, y[c % 2].high);
  }
}

inline Six sum(const Six (&y)[2]) {
  return {y[0].low + y[1].low, y[0].high + y[1].high};
}

}  // namespace pounding
