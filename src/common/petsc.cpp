#include "common/petsc.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/petsc_message.h"

namespace pounding {
namespace {

std::string kept_message;

}  // namespace

PetscErrorCode keep_petsc_message(MPI_Comm /*comm*/, int /*line*/, const char* /*function*/,
                                  const char* /*file*/, PetscErrorCode error, PetscErrorType type,
                                  const char* message, void* /*context*/) {
  if (type == PETSC_ERROR_INITIAL) {
    kept_message = message != nullptr ? message : "";
    std::ranges::replace(kept_message, '\n', ' ');
  }
  return error;
}

std::string take_petsc_message() {
  return std::exchange(kept_message, "");
}

void check_petsc(PetscErrorCode error, const char* call, const char* file, int line) {
  if (error == 0) return;
  if (error == PETSC_ERR_MEM) throw std::bad_alloc();
  const char* text = nullptr;
  PetscErrorMessage(error, &text, nullptr);
  const std::string message = take_petsc_message();
  throw std::runtime_error(std::string(file) + ":" + std::to_string(line) + ": " + call + ": " +
                           (text != nullptr ? text : "error") + " (" + std::to_string(error) + ")" +
                           (message.empty() ? "" : ": " + message));
}

}  // namespace pounding
