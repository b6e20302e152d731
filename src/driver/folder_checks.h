#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

/// The folder of results before the work: whether it can be used, and its content.
namespace pounding {

/// Tries that the folder can be made and written, and leaves everything as it was. Throws
/// UserError. Rank 0.
void try_folder(const std::string& option, const std::string& folder);

/// One line where the folder holds results of other structures, meshes or motions than `resolved`
/// tells, which this run replaces; none where a run is continued. Rank 0.
std::vector<std::string> replaced_results(const Scene& scene, const std::string& resolved);

}  // namespace pounding
