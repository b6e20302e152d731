#pragma once

#include <memory>

#include "driver/observed_run.h"

namespace pounding {

/// Smallest gap at t_n and mean force over the interval of each contact, for the history; and how
/// far the pairs have closed at the samples. On the root of the contacts.
std::unique_ptr<Observer> make_contact_history(const ObservedRun& run);

}  // namespace pounding
