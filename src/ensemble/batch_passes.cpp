#include "ensemble/batch_passes.h"

#include <algorithm>

#include "common/row_products.h"
#include "system/trace.h"

namespace pounding {

BatchRows::BatchRows(std::span<const interactions::Constraint> rows,
                     std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
                     std::size_t columns)
    : carried_(rows.size() * columns), products_(rows.size()) {
  for (std::size_t s = 0; s < meshes.size() && !rows.empty(); ++s) {
    std::vector<TracePoint> places;
    for (const interactions::Constraint& row : rows) {
      for (const interactions::ConstraintTerm& term : row.terms) {
        if (term.structure == static_cast<int>(s)) places.push_back({term.node, term.component});
      }
    }
    CoordinateRows& own = of_structures_.emplace_back(rows.size(), systems[s]);
    const Trace trace(systems[s], meshes[s], places, false);
    std::size_t place = 0;
    for (std::size_t w = 0; w < rows.size(); ++w) {
      for (const interactions::ConstraintTerm& term : rows[w].terms) {
        if (term.structure != static_cast<int>(s)) continue;
        own.add(w, term.coefficient, trace, place);
        const std::span<const double> carried = trace.carried(place);  // none without supports
        for (std::size_t c = 0; c < carried.size(); ++c) {
          carried_[w * columns + c] += term.coefficient * carried[c];
        }
        ++place;
      }
    }
  }
}

void BatchRows::add_to(std::vector<BatchValue>& sums, std::span<const StatesOfRuns> states,
                       const std::vector<BatchValue>& supports) {
  for (std::size_t s = 0; s < of_structures_.size(); ++s) {
    of_structures_[s].multiply(states[s], displacements, products_.data());
    for (std::size_t row = 0; row < size(); ++row) sums[row] += products_[row];
  }
  if (carried_.empty()) return;
  multiply_rows(carried_.data(), size(), supports.size(), supports.data(), products_.data());
  for (std::size_t row = 0; row < size(); ++row) sums[row] += products_[row];
}

double BatchRows::at_rest(std::size_t row, std::span<const LinearSystem> systems) const {
  double sum = 0;
  for (std::size_t s = 0; s < of_structures_.size(); ++s) {
    sum += of_structures_[s].product(row, systems[s].rest_displacement);
  }
  return sum;
}

BatchPasses::BatchPasses(std::span<const MemberScene* const> scenes, std::span<const Model> models,
                         std::span<const Mesh> meshes)
    : watched_(models.front().interface.watched, models.front().systems, meshes,
               models.front().support_columns().size()),
      moving_(interactions::component_rows(models.front().interface.constraints),
              models.front().systems, meshes, models.front().support_columns().size()),
      gaps_(watched_.size()),
      openings_(watched_.size()),
      start_(moving_.size()),
      moved_(moving_.size()),
      largest_(moving_.size()),
      deepest_(scenes.front()->scene.contacts.size()),
      deepest_row_(deepest_.size()) {
  const std::vector<interactions::Constraint>& rows = models.front().interface.watched;
  stride_ =
      static_cast<std::int64_t>(std::max(1.0, OtherPass::look_interval / models.front().time_step));
  for (const interactions::Constraint& row : rows) contact_.push_back(row.contact);
  for (std::size_t member = 0; member < models.size(); ++member) {
    const Model& model = models[member];
    for (std::size_t w = 0; w < rows.size(); ++w) {
      double gap = model.interface.watched[w].initial_gap;
      const bool at_rest = scenes[member]->scene.contacts[rows[w].contact].gap_at_rest;
      if (model.equilibrium && at_rest) gap -= watched_.at_rest(w, model.systems);
      gaps_[w][member] = gap;
    }
    for (std::size_t row = 0; model.equilibrium && row < moving_.size(); ++row) {
      start_[row][member] = -moving_.at_rest(row, model.systems);
    }
  }
}

void BatchPasses::look(std::span<const StatesOfRuns> states,
                       const std::vector<BatchValue>& supports, std::int64_t step, double time) {
  openings_ = gaps_;
  watched_.add_to(openings_, states, supports);
  for (std::size_t w = 0; w < gaps_.size(); ++w) {
    for (std::size_t member = 0; member < batch_size; ++member) {
      OtherPass& deepest = deepest_[contact_[w]][member];
      if (!(-openings_[w][member] > deepest.depth)) continue;
      deepest.depth = -openings_[w][member];
      deepest.time = time;
      deepest_row_[contact_[w]][member] = w;
    }
  }
  if (step % (PairMotion::looks * stride_) != 0) return;
  moved_ = start_;
  moving_.add_to(moved_, states, supports);
  for (std::size_t row = 0; row < moved_.size(); ++row) {
    largest_[row] = larger(largest_[row], magnitude(moved_[row]));
  }
}

void BatchPasses::fill(std::size_t member, MemberResult& result) const {
  for (std::size_t c = 0; c < deepest_.size(); ++c) {
    result.other_depth.push_back(deepest_[c][member].depth);
    result.other_row.push_back(static_cast<double>(deepest_row_[c][member]));
    result.other_time.push_back(deepest_[c][member].time);
  }
  for (const BatchValue& value : largest_) result.pair_displacement.push_back(value[member]);
}

}  // namespace pounding
