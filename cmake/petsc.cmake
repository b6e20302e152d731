# PETSc and SLEPc by pkg-config: Debian's, those in PKG_CONFIG_PATH, or first those of PETSC_DIR, PETSC_ARCH and
# SLEPC_DIR. By upstream's names of their files, which every installation has: by another that is Debian's alone,
# Debian's would be found in place of what is meant.
set(PETSC_DIR "$ENV{PETSC_DIR}" CACHE PATH "Prefix or sources of PETSc, empty for what pkg-config finds")
set(PETSC_ARCH "$ENV{PETSC_ARCH}" CACHE STRING "Build within the sources of PETSc, empty for a prefix")
set(SLEPC_DIR "$ENV{SLEPC_DIR}" CACHE PATH "Prefix or sources of SLEPc, empty for what pkg-config finds")

foreach(library PETSc SLEPc)
  string(TOUPPER ${library} name)
  if(${name}_DIR)
    cmake_path(SET folder NORMALIZE "${${name}_DIR}/${PETSC_ARCH}/lib/pkgconfig")
    if(NOT EXISTS ${folder}/${library}.pc)
      message(FATAL_ERROR "${name}_DIR is ${${name}_DIR}, PETSC_ARCH '${PETSC_ARCH}': ${folder} has no ${library}.pc; "
        "name a prefix without PETSC_ARCH, or the sources with it")
    endif()
    set(ENV{PKG_CONFIG_PATH} "${folder}:$ENV{PKG_CONFIG_PATH}")
  endif()
  pkg_check_modules(${name} REQUIRED IMPORTED_TARGET ${library}>=3.18)
endforeach()

find_file(petscconf petscconf.h PATHS ${PETSC_INCLUDE_DIRS} NO_DEFAULT_PATH NO_CACHE REQUIRED)
file(STRINGS ${petscconf} choices REGEX "^#define PETSC_(HAVE|USE)_")
macro(refuse_petsc why)
  message(FATAL_ERROR "PETSc of ${petscconf} will not do: ${why}")
endmacro()
if(choices MATCHES "PETSC_USE_64BIT_INDICES")
  refuse_petsc("its integers have 64 bits, meshes and METIS here have 32; configure it without --with-64-bit-indices")
endif()
if(choices MATCHES "PETSC_USE_COMPLEX" OR NOT choices MATCHES "PETSC_USE_REAL_DOUBLE")
  refuse_petsc("its scalars are not real numbers of double precision, as they are by default")
endif()
if(NOT choices MATCHES "PETSC_HAVE_MUMPS")
  refuse_petsc("it lacks MUMPS; configure it with --download-mumps --download-scalapack")
endif()
# The MUMPS that PETSc calls is called for bases directly as well.
find_path(MUMPS_HEADERS dmumps_c.h HINTS ${PETSC_INCLUDE_DIRS} ${PETSC_STATIC_INCLUDE_DIRS} REQUIRED)
find_library(MUMPS_LIBRARY dmumps HINTS ${PETSC_LIBRARY_DIRS} ${PETSC_STATIC_LIBRARY_DIRS} ${PETSC_LIBDIR} REQUIRED)
