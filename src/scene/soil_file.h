#pragma once

#include <string>

#include "scene/scene.h"

namespace pounding {

/// Reads the file of a structure's soil, if it has one: springs, dashpots, masses and hidden
/// motions, as run/soil writes them, with the misfits that it states. Throws UserError with line
/// and value: a file that is none, a raw table of impedances, no such mat in it, matrices that are
/// not symmetric, soil that has no stiffness against some motion, or that could give energy: a
/// matrix with an eigenvalue below -1e-9 of its diagonals, a hidden part below 0. Serial.
void read_soil_file(Structure& structure);

/// Doubts about the fit: a line for each set of coupled motions that it misses by more than
/// 10 %, by the file; of several mats for the first.
std::vector<std::string> fit_doubts(const Structure& structure);

}  // namespace pounding
