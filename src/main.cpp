#include <cstdio>
#include <new>
#include <optional>
#include <span>

#include "common/common_segments.h"
#include "common/crowded_node.h"
#include "common/dense_solver.h"
#include "common/error.h"
#include "common/parallel.h"
#include "common/petsc_session.h"
#include "common/vector_unit.h"
#include "ensemble/run_ensemble.h"
#include "io/hdf5_library.h"
#include "scene/command_line.h"
#include "scene/options_database.h"
#include "scene/scene_origin.h"
#include "scene/scene_reader.h"

namespace {

/// Executes the command line. PETSc is started when the scene is read, and outlives the run.
void run_words(MPI_Comm comm, std::span<const std::string> words,
               std::optional<pounding::PetscSession>& petsc) {
  const pounding::CommandLine line = pounding::read_command_line(words);
  if (line.help || line.version) {
    const std::string text = line.help ? pounding::help_text() : pounding::version_text();
    if (pounding::rank_of(comm) == 0) std::fputs(text.c_str(), stdout);
    return;
  }
  pounding::on_every_rank(comm, pounding::take_blas_memory);
  std::vector<std::string> files;
  const pounding::OptionsDatabase database = pounding::read_options_database(comm, line, &files);
  pounding::ReadScene read = pounding::read_scene(database);
  pounding::use_vector_unit(comm, read.scene.vector_unit);
  for (const std::string& ignored : pounding::ignored_variables()) {
    read.scene.warnings.push_back(ignored);
  }
  petsc.emplace(pounding::petsc_options(database));
  pounding::run_as_asked(comm, read, database, pounding::origin_of(line, files));
}

/// Exit status: 0, 1 after an error, 2 stopped by a signal; a message is one line from rank 0.
int run_job(MPI_Comm comm, std::span<const std::string> words) {
  const pounding::NamelessSegments segments;
  const bool root = pounding::rank_of(comm) == 0;
  std::optional<pounding::PetscSession> petsc;  // ends after the messages: a rank may fail alone
  try {
    run_words(comm, words, petsc);
    return 0;
  } catch (const pounding::UserError& error) {
    if (root) std::fprintf(stderr, "pounding: %s\n", error.what());
  } catch (const pounding::DivergenceError& error) {
    if (root) std::fprintf(stderr, "pounding: %s\n", error.what());
  } catch (const pounding::StoppedBySignal& stop) {
    if (root) std::fprintf(stderr, "pounding: %s\n", stop.what());
    return 2;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "pounding: %s\n",
                 pounding::out_of_memory(pounding::rank_of(comm)).c_str());
    MPI_Abort(comm, 1);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pounding: internal error on rank %d: %s\n", pounding::rank_of(comm),
                 error.what());
    MPI_Abort(comm, 1);
  }
  return 1;
}

}  // namespace

int main(int count, char** words) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // a log grows line by line
  pounding::yield_where_crowded();
  pounding::prepare_hdf5();  // before MPI: else HDF5 closes its files once more at the end of it
  MPI_Init(&count, &words);
  const int status = run_job(MPI_COMM_WORLD, std::vector<std::string>(words + 1, words + count));
  MPI_Finalize();
  return status;
}
