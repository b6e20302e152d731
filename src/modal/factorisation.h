#pragma once

#include "common/petsc.h"

namespace pounding {

/// L D L^T by MUMPS, with twice the workspace that it expects to need: of shifted matrices cut in
/// some ways it underestimates that and gives up. PETSc's options -<prefix>mat_mumps_icntl_14 (per
/// cent) and the like still have the last word. To be called before options are read. Collective.
void factorise_with_mumps(PC factorisation);

/// Memory that the factor of a symmetric matrix takes on all ranks together, as MUMPS expects it
/// after ordering the rows and before any number is computed [B]. Collective.
double factor_memory(Mat matrix);

}  // namespace pounding
