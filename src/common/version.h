#pragma once

namespace pounding {

/// Version of the program, and the commit that it was built from, with "-changed" behind it where
/// the sources were not those of the commit.
const char* program_version();
const char* program_commit();

}  // namespace pounding
