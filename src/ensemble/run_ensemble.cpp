#include "ensemble/run_ensemble.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "checks/run_doubts.h"
#include "checks/warnings.h"
#include "common/error.h"
#include "common/memory.h"
#include "common/parallel.h"
#include "common/process_state.h"
#include "driver/build_model.h"
#include "driver/time_loop.h"
#include "ensemble/ensemble_file.h"
#include "ensemble/member_batch.h"
#include "ensemble/member_doubts.h"
#include "ensemble/stop_together.h"
#include "fidelity/fidelity_climb.h"
#include "io/new_file.h"
#include "model/time_step.h"
#include "observers/forces.h"
#include "observers/observed_run.h"
#include "observers/run_progress.h"
#include "output/result_folder.h"
#include "report/provenance.h"
#include "report/report.h"
#include "scene/resolved_options.h"

namespace pounding {
namespace {

/// One ensemble from its options to its files.
class Ensemble {
 public:
  Ensemble(MPI_Comm comm, ReadScene read, const OptionsDatabase& database)
      : comm_(comm), read_(std::move(read)), database_(database), scene_(read_.scene) {
    scene_.keeps_matrices = true;
  }

  void run(const SceneOrigin& origin) {
    require_ensemble_scene(scene_);
    std::optional<ResultFolder> folder;  // of rank 0
    on_rank0(comm_, [&] {
      try_folder("output", scene_.output);
      if (!scene_.dry_run) folder.emplace(scene_.output);
    });
    if (root()) print_title(scene_, overrides_text(origin), size_of(comm_));
    read_members();
    build();
    choose_step();
    check_memory();
    tell_doubts();
    if (root()) print_plan();
    if (scene_.dry_run) return;
    open_file();
    step_groups();
    finish();
  }

 private:
  bool root() const { return rank_of(comm_) == 0; }
  std::string path(const char* name) const { return scene_.output + "/" + name; }

  void read_members() {
    layout_.contacts = names_of(scene_.contacts);
    layout_.friction = std::ranges::any_of(
        scene_.contacts, [](const Contact& contact) { return contact.friction > 0; });
    layout_.spans = names_of(scene_.spans);
    layout_.struck = scene_.struck;
    table_ = read_member_table(comm_, read_.ensemble, scene_);
    layout_.table = &table_;
    if (root()) print(warning_facts(repeated_members(table_)));
    for (std::size_t m = 0; m < table_.members(); ++m) {
      members_.push_back(read_member(scene_, database_, table_, m));
    }
    layout_.identity = ensemble_identity(read_.resolved, table_);
    if (!scene_.dry_run) {
      on_rank0(comm_, [&] { EnsembleFile::refuse_another(path("ensemble.h5"), layout_); });
    }
    on_every_rank(comm_, [&] { check_motions(); });
  }

  /// Records must be there and synthetic motions have a target, before hours are spent on others.
  void check_motions() {
    intervals_.assign(members_.size(), std::numeric_limits<double>::infinity());
    for (std::size_t m = rank_of(comm_); m < members_.size(); m += size_of(comm_)) {
      std::vector<std::string> doubts;
      intervals_[m] = check_motion(members_[m], doubts);
      doubts_.add(m, doubts);
    }
  }

