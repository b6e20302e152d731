// Times whole steps of one model, carried out in several ways that take turns. Options:
//
//   -cells X,Y,Z           a brick of concrete of these cells, clamped at x = 0; if Z is 0 a plate of
//                          shells; or
//   -storeys CELLS         the pair of buildings of storey_pair.h, cells per metre; or
//   -scene FILE            a scene of the program, under its own motion
//   -motion FILE           samples of the ground acceleration [m/s2]; -motion_step their step [s]
//   -steps A,B,...         element, assembled (the program's step); aij, baij, sbaij (PETSc's
//                          products in a step written out)
//   -apart                 every rank steps a model of its own, nothing is exchanged
//   -vector_unit UNIT      whose kernels compute, as the program's option
//   -export FOLDER         leaves stiffness.petsc and mass.petsc there (one rank, a brick)
//
// First a line of JSON per way, when it has taken its first steps, and {"ready":true}; then answers
// commands on standard input, "NAME SECONDS" each, with the time per step, on the whole and in the
// quietest tenth of short pieces. For 0 seconds it makes one step between two SIGTRAP, which
// count_instructions waits for.

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

#include <slepcsys.h>

#include "benchmark/command_loop.h"
#include "benchmark/timed_step.h"
#include "common/memory.h"
#include "common/parallel.h"
#include "common/process_state.h"
#include "common/vector_unit.h"

namespace pounding::measuring {
namespace {

/// After this many steps the ways are compared.
constexpr long first_steps = 20;
/// Pieces of a measurement, shorter than what the system gives a program before others get a turn.
constexpr double piece_seconds = 3e-4;

std::string option(const char* name) {
  char text[PETSC_MAX_PATH_LEN] = "";
  POUNDING_PETSC(PetscOptionsGetString(nullptr, nullptr, name, text, sizeof text, nullptr));
  return text;
}

ModelRequest read_request() {
  ModelRequest request;
  std::array<PetscInt, 3> cells{};
  PetscInt count = 3;
  PetscInt cells_per_metre = 0;
  POUNDING_PETSC(
      PetscOptionsGetIntArray(nullptr, nullptr, "-cells", cells.data(), &count, nullptr));
  POUNDING_PETSC(PetscOptionsGetInt(nullptr, nullptr, "-storeys", &cells_per_metre, nullptr));
  POUNDING_PETSC(
      PetscOptionsGetReal(nullptr, nullptr, "-motion_step", &request.motion_step, nullptr));
  request.scene = option("-scene");
  request.cells = {cells[0], cells[1], cells[2]};
  request.cells_per_metre = cells_per_metre;
  request.motion = option("-motion");
  return request;
}

/// Resident memory of all ranks [B].
double resident_memory(MPI_Comm comm) {
  long pages = 0;
  long resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  double bytes = static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE));
  MPI_Allreduce(MPI_IN_PLACE, &bytes, 1, MPI_DOUBLE, MPI_SUM, comm);
  return bytes;
}

void write_petsc(const std::string& path, const std::function<void(PetscViewer)>& write) {
  PetscViewer viewer = nullptr;
  POUNDING_PETSC(PetscViewerBinaryOpen(PETSC_COMM_SELF, path.c_str(), FILE_MODE_WRITE, &viewer));
  write(viewer);
  POUNDING_PETSC(PetscViewerDestroy(&viewer));
}

/// The ways that were asked for, and the models that they share.
class Bench {
 public:
  Bench(ModelRequest request, bool apart)
      : request_(std::move(request)), apart_(apart), before_(resident_memory(PETSC_COMM_WORLD)) {}

