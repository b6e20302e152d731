#include <cmath>
#include <span>

#include "common/matrix3.h"
#include "common/saved_state.h"
#include "interactions/contact_operator.h"
#include "interactions/interface_rows.h"
#include "interactions/pairing/interface.h"
#include "observers/observed_run.h"
#include "observers/run_statistics.h"
#include "system/trace.h"

namespace pounding {
namespace {

/// The numbers of a slide in a saved state.
constexpr auto slide_members = [](auto& slide, const auto& take) {
  take(slide.distance, slide.facet_size, slide.since);
};

constexpr auto pass_members = [](auto& other, const auto& take) {
  take(other.depth, other.facet_size, other.place[0], other.place[1], other.time);
};

constexpr auto displacement_members = [](auto& moved, const auto& take) {
  take(moved[0], moved[1], moved[2]);
};

const ResultFile pair_table{"joint_pairs.csv", "how near each pair of the contacts came and moved",
                            "contact,x,y,z,initial_gap,least_gap,time,dx,dy,dz"};

/// Three rows for every pair, then one across the faces for those of passes not taken.
std::vector<interactions::Constraint> looked_at(const interactions::Interface& interface) {
  std::vector<interactions::Constraint> rows = interactions::component_rows(interface.constraints);
  rows.insert(rows.end(), interface.watched.begin(), interface.watched.end());
  return rows;
}

/// Pairs are found once, in the initial geometry. This keeps how far each node has moved along the
/// facet that it faces, whether they touch or not, on the ranks that have displacements of the
/// interface. It reads displacements and changes nothing; nothing allocates after construction. Of
/// a run with contacts. Collective.
class SlideWatch final : public Observer {
 public:
  explicit SlideWatch(const ObservedRun& run)
      : run_(run),
        stride_(static_cast<std::int64_t>(
            std::max(1.0, OtherPass::look_interval / run.model.time_step))),
        operator_(run.comm, looked_at(run.model.interface), run.model.meshes),
        traces_(interactions::make_traces(operator_, run.model.systems, run.model.meshes, false)),
        gather_(run.comm,
                interactions::known_dofs(
                    interactions::dofs_by_structure(operator_, run.model.systems.size()), traces_)),
        displacement_(static_cast<std::size_t>(operator_.dofs()), 0.0),
        start_(run.model.interface.constraints.size()),
        largest_(start_.size()),
        slides_(run.scene.contacts.size()),
        passes_(run.scene.contacts.size()) {
    std::size_t known = 0;
    for (const Trace& trace : traces_) {
      first_known_.push_back(known);
      known += trace.known().size();
    }
    mine_.assign(known, 0.0);
    const std::vector<interactions::Constraint>& watched = run.model.interface.watched;
    for (const interactions::Constraint& row : watched) start_gaps_.push_back(row.initial_gap);
    for (const interactions::Constraint& row : run.model.interface.constraints) {
      normals_.push_back(interactions::normal_of(row));
    }
    if (!run.model.equilibrium || !gather_.member()) return;
    gather([&](std::size_t s) { return run.model.systems[s].rest_displacement.data(); }, {});
    for (std::size_t w = 0; w < watched.size(); ++w) {
      if (run.scene.contacts[watched[w].contact].gap_at_rest) start_gaps_[w] -= opening_of(w);
    }
    for (std::size_t row = 0; row < start_.size(); ++row) start_[row] = moved(row);
  }

  std::int64_t next_due(std::int64_t step) const override { return next_multiple(step, stride_); }
  StepNeeds begin(const CdLagrange& stepper) override {
    if (!gather_.member()) return {};
    const State& state = stepper.state();
    for (std::size_t s = 0; s < traces_.size(); ++s) stepper.bring(s, traces_[s].dofs());
    gather([&](std::size_t s) { return state.structures[s].displacement.data(); },
           state.supports.displacement);
    look(static_cast<double>(state.step) * stepper.time_step());
    for (std::size_t row = 0;
         state.step % (PairMotion::looks * stride_) == 0 && row < start_.size(); ++row) {
      const Vector3 since = minus(moved(row), start_[row]);
      for (std::size_t d = 0; d < 3; ++d) {
        largest_[row][d] = std::max(largest_[row][d], std::abs(since[d]));
      }
    }
    return {};
  }