  /// The model of the whole job, which computes the bases, and that of this rank alone.
  void build() {
    for (Structure& structure : scene_.structures) {
      if (!structure.modal) continue;
      std::string& file = structure.modal->basis_file;
      if (file.empty() && !scene_.dry_run) file = path(("basis_" + structure.name + ".h5").c_str());
    }
    Profile profile;
    const std::vector<double> ones(scene_.structures.size(), 1.0);
    const auto check_gaps = [this](const interactions::Interface& interface) {
      on_rank0(comm_, [&] { check_member_gaps(members_, interface, doubts_); });
    };
    shared_ = build_model(comm_, scene_, ones, profile, check_gaps);
    for (MemberScene& member : members_) lay_foundations(scene_, member);
    if (root()) print_model(scene_, shared_);
    if (size_of(comm_) > 1 && !scene_.dry_run) {
      MPI_Barrier(comm_);  // the bases are in their files
      own_scene_ = scene_;
      own_scene_.progress_interval = std::numeric_limits<double>::infinity();
      own_ = build_model(MPI_COMM_SELF, own_scene_, ones, profile);
    }
    parts_.model = &model();
    for (std::size_t s = 0; s < model().systems.size(); ++s) {
      parts_.bases.push_back(model().buildings[s].basis);
      if (parts_.bases[s]) parts_.bases[s]->rows = model().systems[s].generalised->rows;
    }
  }

  /// The model of this rank alone.
  Model& model() { return own_ ? *own_ : shared_; }

  /// One time step for all members: that of the one whose limits are the narrowest.
  void choose_step() {
    const double before = shared_.step_limits.resolved.omega;
    StepLimits limits;
    for (std::size_t m = 0; m < members_.size(); ++m) {
      const StepLimits own = member_limits(members_[m], parts_);
      limits.stable = std::min(limits.stable, own.stable);
      limits.resolved = faster(limits.resolved, own.resolved);
      refuse_if(scene_.time_step > own.stable,
                table_.place(m) +
                    sentence("option -time_step {} s: above its stable time step {} s; give a "
                             "smaller one, or leave it out",
                             {scene_.time_step, own.stable}));
    }
    choose_time_step(scene_, limits, shared_);
    choose_time_step(scene_, limits, model());
    if (root() && limits.resolved.omega > before) {
      print(warning_facts(long_step_warnings(scene_, shared_)));
    }
    times_ = {shared_.time_step, record_stride(scene_, shared_), shared_.steps,
              scene_.spectra.start};
    if (root()) {
      print(warning_facts(
          lowered_peak_warnings(scene_, times_.time_step * times_.stride, times_.time_step)));
    }
    for (const ResolvedProbe& probe : shared_.probes) {
      for (const char* direction : direction_names) {
        layout_.channels.push_back(probe.name + " " + direction);
      }
    }
    layout_.bases = names_of(shared_.storey_bases);
    for (const interactions::Constraint& row : shared_.interface.constraints) {
      layout_.pair_contacts.push_back(row.contact);
      layout_.pair_places.insert(layout_.pair_places.end(), row.at.begin(), row.at.end());
    }
    for (const ForceItem& force : scene_.forces) {
      for (const char* part : total_force_names) layout_.forces.push_back(force.name + "." + part);
    }
    for (std::int64_t n = 0; !layout_.forces.empty() && n <= shared_.steps; n += times_.stride) {
      layout_.force_times.push_back(static_cast<double>(n) * shared_.time_step);
    }
    layout_.damping_ratios = scene_.spectra.damping_ratios;
    layout_.frequencies = scene_.spectra.frequencies;
    std::vector<std::string> opened;
    for (const Building& building : shared_.buildings) {
      const std::vector<std::string>& files = building.findings.files.opened;
      opened.insert(opened.end(), files.begin(), files.end());
    }
    for (std::string& line : identity_of_files(comm_, read_.resolved, table_, opened)) {
      layout_.identity.push_back(std::move(line));
    }
    layout_.identity.push_back(sentence("time step {:.17g} s", {shared_.time_step}));
  }

  /// Prints the doubts that single runs of the members would have. Collective.
  void tell_doubts() {
    doubts_.leave_out(scene_.warnings);
    doubts_.leave_out(shared_.warnings);
    for (std::size_t m = rank_of(comm_); m < members_.size(); m += size_of(comm_)) {
      std::vector<std::string> doubts = member_damping_doubts(members_[m], model());
      add_long_step("a sample of its motion", intervals_[m], shared_.time_step, doubts);
      doubts_.add(m, doubts);
    }
    doubts_.gather(comm_);
    if (root()) print(warning_facts(doubts_.told(table_)));
  }

