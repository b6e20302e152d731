#pragma once

#include <vector>

#include "observers/observed_run.h"

namespace pounding {

/// The outputs of a run, in the order in which they see a step; a new one is a line there.
const std::vector<OutputKind>& output_kinds();

/// The files of all of them, whatever a scene asks for.
const std::vector<ResultFile>& result_files();

/// The observers that the scene asks for; `in_member`: in a member of an ensemble. Throws
/// UserError. Collective.
Observers make_observers(const ObservedRun& run, Profile& profile, bool in_member = false);

}  // namespace pounding
