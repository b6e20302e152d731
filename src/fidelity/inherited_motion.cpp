#include "fidelity/inherited_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/parallel.h"
#include "interactions/frictional_contact.h"
#include "observers/observed_run.h"

namespace pounding {

InheritedMotion::InheritedMotion(MPI_Comm comm, const Scene& scene, const Model& model,
                                 std::int64_t first, const SavedState& state, Profile& profile)
    : comm_(comm),
      model_(model),
      stride_(record_stride(scene, model)),
      first_(first),
      motion_(model.motion->part(GroundMotion::Part::leaves, start(), start() + fade_in)),
      none_{{}, {}, {}, model.interface.extents, model.interface.model_size, {}, {}, {}},
      scheme_(parts(scene, profile)),
      means_(model.probes, model.systems, model.meshes),
      rows_(comm, interactions::with_friction_rows(model.interface.constraints), model.systems,
            model.meshes) {
  scheme_.stepper().keep(StateKeeper::from(state));
  take_places(-model.time_step);
  take_places(0);
  record();
}

void InheritedMotion::places(double time, std::vector<double>& result) {
  const double steps = time / model_.time_step;
  const auto whole = static_cast<std::int64_t>(std::floor(steps));
  while (front_ + static_cast<std::int64_t>(places_.size()) < whole + 3) step();
  for (; front_ < whole - 1; ++front_) places_.pop_front();
  // Cubic through the two steps before and the two after.
  const double s = steps - static_cast<double>(whole);
  const double weights[] = {-s * (s - 1) * (s - 2) / 6, (s + 1) * (s - 1) * (s - 2) / 2,
                            -(s + 1) * s * (s - 2) / 2, (s + 1) * s * (s - 1) / 6};
  std::ranges::fill(result, 0.0);
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += weights[k] * places_[k][i];
  }
}

ModelScheme::Parts InheritedMotion::parts(const Scene& scene, Profile& profile) const {
  ModelScheme::Parts parts = scheme_parts(comm_, scene, model_, model_.meshes, profile);
  parts.interface = &none_;
  parts.motion = &motion_;
  return parts;
}

void InheritedMotion::step() {
  CdLagrange& stepper = scheme_.stepper();
  stepper.step(false, false);
  if ((stepper.state().step - 1) % stride_ == 0) record();
  take_places(0);
}

void InheritedMotion::take_places(double duration) {
  std::vector<double> values(rows_.dofs());
  if (rows_.member()) {
    for (std::size_t s = 0; s < model_.systems.size(); ++s) {
      const StructureState& state = scheme_.stepper().state().structures[s];
      std::vector<double> owned = state.displacement;
      for (std::size_t i = 0; i < owned.size(); ++i) owned[i] += duration * state.velocity[i];
      rows_.set(s, 0, 1, owned.data(), {});
    }
    rows_.gather(1, values);
  }
  if (rows_.dofs() > 0) broadcast_array(comm_, values, rows_.root());
  places_.push_back(std::move(values));
}

void InheritedMotion::record() {
  const std::size_t before = records_.size();
  records_.resize(before + means_.channels());
  means_.velocities(scheme_.stepper().state(), {records_.data() + before, means_.channels()});
}

}  // namespace pounding