  /// Memory of the histories of eight members [bytes]: of probes, and of forces at all records.
  double memory() const {
    return BatchRecorder::memory(layout_.channels.size() + layout_.forces.size(), times_);
  }

  /// Memory of eight members at full order [bytes]; collective.
  double full_order_memory() const {
    double bytes = parts_.memory();
    reduce_over_ranks(comm_, MPI_SUM, bytes);
    return own_ ? bytes / size_of(comm_) : bytes;  // of a dry run every rank has its part alone
  }

  void check_memory() {
    state_memory_ = full_order_memory();
    const double wanted = (memory() + state_memory_) * size_of(comm_);
    double available = available_memory();
    MPI_Bcast(&available, 1, MPI_DOUBLE, 0, comm_);
    if (wanted <= available) return;
    throw UserError(sentence(
        "option -ensemble: eight histories of {} channels{} on each of {} ranks take {:.1f} GB, "
        "{:.1f} are free; give a larger -output_interval, fewer probes, or fewer ranks",
        {layout_.channels.size(), state_memory_ > 0 ? " and eight runs at full order" : "",
         size_of(comm_), wanted / 1e9, available / 1e9}));
  }

  void print_plan() const {
    print(sentence(
        "ensemble {}: {} members, {} at a time on each rank; time step {:.6g} s, {} steps\n  {}\n"
        "  histories in memory: {:.0f MB} per rank\n",
        {table_.file, members_.size(), batch_size, shared_.time_step, shared_.steps,
         step_source_text(scene_, shared_), memory() / 1e6}));
    for (std::size_t s = 0; s < parts_.bases.size(); ++s) {
      if (parts_.bases[s]) continue;
      print(sentence("  structure {}: at full order, stepped {}\n",
                     {scene_.structures[s].name,
                      parts_.steps_alone(s) ? "run by run" : "eight runs at a time"}));
    }
    if (state_memory_ > 0) {
      print(sentence("  eight runs at full order: {:.0f} MB per rank\n", {state_memory_ / 1e6}));
    }
  }

  void open_file() {
    on_rank0(comm_, [&] {
      EnsembleFile::prepare(path("ensemble.h5"), layout_);
      write_whole_file(path("resolved.yaml"), resolved_yaml(read_.resolved));
    });
    on_every_rank(comm_, [&] { file_.emplace(path("ensemble.h5"), layout_); });
    const std::vector<bool> done = file_->done();
    for (std::size_t m = 0; m < done.size(); ++m) {
      if (!done[m]) missing_.push_back(m);
    }
    MPI_Barrier(comm_);  // nobody writes before all have read
    if (const std::size_t damaged = file_->damaged(); root() && damaged > 0) {
      std::printf(
          "warning: %s: the numbers of %zu members that are said to be done are not those "
          "written; they are stepped again\n",
          path("ensemble.h5").c_str(), damaged);
    }
    if (root() && missing_.size() < done.size()) {
      std::printf("  %zu of %zu members are done already\n", done.size() - missing_.size(),
                  done.size());
    }
  }

  void step_groups() {
    const StopSignal signals;
    StopTogether stop(comm_);
    const double start = MPI_Wtime();
    on_every_rank(comm_, [&] {
      if (missing_.empty()) return;
      parts_.multiply_together();
      BatchRecorder recorder(model(), times_);
      const std::size_t stride = batch_size * static_cast<std::size_t>(size_of(comm_));
      const std::size_t begin = batch_size * static_cast<std::size_t>(rank_of(comm_));
      for (std::size_t first = begin; first < missing_.size(); first += stride) {
        const std::size_t count = std::min(batch_size, missing_.size() - first);
        if (!step_group({&missing_[first], count}, recorder, stop)) return;
        if (root()) show(std::min(first + stride, missing_.size()), MPI_Wtime() - start);
      }
    });
    signal_ = stop.finish();
    seconds_ = MPI_Wtime() - start;
  }

