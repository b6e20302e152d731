#pragma once

#include <string>

#include "scene/scene.h"
#include "soil/impedance_table.h"

namespace pounding {

/// The table of impedances of a structure's soil, in SI and symmetric. Throws UserError with the
/// line: a file that is none, columns that are missing or unknown, frequencies that do not
/// increase, a value that is no number, a matrix that is not symmetric, soil without stiffness at
/// the lowest frequency, or that gives energy. Serial.
ImpedanceTable read_impedances(const Structure& structure);

/// Reads the table of a structure's soil, if it has one, and fits springs, dashpots and masses to
/// it. Throws UserError. Serial.
void fit_soil(Structure& structure);

/// Doubts about the fit: a line for each set of coupled motions that it misses by more than
/// 10 %.
std::vector<std::string> fit_doubts(const Structure& structure);

/// Names of some motions of a mat: "x, ry".
std::string names_of_motions(const std::array<bool, 6>& motions);

}  // namespace pounding
