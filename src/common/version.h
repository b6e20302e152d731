#pragma once

namespace pounding {

/// Version of the program, and the commit that it was built from.
const char* program_version();
const char* program_commit();

}  // namespace pounding
