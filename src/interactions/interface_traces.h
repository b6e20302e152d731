#pragma once

#include <span>
#include <vector>

#include "interactions/contact_operator.h"
#include "system/linear_system.h"
#include "system/trace.h"

namespace pounding::interactions {

/// The dofs of an operator that belong to each of some structures, in its order.
std::vector<std::vector<int>> dofs_by_structure(const ContactOperator& contact,
                                                std::size_t structures);

/// The traces of all structures at the dofs of an operator; `impulses`: see Trace.
std::vector<Trace> make_traces(const ContactOperator& contact,
                               std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
                               bool impulses);

/// The dofs of the operator that this rank knows, structure by structure, in the order of the
/// values of the traces.
std::vector<int> known_dofs(std::span<const std::vector<int>> structure_dofs,
                            std::span<const Trace> traces);

}  // namespace pounding::interactions
