#pragma once

#include <map>
#include <string>

#include "driver/model.h"
#include "output/checkpoint.h"

namespace pounding {

/// The options that a continued run has in common with the run before; `resolved`: those in force.
std::map<std::string, std::string> lasting_options(const std::string& resolved);

/// Identity of a run, with which a checkpoint is compared. Alike on every rank.
RunIdentity identity_of(const std::string& resolved, const Model& model);

}  // namespace pounding
