#pragma once

#include <string>
#include <utility>
#include <vector>

namespace pounding {

/// Version of the program, and the commit that it was built from, with "-changed" behind it where
/// the sources were not those of the commit.
const char* program_version();
const char* program_commit();

/// Version of PETSc in use.
std::string petsc_version();

/// Name and version of the compiler, of MPI and of each library that results may depend on: of
/// those in use where a library states it, else of those that the program was built with.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace pounding
