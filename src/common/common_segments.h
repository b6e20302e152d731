#pragma once

#include <string>

namespace pounding {

/// Open MPI keeps the common memory of ranks of one machine in files of /dev/shm, which stay behind
/// when a rank is killed. While this object lives the file of this rank has no name: every rank has
/// found the others' files before, and the memory lasts as long as a rank uses it. At the end there
/// is an empty file of that name, for Open MPI to remove. Does nothing under another MPI. To be
/// made by all ranks of MPI_COMM_WORLD after MPI_Init, and to end before MPI_Finalize.
class NamelessSegments {
 public:
  NamelessSegments();
  NamelessSegments(const NamelessSegments&) = delete;
  NamelessSegments& operator=(const NamelessSegments&) = delete;
  ~NamelessSegments();

 private:
  std::string path_;  ///< empty: there was none
};

}  // namespace pounding
