#include "observers/field_plan.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "common/error.h"
#include "common/facts.h"
#include "mesh/node_table.h"
#include "observers/observed_run.h"
#include "scene/law_kinds.h"

namespace pounding {
namespace {

/// Whole parts of a number that may miss the next whole one by round-off only.
std::int64_t parts(double count) {
  return static_cast<std::int64_t>(std::floor(count * (1 + 1e-9)));
}

constexpr double large_fields = 1e10;  ///< of a study [bytes]
constexpr double much_longer = 1.5;    ///< between frames than asked for

/// Bytes that are free where a folder is or will be.
double free_room(const std::string& folder) {
  std::error_code failure;
  std::filesystem::path place = std::filesystem::absolute(folder, failure);
  while (place.has_relative_path() && !std::filesystem::exists(place, failure)) {
    place = place.parent_path();
  }
  const std::filesystem::space_info space = std::filesystem::space(place, failure);
  if (failure) return std::numeric_limits<double>::infinity();
  return static_cast<double>(space.available);
}

}  // namespace

std::vector<char> yielding_structures(const Scene& scene) {
  std::vector<char> yields;
  for (const Structure& structure : scene.structures) {
    yields.push_back(std::ranges::any_of(structure.regions, has_element_law) ? 1 : 0);
  }
  return yields;
}

bool shows_rotations(const LinearSystem& system, const Mesh& mesh) {
  const bool rotates = component_columns(mesh) > 3;
  return rotates && !system.generalised;
}

std::size_t cells_of(const Mesh& mesh) {
  GlobalIndex count = 0;
  for (const ElementBlock& block : mesh.blocks) count += block.global_count;
  return static_cast<std::size_t>(count);
}

double fields_size(const Scene& scene, const Model& model, const FieldSteps& steps) {
  const std::vector<char> yields = yielding_structures(scene);
  double numbers = 0;
  for (std::size_t s = 0; s < model.meshes.size(); ++s) {
    const Mesh& mesh = model.meshes[s];
    const int quantities =
        2 + (shows_rotations(model.systems[s], mesh) ? 1 : 0) + (scene.contacts.empty() ? 0 : 1);
    numbers += 3 * quantities * static_cast<double>(mesh.global_nodes);
    if (yields[s] != 0) numbers += 3 * static_cast<double>(cells_of(mesh));
  }
  return numbers * sizeof(double) * static_cast<double>(steps.count);
}

std::optional<FieldSteps> planned_fields(const Scene& scene, const Model& model) {
  if (scene.fields_interval == 0) return std::nullopt;
  const std::int64_t sample = record_stride(scene, model);
  const double interval = static_cast<double>(sample) * model.time_step;
  FieldSteps steps;
  steps.stride = sample * parts(whole_steps(model, scene.fields_interval / interval));
  steps.first =
      sample * static_cast<std::int64_t>(std::ceil(scene.fields_start / interval * (1 - 1e-9)));
  const std::int64_t last = scene.fields_end > 0
                                ? std::min(model.steps, parts(scene.fields_end / model.time_step))
                                : model.steps;
  refuse_if(
      steps.first > last,
      sentence("option -fields_start {} s: {} comes before the first frame",
               {scene.fields_start, (scene.fields_end > 0 ? "-fields_end or the end of the run"
                                                          : "the end of the run")}));
  steps.count = 1 + (last - steps.first) / steps.stride;
  return steps;
}

std::vector<std::string> check_fields(MPI_Comm comm, const Scene& scene, const Model& model) {
  const auto steps = planned_fields(scene, model);
  if (!steps) return {};
  const double bytes = fields_size(scene, model, *steps);
  const double every = static_cast<double>(steps->stride) * model.time_step;
  std::vector<std::string> doubts;
  const std::string frames =
      sentence("option -fields_interval {:.3g} s: {} frames every {:.3g} s take up to {:.3g} GB",
               {scene.fields_interval, steps->count, every, bytes / 1e9});
  if (every > much_longer * scene.fields_interval) {
    doubts.push_back(
        sentence("option -fields_interval {:.3g} s: frames come every {:.3g} s, with samples of "
                 "the probes at most (-output_interval, {:.3g} s)",
                 {scene.fields_interval, every, scene.output_interval}));
  }
  const double room = rank_of(comm) == 0 ? free_room(scene.output) : bytes;
  if (bytes > room) {  // the writer refuses fields that do not fit, a dry run has none
    doubts.push_back(frames + sentence(", and {} has {:.3g} GB left; give a longer interval, or "
                                       "-fields_start and -fields_end",
                                       {scene.output, room / 1e9}));
  } else if (bytes > large_fields) {
    doubts.push_back(frames + "; is the interval in s?");
  }
  return doubts;
}

void print_fields(MPI_Comm comm, const Scene& scene, const Model& model) {
  const auto steps = planned_fields(scene, model);
  if (!steps) return;
  const double bytes = fields_size(scene, model, *steps);
  if (rank_of(comm) != 0) return;
  const auto time = [&](std::int64_t count) {
    return static_cast<double>(count) * model.time_step;
  };
  print(
      sentence("fields for ParaView: {} frames every {:.4g} s from t = {:.4g} s, up to {:.3g} MB\n",
               {steps->count, time(steps->stride), time(steps->first), bytes / 1e6}));
}

}  // namespace pounding
