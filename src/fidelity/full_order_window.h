#pragma once

#include <string>

#include <mpi.h>

#include "model/model.h"
#include "observers/impact_catalogue.h"
#include "observers/recorder.h"
#include "observers/run_statistics.h"
#include "scene/scene.h"

namespace pounding {

/// Reason why a window at full order cannot show the error of a scene's reduced structures, in
/// words that follow "option -...: "; empty where it can.
std::string without_window(const Scene& scene);

/// Estimates how far the floor spectra of a reduced run lie from full order, by two parts.
///
/// The window: a part of the run, `length` [s] around its strongest impact, or around the largest
/// acceleration of its probes where nothing was hit, is stepped at full order. From its beginning
/// on the motion is the sum of two, everything but contact being linear: the one that the reduced
/// structures inherit, without impulses and with the part of the ground's motion that leaves; and
/// that of the structures at full order, from rest, under the other part, which sets in, and under
/// the impulses of contact, whose law holds for the gaps of the sum. Were the reduction exact, the
/// sum would be the reduced run; so the impulses answer to the gap rates of the full equations, and
/// the response of the floors to impulses and ground is that of the full equations. The spectra of
/// the reduced run over the window lie so far from those of the sum.
///
/// The spread: the window inherits its beginning from the reduced run, and does not see the
/// consequences of errors of earlier impacts. The error of the impulses in the window, at least
/// 0.1 %, is the part by which the ground's motion is raised and lowered in two more reduced runs;
/// their spectra lie so far from those of the run, rms of the two. Where impacts decide where the
/// structures meet next this is the larger part.
///
/// Beside these, full order's own errors: of its step, by the window with half the step and, where
/// that may be the largest error, a quarter, which shows its order; and of its mesh
/// (mesh_error.h) `with_mesh`, or `mesh`, where that is not null and has the same channels.
///
/// `model`: the reduced one that was run, `impacts` and `recorder` of that run. The structures are
/// built anew at full order; the reduced run is made once more, and those two. Throws UserError.
/// Collective.
FidelityEstimate estimate_fidelity(MPI_Comm comm, const Scene& scene, const Model& model,
                                   const ImpactCatalogue& impacts, const Recorder& recorder,
                                   double length, bool with_mesh, const ErrorPart* mesh);

}  // namespace pounding
