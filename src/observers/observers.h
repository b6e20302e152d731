#pragma once

#include <span>

#include "observers/contact_watches.h"
#include "observers/field_plan.h"
#include "observers/recorder.h"

namespace pounding {

/// The outputs of a run.
struct RunObservers {
  Observers all;
  const ImpactWatch& impacts;
  const Recorder& history;
};

/// The outputs that the scene asks for, in the order in which they see a step: a new one is a line
/// there. Throws UserError. Collective.
RunObservers make_observers(const ObservedRun& run, Profile& profile);

/// Names of the tables that they write, of whatever scene.
std::span<const char* const> tables_of_observers();

}  // namespace pounding
