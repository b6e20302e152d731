#pragma once

#include <map>
#include <string>
#include <vector>

#include <mpi.h>

namespace pounding {

/// PETSc and SLEPc on a communicator for as long as this object lives, with the given options and
/// no others: neither .petscrc nor variables of the environment nor .info files beside matrices are
/// read. An error inside of them prints nothing; it comes back as the exception of the call. Throws
/// std::runtime_error. Collective over the communicator.
class PetscSession {
 public:
  /// Names without the dash; "" for a flag.
  PetscSession(MPI_Comm comm, const std::map<std::string, std::string>& options);
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;
  ~PetscSession();

 private:
  std::vector<std::string> words_;
  std::vector<char*> pointers_;  ///< to words_, then null
  int count_ = 0;
};

}  // namespace pounding
