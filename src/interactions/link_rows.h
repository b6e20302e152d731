#pragma once

#include <memory>

#include "interactions/structure_links.h"

namespace pounding::interactions {

/// The links of a system, which has some and must outlive the object: by their modes where all are
/// dashpots of a structure in generalised coordinates, any others row by row. `structure`: its
/// number; `time_step` [s]. Local.
std::unique_ptr<StructureLinks> make_links(const LinearSystem& system, std::size_t structure,
                                           double time_step);

}  // namespace pounding::interactions
