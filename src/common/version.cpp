#include "common/version.h"

#include <commit.h>  // of the build, by cmake/commit.cmake

namespace pounding {

const char* program_version() {
  return POUNDING_VERSION;
}
const char* program_commit() {
  return POUNDING_GIT_HASH;
}

}  // namespace pounding
