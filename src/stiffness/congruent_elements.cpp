#include "stiffness/congruent_elements.h"

#include <cstddef>

#include "common/lanes.h"
#include "stiffness/rows/dof_places.h"

namespace pounding {
namespace {

constexpr int size = max_element_size;
constexpr int rows_at_once = 4;

/// force = matrix * displacement, lane by lane.
void multiply(const double* matrix, const Lanes* displacement, Lanes* force) {
  for (int i = 0; i < size; i += rows_at_once) {
    const double* const row = matrix + i * size;
    Lanes sum[rows_at_once] = {};
    for (int j = 0; j < size; ++j) {
      sum[0] += row[j] * displacement[j];
      sum[1] += row[size + j] * displacement[j];
      sum[2] += row[2 * size + j] * displacement[j];
      sum[3] += row[3 * size + j] * displacement[j];
    }
    for (int r = 0; r < rows_at_once; ++r) force[i + r] = sum[r];
  }
}

}  // namespace

CongruentElements::CongruentElements(LocalIndex owned_dofs, const std::vector<double>& stiffness,
                                     const std::vector<Places>& elements)
    : owned_dofs_(owned_dofs), stiffness_(stiffness) {
  Batch empty{};
  for (auto& places : empty) places.fill(-1);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const std::size_t lane = e % lane_count;
    if (lane == 0) batches_.push_back(empty);
    for (std::size_t i = 0; i < elements[e].size(); ++i) batches_.back()[i][lane] = elements[e][i];
  }
}

std::vector<LocalIndex> CongruentElements::touched_dofs() const {
  std::vector<LocalIndex> dofs;
  for (const Batch& batch : batches_) {
    for (const auto& lanes : batch) {
      for (const LocalIndex place : lanes) {
        if (place >= 0 && place < owned_dofs_) dofs.push_back(place);
      }
    }
  }
  return dofs;
}

void CongruentElements::apply(const double* owned, const double* ghosts, double* q) const {
  Lanes displacement[size];
  Lanes force[size];
  for (const Batch& batch : batches_) {
    for (std::size_t i = 0; i < size; ++i) {
      const auto& place = batch[i];
      displacement[i] = Lanes{value_at(place[0], owned_dofs_, owned, ghosts),
                              value_at(place[1], owned_dofs_, owned, ghosts),
                              value_at(place[2], owned_dofs_, owned, ghosts),
                              value_at(place[3], owned_dofs_, owned, ghosts)};
    }
    multiply(stiffness_.data(), displacement, force);
    // Elements of a batch may share nodes: one after the other.
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      for (std::size_t i = 0; i < size; ++i) {
        const LocalIndex place = batch[i][lane];
        if (place >= 0 && place < owned_dofs_) q[place] += force[i][lane];
      }
    }
  }
}

}  // namespace pounding