  bool step_group(std::span<const std::size_t> numbers, BatchRecorder& recorder,
                  StopTogether& stop) {
    std::vector<const MemberScene*> scenes;
    for (const std::size_t number : numbers) scenes.push_back(&members_[number]);
    MemberBatch group(scenes, scene_, parts_, recorder);
    try {
      if (!group.run([&] { return stop.ask(); })) return false;
    } catch (const DivergenceError& error) {
      throw UserError(table_.place(numbers[group.failed_member()]) + error.what());
    }
    for (std::size_t member = 0; member < numbers.size(); ++member) {
      file_->write(numbers[member], group.result(member));
    }
    return !stop.ask();
  }

  void show(std::size_t done, double seconds) const {
    const double left =
        seconds / static_cast<double>(done) * static_cast<double>(missing_.size() - done);
    std::printf("  about %zu of %zu members, %s, %s left\n", done, missing_.size(),
                duration_text(seconds).c_str(), duration_text(left).c_str());
  }

  void finish() {
    bool all = false;
    on_rank0(comm_, [&] {
      write_ensemble_table(path("ensemble.csv"), layout_, *file_, scene_.csv_digits);
      const std::vector<bool> flags = file_->done();
      const auto done = static_cast<std::size_t>(std::ranges::count(flags, true));
      all = done == flags.size();
      MemberDoubts doubts;
      std::map<std::size_t, MemberResult> results;
      for (std::size_t m = 0; m < flags.size(); ++m) {
        if (!flags[m]) continue;
        MemberResult& result = results[m] = file_->read(m);
        result.spectra = result.forces = {};
        doubts.add(m, result_doubts(result, shared_.interface.model_size));
      }
      add_pass_doubts(scene_, shared_.interface, results, doubts);
      print(warning_facts(doubts.told(table_)));
      std::printf("ensemble: %zu of %zu members in %s, stepped in %.2f s\n", done, flags.size(),
                  path("ensemble.h5").c_str(), seconds_);
    });
    MPI_Bcast(&all, 1, MPI_C_BOOL, 0, comm_);
    if (signal_ != 0 && !all) {
      throw StoppedBySignal("stopped by " + signal_name(signal_) +
                            "; the same command goes on with the members that are missing");
    }
  }

  MPI_Comm comm_;
  ReadScene read_;
  const OptionsDatabase& database_;
  Scene& scene_;
  MemberTable table_;
  std::vector<MemberScene> members_;
  EnsembleLayout layout_;
  Model shared_;
  Scene own_scene_;
  std::optional<Model>
      own_;  ///< of this rank alone; none on one rank, where the shared one is that
  EnsembleModel parts_;
  double state_memory_ = 0;  ///< of eight members at full order, per rank [bytes]
  BatchRecorder::Times times_;
  std::optional<EnsembleFile> file_;
  MemberDoubts doubts_;
  std::vector<double> intervals_;  ///< shortest between samples of a member's motion [s]
  std::vector<std::size_t> missing_;
  int signal_ = 0;
  double seconds_ = 0;
};

}  // namespace

void run_ensemble(MPI_Comm comm, ReadScene read, const OptionsDatabase& database,
                  const SceneOrigin& origin) {
  flush_subnormal_numbers();
  return_large_arrays();
  Ensemble(comm, std::move(read), database).run(origin);
}

void run_as_asked(MPI_Comm comm, ReadScene read, const OptionsDatabase& database,
                  const SceneOrigin& origin) {
  if (read.scene.fidelity.target > 0) {
    run_within_target(comm, read, database, origin);
  } else if (read.ensemble.empty()) {
    run_estimated(comm, std::move(read), origin);
  } else {
    run_ensemble(comm, std::move(read), database, origin);
  }
}

}  // namespace pounding