  void keep_state(const StateKeeper& state) override {
    const StateKeeper own = state.known_if(gather_.root() == rank_of(run_.comm));
    own.rows("contact_slide", slides_, slide_members);
    own.rows("contact_other_pass", passes_, pass_members);
    own.rows("pair_displacements", largest_, displacement_members);
  }

  void report(RunStatistics& statistics) override {
    statistics.slides = slides_;
    statistics.other_passes = passes_;
    broadcast_values(run_.comm, gather_.root(), statistics.slides, statistics.other_passes,
                     largest_);
    on_rank0(run_.comm, [&] {
      ResultTable table(run_.scene, pair_table);
      for (std::size_t row = 0; row < largest_.size(); ++row) {
        const interactions::Constraint& pair = run_.model.interface.constraints[row];
        PairMotion& motion = statistics.pairs[row];
        motion.displacement = largest_[row];
        table.row(
            run_.contact_names()[static_cast<std::size_t>(pair.contact)],
            {pair.at[0], pair.at[1], pair.at[2], run_.model.start_gaps[row], motion.least_gap,
             motion.time, motion.displacement[0], motion.displacement[1], motion.displacement[2]});
      }
      table.close();
    });
  }

 private:
  /// Gathers the displacements of the operator's dofs, of every structure's displacements and of
  /// the supports. Members only, collective over them.
  void gather(const auto& of, std::span<const double> supports) {
    for (std::size_t s = 0; s < traces_.size(); ++s) {
      traces_[s].apply(of(s), mine_.data() + first_known_[s], 1, supports);
    }
    gather_.gather(1, mine_, displacement_);
  }

  /// Looks at all pairs at a time [s]. Members only, collective over them.
  void look(double time) {
    std::size_t row = 0;
    for (const interactions::Constraint& constraint : run_.model.interface.constraints) {
      const double distance = norm(cross(normals_[row], moved(row)));
      ++row;
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
    for (std::size_t w = 0; w < start_gaps_.size(); ++w) {
      const interactions::Constraint& other = run_.model.interface.watched[w];
      const double depth = -(start_gaps_[w] + opening_of(w));
      OtherPass& deepest = passes_[other.contact];
      const bool beside = slides_[other.contact].distance > Slide::limit * other.facet_size;
      if (depth > deepest.depth && !beside) deepest = {depth, other.facet_size, other.place, time};
    }
  }

  /// Displacement of the primary relative to the secondary at a row of the interface [m].
  Vector3 moved(std::size_t row) const {
    const auto first = static_cast<int>(3 * row);
    return {operator_.apply(first, displacement_), operator_.apply(first + 1, displacement_),
            operator_.apply(first + 2, displacement_)};
  }

  /// Opening of a row of a pass that is not taken since it was unloaded [m].
  double opening_of(std::size_t row) const {
    return operator_.apply(static_cast<int>(3 * run_.model.interface.constraints.size() + row),
                           displacement_);
  }

  ObservedRun run_;
  std::int64_t stride_;  ///< steps between two looks
  interactions::ContactOperator operator_;
  std::vector<Trace> traces_;             ///< per structure
  std::vector<std::size_t> first_known_;  ///< per structure, into the values of this rank
  interactions::InterfaceGather gather_;
  std::vector<double> mine_;
  std::vector<double> displacement_;  ///< per dof of the operator
  std::vector<Vector3> normals_;      ///< per row of the interface, as the next ones
  std::vector<Vector3> start_;        ///< moved until the start [m]
  std::vector<Vector3> largest_;      ///< components of their motion since [m]
  std::vector<Slide> slides_;         ///< per contact
  std::vector<OtherPass> passes_;     ///< per contact
  std::vector<double> start_gaps_;    ///< per row of passes that are not taken [m]
};

}  // namespace

OutputKind slide_output() {
  return output<SlideWatch>({pair_table},
                            [](const ObservedRun& run) { return run.contact_root() >= 0; });
}

}  // namespace pounding
