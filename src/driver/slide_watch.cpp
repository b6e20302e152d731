#include "driver/slide_watch.h"

#include <cmath>

#include "common/number_rows.h"
#include "driver/run_statistics.h"
#include "interactions/contact_operator.h"
#include "interactions/interface_rows.h"
#include "interactions/pairing/interface.h"
#include "system/trace.h"

namespace pounding {
namespace {

/// Faces slide with the sway of their structures: looked at this often, a slide is seen [s].
constexpr double look_interval = 1e-3;

/// The numbers of a slide in a saved state.
constexpr auto slide_members = [](auto& slide, const auto& take) {
  take(slide.distance, slide.facet_size, slide.since);
};

class SlideWatch final : public Observer {
 public:
  explicit SlideWatch(const ObservedRun& run);

  std::int64_t next_due(std::int64_t step) const override { return next_multiple(step, stride_); }
  StepNeeds begin(const CdLagrange& stepper) override;
  void save(SavedState& saved) override {
    if (gather_.root() != rank_of(run_.comm)) return;
    saved.put("contact_slide", to_rows(slides_, slide_members), 3);
  }
  void load(const SavedState& saved) override {
    std::vector<double> values(3 * slides_.size());
    saved.get("contact_slide", values);
    from_rows(values, slides_, slide_members);
  }
  void report(RunStatistics& statistics) override {
    statistics.slides = slides_;
    broadcast_array(run_.comm, statistics.slides, gather_.root());
  }

 private:
  /// Looks at all pairs at a time [s]. Members only, collective over them.
  void look(double time);

  ObservedRun run_;
  std::int64_t stride_;  ///< steps between two looks
  interactions::ContactOperator operator_;
  std::vector<Trace> traces_;             ///< per structure
  std::vector<std::size_t> first_known_;  ///< per structure, into the values of this rank
  interactions::InterfaceGather gather_;
  std::vector<double> mine_;
  std::vector<double> displacement_;  ///< per dof of the operator
  std::vector<Slide> slides_;         ///< per contact
};

}  // namespace

SlideWatch::SlideWatch(const ObservedRun& run)
    : run_(run),
      stride_(static_cast<std::int64_t>(std::max(1.0, look_interval / run.model.time_step))),
      operator_(run.comm, interactions::tangential_rows(run.model.interface.constraints),
                run.model.meshes),
      traces_(interactions::make_traces(operator_, run.model.systems, run.model.meshes, false)),
      gather_(run.comm,
              interactions::known_dofs(
                  interactions::dofs_by_structure(operator_, run.model.systems.size()), traces_)),
      displacement_(static_cast<std::size_t>(operator_.dofs()), 0.0),
      slides_(run.scene.contacts.size()) {
  std::size_t known = 0;
  for (const Trace& trace : traces_) {
    first_known_.push_back(known);
    known += trace.known().size();
  }
  mine_.assign(known, 0.0);
}

StepNeeds SlideWatch::begin(const CdLagrange& stepper) {
  if (!gather_.member()) return {};
  const State& state = stepper.state();
  for (std::size_t s = 0; s < traces_.size(); ++s) {
    traces_[s].apply(state.structures[s].displacement.data(), mine_.data() + first_known_[s], 1,
                     state.supports.displacement);
  }
  look(static_cast<double>(state.step) * stepper.time_step());
  return {};
}

void SlideWatch::look(double time) {
  gather_.gather(1, mine_, displacement_);
  int row = 0;  // two per pair
  for (const interactions::Constraint& constraint : run_.model.interface.constraints) {
    const double distance =
        std::hypot(operator_.apply(row, displacement_), operator_.apply(row + 1, displacement_));
    row += 2;
    const double size = constraint.facet_size;
    Slide& slide = slides_[constraint.contact];
    if (size > 0 && distance > Slide::limit * size && slide.since < 0) slide.since = time;
    // All pairs of a contact face facets, or all a wall.
    if (size > 0 ? distance * slide.facet_size > slide.distance * size || slide.facet_size == 0
                 : distance > slide.distance) {
      slide.distance = distance;
      slide.facet_size = size;
    }
  }
}

std::unique_ptr<Observer> make_slide_watch(const ObservedRun& run) {
  return std::make_unique<SlideWatch>(run);
}

}  // namespace pounding
