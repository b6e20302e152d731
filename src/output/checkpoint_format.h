#pragma once

#include <functional>
#include <string>

#include <mpi.h>

#include "mesh/mesh.h"

/// What writer and reader of a checkpoint share; the format is described in output/checkpoint.h.
namespace pounding::checkpoint_format {

inline constexpr const char* name = "pounding checkpoint";
inline constexpr int version = 1;

/// The group of a structure.
inline std::string folder(const Mesh& mesh) {
  return "structures/" + mesh.structure;
}

inline GlobalIndex element_count(const Mesh& mesh) {
  GlobalIndex count = 0;
  for (const ElementBlock& block : mesh.blocks) {
    count += block.global_count;
  }
  return count;
}

/// Runs `work` on rank 0; what goes wrong becomes one UserError that begins with `prefix`, on every
/// rank. Collective.
void on_rank0_for_user(MPI_Comm comm, const std::string& prefix, const std::function<void()>& work);

}  // namespace pounding::checkpoint_format
