#pragma once

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// Rule and skeleton by which a spring or a bar yields, beside yield force, hardening and circle
/// read already; sets the yield force of the component that has the skeleton. `first_slopes`: per
/// component, 0 where none [N/m]; of a bar the first one, its force per strain [N]. Throws
/// UserError.
void read_hysteresis(OptionReader& options, const OptionReader::Names& names,
                     const std::array<double, 6>& first_slopes, NonlinearSpring& spring);

/// Laws of the section of a beam, whose material and section are read already. Throws UserError.
void read_yielding_section(OptionReader& options, const OptionReader::Names& names, Region& region);

/// Law of a shell in shear in its plane or by cracks, whose material and thickness are read
/// already. Throws UserError.
void read_yielding_membrane(OptionReader& options, const OptionReader::Names& names,
                            Region& region);

}  // namespace pounding
