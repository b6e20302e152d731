#include "model/start_at_rest.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "common/error.h"
#include "common/facts.h"
#include "common/progress.h"

namespace pounding {
namespace {

/// Whether a row faces something at the start.
bool is_paired(const interactions::Constraint& row) {
  return row.geometric_gap != interactions::open_gap;
}

/// Widens a range to hold a value.
void take(double value, std::array<double, 2>& range) {
  range = {std::min(range[0], value), std::max(range[1], value)};
}

/// Width of the joint that the gap of its faces leaves out, where a filler is dense [m].
double dense_width(const Contact& contact, const interactions::Constraint& row) {
  return contact.filler ? row.filler.thickness * (1 - contact.filler->dense()) : 0;
}

/// Gaps of pairs that are found anew count from the same rest: by the row's own opening, by the
/// mean of the contact where it faces nothing yet.
void shift_sliding_rows(std::span<const double> opening, std::span<const char> at_rest,
                        const std::vector<interactions::Constraint>& rows,
                        interactions::SlidingFaces& sliding) {
  for (interactions::SlidingFaces::Row& row : sliding.rows) {
    const auto number = static_cast<std::size_t>(row.constraint);
    if (at_rest[number] == 0) continue;
    double shift = opening[number];
    if (!is_paired(rows[number])) {
      double sum = 0;
      int count = 0;
      for (std::size_t r = 0; r < rows.size(); ++r) {
        if (rows[r].contact != row.contact || !is_paired(rows[r])) continue;
        sum += opening[r];
        ++count;
      }
      shift = sum / std::max(1, count);
    }
    row.offset -= shift;
  }
}

}  // namespace

void put_at_rest(MPI_Comm comm, const Scene& scene, std::span<const Mesh> meshes, Profile& profile,
                 Model& model) {
  if (!scene.preload) return;
  const ScopedTimer timer(profile, Phase::assembly);
  const Progress progress(comm, "static equilibrium", scene.progress_interval);
  model.equilibrium =
      find_equilibrium(comm, model.systems, meshes, model.interface,
                       rows_open_at_rest(scene, model.interface), scene.preload_solver);
  for (std::size_t s = 0; s < model.systems.size(); ++s) {
    model.systems[s].rest_displacement = std::move(model.equilibrium->displacement[s]);
    model.systems[s].rest_law_force = std::move(model.equilibrium->law_force[s]);
    if (scene.export_matrices.empty() && !scene.keeps_matrices) {
      model.systems[s].stiffness->release_matrix();
    }
  }
  model.equilibrium->displacement.clear();
  model.equilibrium->law_force.clear();
}

std::vector<char> rows_open_at_rest(const Scene& scene, const interactions::Interface& interface) {
  std::vector<char> open;
  for (const interactions::Constraint& row : interface.constraints) {
    const Contact& contact = scene.contacts[row.contact];
    open.push_back(contact.gap_at_rest ? 1 : 0);
    const double gap = row.of_faces(row.initial_gap);
    if (!contact.gap_at_rest || gap >= -none_below * interface.model_size) continue;
    throw UserError(sentence(
        "option -{}_gap_at rest: {} by {:g mm} somewhere, and a joint is open or just closed at "
        "rest; give -{}_gap, or -{}_gap_at unloaded",
        {contact.name,
         contact.gap.is_of_meshes() ? "the meshes overlap"
                                    : "the gap given, its random part included, is below 0",
         -gap, contact.name, contact.name}));
  }
  return open;
}

void find_start_gaps(const Scene& scene, Model& model) {
  std::vector<interactions::Constraint>& rows = model.interface.constraints;
  constexpr double none = std::numeric_limits<double>::infinity();
  model.joint_gaps.assign(scene.contacts.size(), {{none, -none}, {none, -none}});
  model.start_gaps.clear();
  const std::vector<char> at_rest = rows_open_at_rest(scene, model.interface);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    double start = rows[r].of_faces(rows[r].initial_gap);
    if (is_paired(rows[r])) {
      const double opening = model.equilibrium ? model.equilibrium->opening[r] : 0;
      if (at_rest[r] != 0) {
        rows[r].initial_gap -= opening;
      } else {
        start += opening;
      }
      const double width = dense_width(scene.contacts[rows[r].contact], rows[r]);
      JointGaps& gaps = model.joint_gaps[rows[r].contact];
      take(rows[r].of_faces(rows[r].initial_gap) + width, gaps.unloaded);
      take(start + width, gaps.at_rest);
    }
    model.start_gaps.push_back(start);
  }
  if (model.equilibrium) {
    shift_sliding_rows(model.equilibrium->opening, at_rest, rows, model.interface.sliding);
  }
}

}  // namespace pounding
