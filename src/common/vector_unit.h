#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <mpi.h>

/// Vector units of x86-64 by their levels, v2 (SSE4.2), v3 (AVX2 and FMA), v4 (AVX-512): kernels
/// are compiled once for each (cmake/vector_units.cmake), and the program uses those of one.
/// Results of two units differ by round-off, as fused products are rounded once. A program that
/// starts on a machine without the least of its units ends with a line, exit status 1: an
/// instruction that is not there would kill it without a word.
namespace pounding {

/// Names of the units that the kernels are compiled for, from the least. Local.
std::vector<std::string> compiled_vector_units();

/// Name of the unit whose kernels are in use: the best of this machine, unless another is asked
/// for. Local.
std::string vector_unit();

/// Place of the unit in use among those compiled. Local.
std::size_t unit_number();

/// Uses the kernels of the unit at a place among those compiled, which this machine has. Local.
void use_unit_number(std::size_t unit);

/// Uses the kernels of a unit from now on, before anything is computed; `auto` is the best that the
/// machines of all ranks have: ranks that solve one contact problem come to the same bits.
/// Collective. Throws UserError on every rank for a unit that the program or one of the machines
/// has not.
void use_vector_unit(MPI_Comm comm, std::string_view name);

}  // namespace pounding
