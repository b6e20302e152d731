#include "ensemble/member_doubts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "checks/run_doubts.h"
#include "checks/warnings.h"
#include "common/error.h"
#include "common/parallel.h"
#include "interactions/pairing/contact_checks.h"
#include "model/start_at_rest.h"
#include "motion/load_histories.h"
#include "motion/synthetic.h"

namespace pounding {

void MemberDoubts::leave_out(std::span<const std::string> known) {
  known_.insert(known_.end(), known.begin(), known.end());
  for (const std::string& line : known) members_.erase(line);
}

void MemberDoubts::add(std::size_t member, std::span<const std::string> lines) {
  for (const std::string& line : lines) {
    if (std::ranges::find(known_, line) != known_.end()) continue;
    std::vector<std::size_t>& members = members_[line];
    if (members.empty() || members.back() != member) members.push_back(member);
  }
}

void MemberDoubts::gather(MPI_Comm comm) {
  for_each_rank(comm, members_, [&](int rank, const auto& of_rank) {
    for (const auto& [line, members] : of_rank) {
      for (const std::size_t member : members) {
        if (rank > 0) add(member, {&line, 1});
      }
    }
  });
  for (auto& [line, members] : members_) std::ranges::sort(members);
}

std::vector<std::string> MemberDoubts::told(const MemberTable& table) const {
  std::vector<std::string> told;
  for (const auto& [line, members] : members_) {
    std::string about =
        members.size() == 1 ? "" : std::to_string(members.size()) + " members, the first is ";
    about += "member " + std::to_string(members[0] + 1) + ", line " +
             std::to_string(table.lines[members[0]]);
    told.push_back(line + " (" + about + ")");
  }
  return told;
}

std::vector<std::string> repeated_members(const MemberTable& table) {
  std::map<std::vector<std::string>, std::size_t> first;
  std::vector<std::string> doubts;
  std::size_t repeated = 0;
  for (std::size_t m = 0; m < table.members(); ++m) {
    std::vector<std::string> values;
    for (std::size_t c = 0; c < table.columns.size(); ++c) values.push_back(table.value(m, c));
    const auto [found, is_new] = first.try_emplace(values, m);
    if (is_new || ++repeated > 1) continue;
    doubts.push_back(table.place(m) + "the same run as line " +
                     std::to_string(table.lines[found->second]));
  }
  if (repeated > 1) doubts[0] += "; so are " + std::to_string(repeated - 1) + " more";
  return doubts;
}

double check_motion(const MemberScene& member, Doubts doubts) {
  const Scene& scene = member.scene;
  std::array<std::optional<MotionComponent>, 3> recorded;
  double interval = std::numeric_limits<double>::infinity();
  doubts.add(scene.warnings);
  try {
    for (std::size_t d = 0; d < 3; ++d) {
      if (!scene.motion[d]) continue;
      if (std::holds_alternative<SyntheticMotion>(scene.motion[d]->source)) {
        doubts.add(synthetic_doubts(std::string("motion ") + direction_names[d], *scene.motion[d]));
        interval = std::min(interval, synthetic_interval);
      } else {
        recorded[d] = scene.motion[d];
      }
    }
    Model model;  // as far as it is known
    model.motion = std::make_unique<GroundMotion>(scene.supports.empty() ? recorded : scene.motion,
                                                  Resampling::linear);
    if (!scene.supports.empty()) {
      model.supports =
          std::make_unique<SupportMotion>(scene.supports, *model.motion, Resampling::linear);
      doubts.add(model.supports->doubts());
    }
    for (const MotionDescription& description : model.motion->descriptions()) {
      interval = std::min(interval, description.time_step);
    }
    doubts.add(model.motion->doubts());
    doubts.add(
        LoadHistories(scene.loads).doubts(scene.loads, model.motion->origin(), scene.end_time));
    add_step_doubts(scene, model, doubts);
  } catch (const UserError& error) {
    throw UserError(member.place + error.what());
  }
  return interval;
}

namespace {

/// The rows of a stop are those of all members: none stops more ways than another.
void require_same_ways(const Scene& scene, const interactions::Interface& interface) {
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    const Contact& contact = scene.contacts[c];
    if (!contact.stop) continue;
    bool both = false;
    for (const interactions::Constraint& row : interface.constraints) {
      both = both || (row.contact == static_cast<int>(c) && row.share[0] > 0);
    }
    if ((contact.gap.values.size() > 1) == both) continue;
    throw UserError("option -" + contact.name + "_gap: the stop has " +
                    (both ? "two numbers" : "one number") +
                    " in the scene, and so it has in every member; give as many here");
  }
}

}  // namespace

