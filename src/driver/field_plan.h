#pragma once

#include <optional>
#include <string>
#include <vector>

#include "driver/model.h"
#include "interactions/contact_problem.h"
#include "output/field_writer.h"

namespace pounding {

/// Steps between two samples of the probes.
int record_stride(const Scene& scene, const Model& model);

/// Steps between two samples of the gaps, which the probes record as well.
std::int64_t gap_stride(const Scene& scene, const Model& model);

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

}  // namespace pounding
