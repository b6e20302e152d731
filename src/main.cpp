#include <cstdio>
#include <cstring>

#include <slepcsys.h>

#include "common/error.h"
#include "common/parallel.h"
#include "driver/run_scene.h"
#include "scene/options_database.h"
#include "scene/scene_reader.h"

namespace {

bool wants_help(int count, char** words) {
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(words[i], "-help") == 0 || std::strcmp(words[i], "--help") == 0 ||
        std::strcmp(words[i], "-h") == 0) {
      return true;
    }
  }
  return false;
}

/// Exit status of the job: 0, 1 after an error, 2 stopped by a signal; messages are one line from
/// rank 0.
int run_job(MPI_Comm comm, const std::vector<std::string>& option_files) {
  const bool root = pounding::rank_of(comm) == 0;
  try {
    const pounding::ReadScene read =
        pounding::read_scene(pounding::read_options_database(option_files));
    pounding::run_scene(comm, read.scene, read.resolved);
    return 0;
  } catch (const pounding::UserError& error) {
    if (root) {
      std::fprintf(stderr, "pounding: %s\n", error.what());
    }
  } catch (const pounding::DivergenceError& error) {
    if (root) {
      std::fprintf(stderr, "pounding: %s\n", error.what());
    }
  } catch (const pounding::StoppedBySignal& stop) {
    if (root) {
      std::fprintf(stderr, "pounding: %s\n", stop.what());
    }
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pounding: internal error on rank %d: %s\n", pounding::rank_of(comm),
                 error.what());
    MPI_Abort(comm, 1);
  }
  return 1;
}

}  // namespace

int main(int count, char** words) {
  MPI_Init(&count, &words);
  const std::vector<std::string> option_files = pounding::take_option_files(count, words);
  int status = 0;
  if (wants_help(count, words)) {
    if (pounding::rank_of(MPI_COMM_WORLD) == 0) {
      std::fputs(pounding::help_text().c_str(), stdout);
    }
  } else if (SlepcInitialize(&count, &words, nullptr, nullptr) != 0) {
    status = 1;
  } else {
    status = run_job(PETSC_COMM_WORLD, option_files);
    SlepcFinalize();
  }
  MPI_Finalize();
  return status;
}
