#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "common/parallel.h"
#include "common/saved_state.h"
#include "observers/member_result.h"
#include "observers/observed_run.h"
#include "observers/run_statistics.h"

namespace pounding {
namespace {

const ResultFile struck_table{"struck_areas.csv",
                              "largest mean pressures on the faces of the contacts",
                              "contact,length,height,force,time,x,y,z"};

constexpr double endless = 1e9;  ///< height of a window that is as high as the face [m]

/// A row and the mean force of its patch [N].
struct Pressed {
  const interactions::Constraint* row = nullptr;
  double force = 0;
};

double low_end(const Pressed* one) {
  return one->row->patch[0][0];
}

/// Part of a patch that lies in a window from `low` on.
double part_in(const interactions::Patch& patch, const std::array<double, 2>& low,
               const std::array<double, 2>& sides) {
  double part = 1;
  for (std::size_t d = 0; d < 2; ++d) {
    const auto [from, to] = patch[d];
    const double end = low[d] + sides[d];
    part *= to > from ? std::max(0.0, std::min(to, end) - std::max(from, low[d])) / (to - from)
                      : (from >= low[d] && from <= end ? 1.0 : 0.0);
  }
  return part;
}

/// The pressed patches that windows which share a side with `patch` along each axis may hold.
/// `sorted`: all by their low ends along the first axis, where none is longer than `longest`.
void find_near(const interactions::Patch& patch, const std::array<double, 2>& sides,
               std::span<const Pressed* const> sorted, double longest,
               std::vector<const Pressed*>& near) {
  interactions::Patch reach{};
  for (std::size_t d = 0; d < 2; ++d) {
    const auto [from, to] = patch[d];
    reach[d] = {std::min(from, to - sides[d]), std::max(from, to - sides[d]) + sides[d]};
  }
  near.clear();
  for (auto one = std::ranges::lower_bound(sorted, reach[0][0] - longest, {}, low_end);
       one != sorted.end() && low_end(*one) <= reach[0][1]; ++one) {
    const auto [from, to] = (*one)->row->patch[1];
    if (to >= reach[1][0] && from <= reach[1][1]) near.push_back(*one);
  }
}

/// Largest mean force within windows that lie anywhere on the face of a contact: squares of
/// `struck_areas`, and lengths along its first tangent axis, `struck_edges`, over its whole height.
/// The mean is one over four neighbouring blocks of steps, together as long as `force_window`, or
/// over as many steps as that has, of the impulses of hard contact, stops and crushed strips. The
/// force of a row is spread evenly over its patch, so that the largest sum over all places is one
/// of a window two of whose sides are those of patches. Every rank adds the rows up that it counts;
/// all ranks of the contacts look alike. After `finish` on every rank.
class StruckAreas final : public Observer {
 public:
  explicit StruckAreas(const ObservedRun& run) : run_(run) {
    for (const double area : run.scene.struck.areas) {
      windows_.push_back({std::sqrt(area), std::sqrt(area)});
    }
    for (const double length : run.scene.struck.edges) windows_.push_back({length, endless});
    const double count = whole_steps(run.model, run.scene.force_window / run.model.time_step);
    blocks_ = std::min<std::int64_t>(4, std::llround(count));
    steps_ = std::llround(count / static_cast<double>(blocks_));
    impulses_.resize(static_cast<std::size_t>(blocks_) * run.model.interface.constraints.size());
    found_.resize(run.scene.contacts.size() * windows_.size() * width);
  }

  bool follows() const override { return run_.is_contact_member(); }
  void follow(const CdLagrange& stepper) override {
    if (!run_.scheme.rows_may_act()) return;
    const std::size_t rows = run_.model.interface.constraints.size();
    const auto begin_of = [&](std::int64_t block) {
      return impulses_.begin() + block % blocks_ * static_cast<std::int64_t>(rows);
    };
    const std::int64_t now = (stepper.state().step - 1) / steps_;
    if (now != block_) {
      look();
      for (std::int64_t next = std::max(block_ + 1, now - blocks_ + 1); next <= now; ++next) {
        std::fill_n(begin_of(next), rows, 0.0);
      }
      block_ = now;
    }
    if (!run_.scheme.rows_act()) return;
    const std::span<const double> impulses = run_.scheme.row_actions().impulses;
    for (const int row : run_.scheme.contact()->counted()) begin_of(now)[row] += impulses[row];
  }

  void finish(bool complete) override {
    if (complete && run_.is_contact_member()) look();
    broadcast_values(run_.comm, run_.contact_root(), found_);
  }

  void keep_state(const StateKeeper& state) override {
    if (state.puts() && run_.is_contact_member()) impulses_ = all_impulses();
    const StateKeeper own = state.known_if(run_.is_contact_root());
    own.table("struck_impulses", impulses_);
    own.numbers("struck_block", block_);
    own.table("struck_largest", found_, width);
  }

