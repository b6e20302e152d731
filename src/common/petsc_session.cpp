#include "common/petsc_session.h"

#include <cstdlib>
#include <signal.h>

#include "common/petsc.h"
#include "common/petsc_message.h"

namespace pounding {

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