  /// Builds a way, takes its first steps and reports. Collective.
  void add(const std::string& name) {
    const SteppedModel& model = model_for(name);
    std::unique_ptr<TimedStep>& step = steps_[name];
    if (name == "element" || name == "assembled") {
      step = make_program_step(model);
    } else {
      step = make_matrix_step(model, name);
    }
    seconds_[name] = time_of(comm(), [&] { step->run(first_steps); }) / first_steps;
    double square = step->displacement_square();
    MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, model.comm);
    answer(comm(), {{"name", name},
                    {"dofs", model.global_dofs() * (apart_ ? size_of(comm()) : 1)},
                    {"ranks", size_of(comm())},
                    {"contact_rows", model.interface.constraints.size()},
                    {"stiffness", model.systems[0].stiffness_method},
                    {"time_step", model.time_step},
                    {"alpha", model.systems[0].damping.alpha},
                    {"beta", model.systems[0].damping.beta},
                    {"first_steps", first_steps},
                    {"displacement_square", square},
                    {"memory_before", before_},
                    {"memory", resident_memory(comm())}});
  }

  /// "NAME SECONDS": steps for about that long. Collective.
  Json measure(const std::string& line) {
    std::istringstream words(line);
    std::string name;
    double lasting = 0;
    words >> name >> lasting;
    const auto step = steps_.find(name);
    if (step == steps_.end() || words.fail() || !(lasting >= 0)) {
      throw std::invalid_argument("cannot measure '" + line + "'");
    }
    if (lasting == 0) {
      std::raise(SIGTRAP);
      step->second->run(1);
      std::raise(SIGTRAP);
      return {{"name", name}, {"steps", 1}};
    }
    const long count = repetitions(comm(), lasting, seconds_[name]);
    double contact = -step->second->contact_seconds();
    const long piece = std::max(1L, static_cast<long>(piece_seconds / seconds_[name]));
    std::vector<double> pieces;
    const double seconds = time_of(comm(), [&] {
      for (long done = 0; done < count; done += piece) {
        const double start = MPI_Wtime();
        const long steps = std::min(piece, count - done);
        step->second->run(steps);
        pieces.push_back((MPI_Wtime() - start) / static_cast<double>(steps));
      }
    });
    const auto quiet = pieces.begin() + static_cast<std::ptrdiff_t>(pieces.size() / 10);
    std::nth_element(pieces.begin(), quiet, pieces.end());
    contact += step->second->contact_seconds();
    MPI_Allreduce(MPI_IN_PLACE, &contact, 1, MPI_DOUBLE, MPI_MAX, comm());
    seconds_[name] = seconds / static_cast<double>(count);
    return {{"name", name},
            {"steps", count},
            {"seconds_per_step", seconds_[name]},
            {"quiet_seconds_per_step", *quiet},
            {"contact_seconds_per_step", contact / static_cast<double>(count)}};
  }

  /// Stiffness and mass in PETSc's binary format.
  void write_matrix(const std::string& folder) {
    SteppedModel& model = model_for("assembled");
    write_petsc(folder + "/stiffness.petsc", [&](PetscViewer viewer) {
      POUNDING_PETSC(MatView(model.systems[0].stiffness->matrix(), viewer));
    });
    const VecHandle mass = wrap_vector(model.systems[0], model.systems[0].lumped_mass);
    write_petsc(folder + "/mass.petsc",
                [&](PetscViewer viewer) { POUNDING_PETSC(VecView(mass.get(), viewer)); });
  }

 private:
  static MPI_Comm comm() { return PETSC_COMM_WORLD; }

  SteppedModel& model_for(const std::string& name) {
    const bool element = name == "element";
    std::unique_ptr<SteppedModel>& model = models_[element ? "element" : "assembled"];
    if (!model) {
      model = std::make_unique<SteppedModel>(
          build_stepped_model(apart_ ? PETSC_COMM_SELF : comm(), request_,
                              element ? StiffnessMethod::element : StiffnessMethod::assembled));
    }
    return *model;
  }

  ModelRequest request_;
  bool apart_;
  double before_;  ///< resident memory when nothing is built yet [B]
  std::map<std::string, std::unique_ptr<SteppedModel>> models_;
  std::map<std::string, std::unique_ptr<TimedStep>> steps_;
  std::map<std::string, double> seconds_;  ///< of a step, as last measured
};

void run() {
  const std::string unit = option("-vector_unit");
  use_vector_unit(PETSC_COMM_WORLD, unit.empty() ? "auto" : unit);
  PetscBool apart = PETSC_FALSE;
  POUNDING_PETSC(PetscOptionsGetBool(nullptr, nullptr, "-apart", &apart, nullptr));
  Bench bench(read_request(), apart == PETSC_TRUE);
  std::istringstream names(option("-steps"));
  for (std::string name; std::getline(names, name, ',');) {
    bench.add(name);
  }
  const std::string folder = option("-export");
  if (!folder.empty()) {
    bench.write_matrix(folder);
  }
  answer(PETSC_COMM_WORLD, {{"ready", true}});
  serve(PETSC_COMM_WORLD, [&](const std::string& line) { return bench.measure(line); });
}

}  // namespace
}  // namespace pounding::measuring

int main(int count, char** words) {
  SlepcInitialize(&count, &words, nullptr, nullptr);
  pounding::flush_subnormal_numbers();
  pounding::return_large_arrays();
  try {
    pounding::measuring::run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "step_benchmark: %s\n", error.what());
    MPI_Abort(PETSC_COMM_WORLD, 1);
  }
  SlepcFinalize();
}
