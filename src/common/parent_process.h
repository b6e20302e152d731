#pragma once

#include <sys/types.h>

namespace pounding {

/// The process that started another one of this machine; 0 where that is not to be seen.
pid_t parent_of(pid_t process);

}  // namespace pounding
