#pragma once

#include <string>
#include <vector>

#include "driver/model.h"
#include "scene/scene.h"

namespace pounding {

/// Per row of the interface, whether its gap is that of the rest (Contact::gap_at_rest): it is open
/// there, whatever the rest is. Throws UserError, alike on all ranks, where the meshes overlap and
/// the gap of the rest is that of the meshes.
std::vector<char> rows_open_at_rest(const Scene& scene, const interactions::Interface& interface);

/// Gaps at the start of a run: g0 + L u_0, where gaps of the rest make g0 = g - L u_0, row by row;
/// of the joints both. Once the equilibrium is known, if there is one.
void find_start_gaps(const Scene& scene, Model& model);

/// Doubts about gaps of the rest: a joint that its weight opens by more than it is wide.
std::vector<std::string> rest_gap_warnings(const Scene& scene, const Model& model);

}  // namespace pounding
