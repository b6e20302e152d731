#include "driver/run_scene.h"

#include <filesystem>
#include <fstream>

#include "common/error.h"
#include "common/floating_point.h"
#include "common/parallel.h"
#include "driver/floor_spectra.h"
#include "driver/model.h"
#include "driver/report.h"
#include "driver/summary.h"
#include "driver/time_loop.h"
#include "output/csv_file.h"

namespace pounding {
namespace {

/// The result folder exists and can be written; the resolved options are the first thing in it.
void prepare_output(const Scene& scene, const std::string& resolved) {
  std::error_code failure;
  std::filesystem::create_directories(scene.output, failure);
  std::ofstream file(scene.output + "/resolved.yaml");
  file << resolved;
  file.close();
  if (failure || !file) {
    throw UserError("option -output " + scene.output + ": the folder cannot be created or written");
  }
}

void write_energy(const std::string& path, const std::vector<EnergyLine>& ledger) {
  CsvFile file(path);
  file.comment("energy ledger of all structures [J] at time + half a time step [s];");
  file.comment(
      "kinetic = v^T (M - dt/2 C) v / 2, strain = u_{n+1}^T K u_n / 2; the residual closes the "
      "identity");
  file.header("time,kinetic,strain,damping_loss,contact_work,input_work,device_work,residual");
  for (const EnergyLine& line : ledger) {
    file.row("", {line.time, line.kinetic, line.strain, line.damping_loss, line.contact_work,
                  line.input_work, line.device_work, line.residual});
  }
  file.close();
}

std::vector<std::string> contact_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Contact& contact : scene.contacts) {
    names.push_back(contact.name);
  }
  return names;
}

}  // namespace

void run_scene(MPI_Comm comm, const Scene& scene, const std::string& resolved) {
  flush_subnormal_numbers();
  const double start = MPI_Wtime();
  const bool root = rank_of(comm) == 0;
  Profile profile;
  if (root) {
    print_title(scene, size_of(comm));
  }
  const Model model = build_model(comm, scene, profile);
  if (root) {
    print_model(scene, model);
  }
  if (scene.dry_run) {
    const double seconds = TimeLoop(comm, scene, model, profile).measure(200);
    if (root) {
      print_time_step(scene, model, seconds);
    }
    return;
  }
  on_rank0(comm, [&] { prepare_output(scene, resolved); });
  const double seconds = TimeLoop(comm, scene, model, profile).measure(50);
  if (root) {
    print_time_step(scene, model, seconds);
  }
  TimeLoop loop(comm, scene, model, profile);
  const double step_start = MPI_Wtime();
  loop.run();
  RunStatistics statistics;
  statistics.step_time = MPI_Wtime() - step_start;
  loop.fill(statistics);
  on_rank0(comm, [&] {
    const std::vector<ProbeSpectrum> spectra = compute_floor_spectra(scene, loop.recorder());
    write_floor_spectra(scene.output + "/spectra.csv", spectra, loop.recorder().interval());
    write_impacts(scene.output + "/impacts.csv", contact_names(scene), loop.impacts().impacts());
    write_energy(scene.output + "/energy.csv", loop.ledger());
    statistics.wall_time = MPI_Wtime() - start;
    write_summary(scene.output + "/summary.json", scene, resolved, model, statistics,
                  loop.recorder(), size_of(comm));
    print_results(scene, model, statistics, loop.impacts(), loop.recorder(), spectra);
  });
}

}  // namespace pounding
