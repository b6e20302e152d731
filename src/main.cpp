#include <cstdio>
#include <string>
#include <vector>

#include "common/crowded_node.h"
#include "common/standard_streams.h"
#include "io/hdf5_file.h"
#include "run_job.h"

int main(int count, char** words) {
  pounding::guard_standard_streams();
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // a log grows line by line
  pounding::yield_while_waiting();
  pounding::listen_nowhere();
  pounding::prepare_hdf5();  // before MPI: else HDF5 closes its files once more at the end of it
  MPI_Init(&count, &words);
  int status = 1;
  {
    const pounding::NamelessSegments segments;
    status = pounding::run_job(MPI_COMM_WORLD, std::vector<std::string>(words + 1, words + count));
  }
  MPI_Finalize();
  return status;
}
