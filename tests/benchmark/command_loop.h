#pragma once

#include <functional>
#include <string>

#include <mpi.h>
#include <nlohmann/json.hpp>

/// Measuring programs that stay up and measure when told to, so that a script can let several of
/// them take turns on one machine.
namespace pounding::measuring {

using Json = nlohmann::ordered_json;

/// Prints one line of JSON from rank 0.
void answer(MPI_Comm comm, const Json& json);

/// Reads commands from the standard input of rank 0, one a line, until it ends; every rank calls
/// `measure` with the line, and what it returns on rank 0 is printed. Between commands the ranks
/// sleep: they leave the machine to whoever measures. Collective.
void serve(MPI_Comm comm, const std::function<Json(const std::string&)>& measure);

/// Seconds that `work` takes on the slowest rank; all ranks start together. Collective.
double time_of(MPI_Comm comm, const std::function<void()>& work);

/// How often to repeat what takes `once` [s] so that it lasts about `seconds`, the same number on
/// every rank, at least one. Collective.
long repetitions(MPI_Comm comm, double seconds, double once);

}  // namespace pounding::measuring
