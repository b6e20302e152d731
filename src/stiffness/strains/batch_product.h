#pragma once

#include "stiffness/strains/batch_elements.h"

/// The sweep over elements in eight runs, to be compiled where the product of their shape is known:
/// values then go from the ring to registers and back.
namespace pounding::stiffness {

template <typename Shape>
[[gnu::flatten]] void BatchElements<Shape>::apply(std::size_t window, const BatchValue* w,
                                                  BatchValue* q, StateAhead& ahead) const {
  for (std::size_t e = begins_[window]; e < begins_[window + 1]; ++e) {
    const Placed& element = placed_[e];
    ahead.ask();
    const NumbersOfOne numbers{shapes_[element.shape].data()};
    for (std::size_t run = 0; run < batch_size; run += element_lane_count) {
      ElementLanes values[dof_count];
#pragma GCC unroll 24
      for (std::size_t i = 0; i < dof_count; ++i) load(&w[element.at[i]].values[run], values[i]);
      Shape::product(numbers, values);
#pragma GCC unroll 24
      for (std::size_t i = 0; i < dof_count; ++i) {
        double* const to = &q[element.at[i]].values[run];
        ElementLanes sum;
        load(to, sum);
        store(to, sum + values[i]);
      }
    }
  }
}

}  // namespace pounding::stiffness
