#pragma once

#include "driver/impact_watch.h"
#include "driver/observed_run.h"
#include "output/recorder.h"

namespace pounding {

/// The outputs of a run.
struct RunObservers {
  Observers all;
  const ImpactWatch& impacts;
  const Recorder& history;
};

/// The outputs that the scene asks for, in the order in which they see a step: a new one is a line
/// here. Throws UserError. Collective.
RunObservers make_observers(const ObservedRun& run, Profile& profile);

}  // namespace pounding
