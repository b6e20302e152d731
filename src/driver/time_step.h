#pragma once

#include <string>
#include <vector>

#include "driver/step_limits.h"
#include "modal/modal_basis.h"
#include "scene/scene.h"

namespace pounding {

struct Building;
struct Model;

/// The fastest motion that a structure is asked to resolve: spectra end at `last` [Hz].
ResolvedMotion resolved_motion_of(const Building& building, double last);

/// That of a reduced structure with these squared frequencies.
ResolvedMotion resolved_motion_of(const Structure& structure, const ModalBasis& basis, double last);

/// Limits of all structures and fillers of a model together.
StepLimits step_limits(const Scene& scene, const Model& model);

/// Narrows limits to those of fillers whose stable time step is `stable` [s]; `last`: see above.
void limit_by_fillers(double stable, double last, StepLimits& limits);

/// The time step and the number of steps under these limits. Throws UserError.
void choose_time_step(const Scene& scene, const StepLimits& limits, Model& model);

/// Source of the time step in force, in words: "set by the stable one, -courant 0.9".
std::string step_source_text(const Scene& scene, const Model& model);

/// The step that versions took which did not ask for its resolution [s].
double earlier_time_step(const Scene& scene, const Model& model);

/// A line if a step that was given does not resolve the motion that the limits name.
std::vector<std::string> long_step_warnings(const Scene& scene, const Model& model);

}  // namespace pounding
