#include <algorithm>
#include <stdexcept>

#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "observers/recorder.h"

namespace pounding {
namespace {

/// Records taken over at a time from an earlier history.
constexpr std::size_t copied_records = 16384;

}  // namespace

void Recorder::keep_state(const StateKeeper& state) {
  if (state.puts()) flush();
  state.table("recorder_ground_velocity", ground_sum_);
  state.known_if(rank_of(run_.comm) == 0).numbers("recorder_records", records_);
  if (records_ < 0) state.state().refuse_values("recorder_records");
  on_rank0(run_.comm, [&] { state.table("recorder_last_velocity", last_velocity_); });
}

void Recorder::take_over(const SavedState& saved) {
  on_rank0(run_.comm, [&] {
    try {
      const Hdf5Reader history(continued_, Hdf5Reader::Kind::left_open);
      check_history(history);
      create_file(run_.path("history.h5") + ".new");
      copy_history(history);
      file_->move_to(run_.path("history.h5"));
    } catch (const UserError&) {
      throw;
    } catch (const std::runtime_error& error) {
      throw UserError(saved.source() + ": the history beside it cannot be continued, " +
                      error.what());
    }
  });
}

void Recorder::check_history(const Hdf5Reader& history) const {
  const std::size_t records = records_;
  const auto refuse_unless = [&](bool same) {
    if (!same) {
      throw std::runtime_error(continued_ + ": written by another run than the checkpoint");
    }
  };
  refuse_unless(history.strings("channels") == channels_);
  if (!rotations_.empty()) refuse_unless(history.strings("rotations") == rotations_);
  for (const RecordColumns& columns : columns_) {
    refuse_unless(history.strings(columns.list) == columns.names);
  }
  for (const Quantity& quantity : quantities()) {
    const Hdf5Reader::Shape shape = history.shape(quantity.name);
    refuse_unless(shape.columns == quantity.columns && shape.rows >= records);
  }
  const double whole = history.rows("records", 0, 1)[0];
  if (!(whole >= static_cast<double>(records))) {
    throw std::runtime_error(sentence("{}: {} of its records are whole, the checkpoint needs {}",
                                      {continued_, whole, records}));
  }
  if (records > 0 && !channels_.empty()) {
    refuse_unless(history.rows("velocity", records - 1, 1) == last_velocity_);
  }
}

void Recorder::copy_history(const Hdf5Reader& history) {
  const std::size_t records = records_;
  for (std::size_t first = 0; first < records; first += copied_records) {
    const std::size_t count = std::min(copied_records, records - first);
    for (const Quantity& quantity : quantities()) {
      file_->append(quantity.name, history.rows(quantity.name, first, count));
    }
    if (!channels_.empty()) {
      const std::vector<double> acceleration = history.rows("acceleration", first, count);
      note_peaks(first, history.rows("displacement", first, count), acceleration,
                 run_.model.storey_bases.empty() ? std::vector<double>()
                                                 : history.rows("base_displacement", first, count));
      accelerations_.insert(accelerations_.end(), acceleration.begin(), acceleration.end());
    }
  }
  count_rows();
}

}  // namespace pounding
