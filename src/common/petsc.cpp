#include "common/petsc.h"

#include <stdexcept>
#include <string>

namespace pounding {

void check_petsc(PetscErrorCode error, const char* call, const char* file, int line) {
  if (error == 0) {
    return;
  }
  const char* text = nullptr;
  PetscErrorMessage(error, &text, nullptr);
  throw std::runtime_error(std::string(file) + ":" + std::to_string(line) + ": " + call + ": " +
                           (text != nullptr ? text : "error") + " (" + std::to_string(error) + ")");
}

}  // namespace pounding
