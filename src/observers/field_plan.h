#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <mpi.h>

#include "model/model.h"
#include "scene/scene.h"

namespace pounding {

/// The steps whose motion is kept as a whole: `count` of them from `first` on, every `stride`.
struct FieldSteps {
  std::int64_t first = 0;
  std::int64_t stride = 1;
  std::int64_t count = 0;

  std::int64_t last() const { return first + (count - 1) * stride; }
};

/// Steps whose motion the scene keeps as a whole, all of which the probes record as well; nothing
/// if it keeps none. Throws UserError: the run ends before the first.
std::optional<FieldSteps> planned_fields(const Scene& scene, const Model& model);

/// Doubts about the frames of the scene: asked for more often than they come, too large to be meant
/// or for the disk. On rank 0. Collective.
std::vector<std::string> check_fields(MPI_Comm comm, const Scene& scene, const Model& model);

/// Prints how many frames there will be and the room that they take. Collective.
void print_fields(MPI_Comm comm, const Scene& scene, const Model& model);

/// Per structure of a scene, whether elements of it yield by a law with a skeleton, or crack.
std::vector<char> yielding_structures(const Scene& scene);

/// Whether a picture of the structure has rotations. Collective.
bool shows_rotations(const LinearSystem& system, const Mesh& mesh);

/// Elements of a mesh, of all ranks.
std::size_t cells_of(const Mesh& mesh);

/// Bytes that so many frames take at most. Collective.
double fields_size(const Scene& scene, const Model& model, const FieldSteps& steps);

}  // namespace pounding