void check_member_gaps(std::span<const MemberScene> members,
                       const interactions::Interface& interface, MemberDoubts& doubts) {
  for (std::size_t m = 0; m < members.size(); ++m) {
    const Scene& scene = members[m].scene;
    const std::vector<interactions::GivenGap> gaps(scene.contacts.begin(), scene.contacts.end());
    std::vector<interactions::InterfaceReport> reports = interface.reports;
    for (interactions::InterfaceReport& report : reports) {
      report.smallest_gap = std::numeric_limits<double>::infinity();
      report.largest_gap = -report.smallest_gap;
      report.overlapping = 0;
    }
    try {
      interactions::Interface own;
      own.model_size = interface.model_size;
      for (std::size_t row = 0; row < interface.constraints.size(); ++row) {
        interactions::Constraint& constraint =
            own.constraints.emplace_back(interface.constraints[row]);
        const double gap = set_gap(scene, gaps, constraint);
        interactions::InterfaceReport& report = reports[constraint.contact];
        report.smallest_gap = std::min(report.smallest_gap, gap);
        report.largest_gap = std::max(report.largest_gap, gap);
        report.overlapping += gap < 0 ? 1 : 0;
      }
      require_same_ways(scene, interface);
      if (scene.preload) rows_open_at_rest(scene, own);
      for (std::size_t c = 0; c < reports.size(); ++c) {
        count_patches(scene.contacts[c],
                      std::ranges::equal_range(own.constraints, static_cast<int>(c), {},
                                               &interactions::Constraint::contact),
                      reports[c]);
        doubts.add(m,
                   interactions::check_gaps(scene.contacts[c], reports[c], interface.model_size));
      }
    } catch (const UserError& error) {
      throw UserError(members[m].place + error.what());
    }
  }
}

std::vector<std::string> member_damping_doubts(const MemberScene& member, const Model& model) {
  std::vector<std::string> doubts;
  for (std::size_t s = 0; s < model.buildings.size(); ++s) {
    ModalResult modal = model.buildings[s].modal;
    for (Mode& mode : modal.modes) mode.frequency *= std::sqrt(member.stiffness_factors[s]);
    Doubts(doubts).add(damping_warnings(member.scene.structures[s], modal));
  }
  return doubts;
}

void add_pass_doubts(const Scene& scene, const interactions::Interface& interface,
                     const std::map<std::size_t, MemberResult>& results, MemberDoubts& doubts) {
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    std::vector<OtherPass> passes(scene.contacts.size());
    const auto lines_of = [&](const MemberResult& result) {
      passes[c] = {};
      if (result.other_depth[c] > 0) {
        const auto& row = interface.watched[static_cast<std::size_t>(result.other_row[c])];
        passes[c] = {result.other_depth[c], row.facet_size, row.place, result.other_time[c]};
      }
      std::vector<std::string> lines;
      add_pass_doubts(scene, passes, lines);
      return lines;
    };
    const auto deepest = std::ranges::max_element(
        results, {}, [c](const auto& each) { return each.second.other_depth[c]; });
    if (deepest == results.end()) continue;
    const std::vector<std::string> lines = lines_of(deepest->second);
    for (const auto& [member, result] : results) {
      if (!lines_of(result).empty()) doubts.add(member, lines);
    }
  }
}

std::vector<std::string> result_doubts(const MemberResult& result, double model_size) {
  double largest = 0;
  for (const double displacement : result.displacement) largest = std::max(largest, displacement);
  std::vector<std::string> doubts = displacement_warnings(largest, model_size);
  for (const double residual : result.contact_residual) {
    Doubts(doubts).add(contact_warnings(residual));
  }
  return doubts;
}

}  // namespace pounding
