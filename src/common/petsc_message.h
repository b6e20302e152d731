#pragma once

#include <string>

#include <petscsys.h>

namespace pounding {

/// Error handler that prints nothing and keeps the message where the error began.
PetscErrorCode keep_petsc_message(MPI_Comm comm, int line, const char* function, const char* file,
                                  PetscErrorCode error, PetscErrorType type, const char* message,
                                  void* context);

/// The message kept last, in one line; "" when there was none since this was asked before.
std::string take_petsc_message();

}  // namespace pounding
