#include "common/petsc.h"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <signal.h>
#include <stdexcept>

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

void assemble(Mat matrix) {
  POUNDING_PETSC(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  POUNDING_PETSC(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
}

PetscInt first_row(Mat matrix) {
  PetscInt first = 0;
  POUNDING_PETSC(MatGetOwnershipRange(matrix, &first, nullptr));
  return first;
}

MatHandle diagonal_matrix(MPI_Comm comm, std::span<const double> diagonal) {
  MatHandle matrix;
  const auto size = static_cast<PetscInt>(diagonal.size());
  POUNDING_PETSC(MatCreateAIJ(comm, size, size, PETSC_DETERMINE, PETSC_DETERMINE, 1, nullptr, 0,
                              nullptr, matrix.out()));
  PetscInt row = first_row(matrix.get());
  for (const double value : diagonal) {
    POUNDING_PETSC(MatSetValue(matrix.get(), row, row, value, INSERT_VALUES));
    ++row;
  }
  assemble(matrix.get());
  return matrix;
}

PetscSession::PetscSession(MPI_Comm comm, const std::map<std::string, std::string>& options) {
  PETSC_COMM_WORLD = comm;
  unsetenv("PETSC_OPTIONS");
  unsetenv("PETSC_OPTIONS_YAML");
  words_ = {"pounding", "-skip_petscrc", "-viewer_binary_skip_info"};
  for (const auto& [name, value] : options) {
    words_.push_back("-" + name);
    if (!value.empty()) words_.push_back(value);
  }
  for (std::string& word : words_) pointers_.push_back(word.data());
  pointers_.push_back(nullptr);
  count_ = static_cast<int>(words_.size());
  char** words = pointers_.data();
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  POUNDING_PETSC(SlepcInitialize(&count_, &words, nullptr, nullptr));
  sigaction(SIGHUP, &hangup, nullptr);
  signal(SIGXFSZ, SIG_IGN);
  signal(SIGPIPE, SIG_IGN);
  POUNDING_PETSC(PetscOptionsClearValue(nullptr, "-skip_petscrc"));
  PetscBool obeyed = PETSC_FALSE;  // asked for here, so that -options_left does not miss it
  POUNDING_PETSC(PetscOptionsHasName(nullptr, nullptr, "-viewer_binary_skip_info", &obeyed));
  POUNDING_PETSC(PetscPushErrorHandler(keep_petsc_message, nullptr));
}

PetscSession::~PetscSession() {
  SlepcFinalize();
}

}  // namespace pounding
