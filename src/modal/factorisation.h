#pragma once

#include "common/petsc.h"

namespace pounding {

/// Workspace of a factor beyond MUMPS's own estimate [per cent].
inline constexpr int factor_workspace = 100;

/// L D L^T by MUMPS, with twice the workspace that it expects to need: of shifted matrices cut in
/// some ways it underestimates that and gives up. PETSc's options -<prefix>mat_mumps_icntl_14 (per
/// cent) and the like still have the last word. To be called before options are read. Collective.
void factorise_with_mumps(PC factorisation);

}  // namespace pounding
