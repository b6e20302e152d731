#include "run_job.h"

#include <cstdio>
#include <new>
#include <optional>

#include "common/byte_texts.h"
#include "common/dense_matrix.h"
#include "common/error.h"
#include "common/parallel.h"
#include "common/petsc.h"
#include "common/process_state.h"
#include "common/vector_unit.h"
#include "ensemble/run_ensemble.h"
#include "scene/command_line.h"
#include "scene/options_database.h"
#include "scene/scene_reader.h"

namespace pounding {
namespace {

/// Executes the command line. PETSc is started when the scene is read, and outlives the run.
void run_words(MPI_Comm comm, std::span<const std::string> words,
               std::optional<PetscSession>& petsc) {
  const CommandLine line = read_command_line(words);
  if (line.asks()) {
    const std::string text = line.help        ? help_text(line.help_about)
                             : line.help_json ? help_json()
                                              : version_text();
    if (rank_of(comm) == 0) std::fputs(text.c_str(), stdout);
    return;
  }
  on_every_rank(comm, take_blas_memory);
  std::vector<std::string> files;
  const OptionsDatabase database = read_options_database(comm, line, &files);
  ReadScene read = read_scene(database);
  use_vector_unit(comm, read.scene.vector_unit);
  for (const std::string& ignored : ignored_variables()) read.scene.warnings.push_back(ignored);
  petsc.emplace(comm, petsc_options(database));
  run_as_asked(comm, read, database, origin_of(line, files));
}

}  // namespace

int run_job(MPI_Comm comm, std::span<const std::string> words) {
  const ProcessState before;
  const bool root = rank_of(comm) == 0;
  std::optional<PetscSession> petsc;  // ends after the messages: a rank may fail alone
  try {
    run_words(comm, words, petsc);
    return 0;
  } catch (const UserError& error) {
    if (root) std::fprintf(stderr, "pounding: %s\n", one_line(error.what()).c_str());
  } catch (const DivergenceError& error) {
    if (root) std::fprintf(stderr, "pounding: %s\n", one_line(error.what()).c_str());
  } catch (const StoppedBySignal& stop) {
    if (root) std::fprintf(stderr, "pounding: %s\n", one_line(stop.what()).c_str());
    return 2;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "pounding: %s\n", out_of_memory(rank_of(comm)).c_str());
    MPI_Abort(comm, 1);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pounding: internal error on rank %d: %s\n", rank_of(comm),
                 one_line(error.what()).c_str());
    MPI_Abort(comm, 1);
  }
  return 1;
}

}  // namespace pounding