  void report(RunStatistics& /*statistics*/) override {
    on_rank0(run_.comm, [&] {
      ResultTable table(run_.scene, struck_table);
      for (std::size_t i = 0; i < found_.size() / width; ++i) {
        const auto& [contact, sides] =
            std::pair(i / windows_.size(), windows_[i % windows_.size()]);
        const std::span<const double> at = std::span(found_).subspan(width * i, width);
        table.row(run_.scene.contacts[contact].name,
                  {sides[0], sides[1] < endless ? sides[1] : 0, at[0], at[1], at[2], at[3], at[4]});
      }
      table.close();
    });
  }

  void keep(MemberResult& member) const override { member.struck = found_; }

 private:
  static constexpr std::size_t width = 5;
  static constexpr double more = 1 + 1e-9;  ///< a force that is larger by less is the same
  static constexpr double slightly_more = 1 + 5e-10;  ///< beyond the round-off of a sum

  /// Impulses of all ranks in each block.
  std::vector<double> all_impulses() const {
    const interactions::ContactProblem& contact = *run_.scheme.contact();
    std::vector<double> all = impulses_;
    const std::size_t rows = run_.model.interface.constraints.size();
    for (std::size_t at = 0; at < all.size(); at += rows) {
      interactions::share_rows(contact.comm(), contact.counted(), 1,
                               std::span(all).subspan(at, rows));
    }
    return all;
  }

  /// Looks at the blocks that are there. Collective over the ranks of the contacts.
  void look() {
    const auto& rows = run_.model.interface.constraints;
    const std::vector<double> impulses = all_impulses();
    std::vector<std::vector<Pressed>> pressed(run_.scene.contacts.size());
    for (std::size_t row = 0; row < rows.size(); ++row) {
      double impulse = 0;
      for (std::size_t at = row; at < impulses.size(); at += rows.size()) impulse += impulses[at];
      if (impulse > 0) pressed[rows[row].contact].push_back({&rows[row], impulse / duration()});
    }
    for (std::size_t w = 0; w < windows_.size(); ++w) {
      for (std::size_t c = 0; c < pressed.size(); ++c) {
        look_at(pressed[c], w, &found_[width * (c * windows_.size() + w)]);
      }
    }
  }

  void look_at(std::span<const Pressed> pressed, std::size_t window, double* found) const {
    const std::array<double, 2>& sides = windows_[window];
    std::vector<const Pressed*> sorted, near;
    double longest = 0;
    for (const Pressed& one : pressed) {
      sorted.push_back(&one);
      longest = std::max(longest, (one.row->patch[0][1] - low_end(&one)) * more);
    }
    std::ranges::sort(sorted, {}, low_end);
    for (const Pressed& corner : pressed) {
      const interactions::Patch& patch = corner.row->patch;
      find_near(patch, sides, sorted, longest, near);
      const double all = std::accumulate(near.begin(), near.end(), 0.0,
                                         [](double sum, auto* one) { return sum + one->force; });
      if (all <= found[0] * slightly_more) continue;
      std::ranges::sort(near);  // as the rows are, so that a sum has one order
      for (const int from : {0, 1, 2, 3}) {
        std::array<double, 2> low{};
        for (std::size_t d = 0; d < 2; ++d) {
          low[d] = (from >> d) % 2 == 0 ? patch[d][0] : patch[d][1] - sides[d];
        }
        double sum = 0;
        Vector3 moment{};
        for (const Pressed* const one : near) {
          const double force = one->force * part_in(one->row->patch, low, sides);
          sum += force;
          for (std::size_t d = 0; d < 3; ++d) moment[d] += force * one->row->at[d];
        }
        if (!(sum > found[0] * more)) continue;
        found[0] = sum;
        found[1] = std::max(0.0, static_cast<double>(block_ + 1) * static_cast<double>(steps_) *
                                         run_.model.time_step -
                                     duration() / 2);
        for (std::size_t d = 0; d < 3; ++d) found[2 + d] = moment[d] / sum;
      }
    }
  }

  double duration() const { return static_cast<double>(blocks_ * steps_) * run_.model.time_step; }

  ObservedRun run_;
  std::vector<std::array<double, 2>> windows_;  ///< sides along the tangent axes [m]
  std::int64_t blocks_;                         ///< of a mean
  std::int64_t steps_;                          ///< of a block
  std::int64_t block_ = 0;                      ///< the last one
  std::vector<double> impulses_;                ///< shape (blocks, rows) [N s]
  /// Shape (contacts, windows, 5): force [N], middle of its time [s], centre x, y, z of the forces
  /// in the window [m]; zeros where nothing was struck.
  std::vector<double> found_;
};

}  // namespace

OutputKind struck_output() {
  return output<StruckAreas>(
      {struck_table}, [](const ObservedRun& run) { return run.scene.struck.asked(); }, true);
}

}  // namespace pounding
