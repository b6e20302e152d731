#include "common/version.h"

#include <array>
#include <commit.h>  // of the build, by cmake/commit.cmake
#include <yaml.h>

#include <dmumps_c.h>
#include <fftw3.h>
#include <hdf5.h>
#include <metis.h>
#include <mpi.h>
#include <slepcsys.h>

namespace pounding {
namespace {

std::string joined(long major, long minor, long patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

std::string slepc_version() {
  PetscInt major = 0, minor = 0, patch = 0, release = 0;
  SlepcGetVersionNumber(&major, &minor, &patch, &release);
  return joined(major, minor, patch);
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, patch = 0;
  H5get_libversion(&major, &minor, &patch);
  return joined(major, minor, patch);
}

/// First line of MPI's own description, up to the first comma: "Open MPI v4.1.4".
std::string mpi_version() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string whole(text.data(), static_cast<std::size_t>(length));
  return whole.substr(0, whole.find_first_of(",\n"));
}

/// Number in FFTW's name for itself: "3.3.10" in "fftw-3.3.10-sse2-avx".
std::string fftw_number() {
  const std::string name = fftw_version;
  const std::size_t first = name.find('-') + 1;
  return name.substr(first, name.find('-', first) - first);
}

}  // namespace

std::string petsc_version() {
  PetscInt major = 0, minor = 0, patch = 0, release = 0;
  PetscGetVersionNumber(&major, &minor, &patch, &release);
  return joined(major, minor, patch);
}

const char* program_version() {
  return POUNDING_VERSION;
}
const char* program_commit() {
  return POUNDING_GIT_HASH;
}

std::vector<std::pair<std::string, std::string>> library_versions() {
  return {{"compiler", std::string("g++ ") + __VERSION__},
          {"MPI", mpi_version()},
          {"PETSc", petsc_version()},
          {"SLEPc", slepc_version()},
          {"MUMPS", MUMPS_VERSION},
          {"Gmsh", POUNDING_GMSH_VERSION},
          {"METIS", joined(METIS_VER_MAJOR, METIS_VER_MINOR, METIS_VER_SUBMINOR)},
          {"HDF5", hdf5_version()},
          {"FFTW", fftw_number()},
          {"LibYAML", yaml_get_version_string()}};
}

}  // namespace pounding
