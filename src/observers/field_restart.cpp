#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "common/error.h"
#include "common/parallel.h"
#include "io/hdf5_reader.h"
#include "observers/field_writer.h"

namespace pounding {
namespace {

/// Copies numbers from one place to another, but for zeros, which need no writing.
void copy_numbers(const OffsetFile& from, std::int64_t source, const OffsetFile& to,
                  std::int64_t target, std::int64_t count) {
  constexpr std::int64_t at_a_time = 1 << 17;
  std::vector<double> values;
  for (std::int64_t done = 0; done < count; done += at_a_time) {
    const auto bytes = done * static_cast<std::int64_t>(sizeof(double));
    values.resize(static_cast<std::size_t>(std::min(at_a_time, count - done)));
    from.read(source + bytes, values);
    if (std::ranges::any_of(values, [](double value) { return value != 0; })) {
      to.write(target + bytes, values);
    }
  }
}

}  // namespace

void FieldWriter::keep_state(const StateKeeper& state) {
  const int rank = rank_of(run_.comm);
  state.known_if(rank == 0).numbers("fields_frames", frames_);
  if (frames_ < 0) state.state().refuse_values("fields_frames");
  if (!impulses_.empty()) {
    std::vector<double> all(impulses_.size(), 0.0);
    for (const StructureFields& fields : structures_) {
      for (const auto& [value, place] : fields.contact) all[place] = impulses_[place];
    }
    if (state.puts()) reduce_over_ranks(run_.comm, MPI_SUM, all);
    state.known_if(rank == 0).table("fields_impulse", all);
    if (!state.puts()) impulses_ = std::move(all);
  }
  if (state.puts()) return flush();
  on_rank0(run_.comm, [&] {
    try {
      const Hdf5Reader file(continued_);
      bool same = file.number("/", "time_step") == run_.model.time_step &&
                  file.number("/", "first_step") == static_cast<double>(steps_.first) &&
                  file.number("/", "stride") == static_cast<double>(steps_.stride) &&
                  frames_ <= steps_.count;
      for (const StructureFields& fields : structures_) {
        for (const Quantity& quantity : fields.quantities) {
          if (frames_ == 0 || !same) continue;
          const std::string last = path_of(fields, quantity, frames_ - 1);
          same = file.extent(last) == fields.shape_of(quantity);
        }
      }
      if (!same) {
        throw std::runtime_error(continued_ + ": written by another run than the checkpoint");
      }
      if (!(file.rows("frames", 0, 1)[0] >= static_cast<double>(frames_))) {
        throw std::runtime_error(continued_ + ": fewer frames are whole than the " +
                                 std::to_string(frames_) + " of the checkpoint");
      }
    } catch (const std::runtime_error& error) {
      throw UserError(state.state().source() + ": the fields beside it cannot be continued, " +
                      error.what());
    }
  });
}

void FieldWriter::start(const CdLagrange& /*stepper*/, const SavedState* continued) {
  if (continued == nullptr) return;
  const std::string path = run_.path("fields.h5");
  create(path + ".new");
  on_rank0(run_.comm, [&] {
    copy_frames(path + ".new");
    std::error_code failure;
    std::filesystem::rename(path + ".new", path, failure);
    if (failure) throw UserError(path + ": could not be written (" + failure.message() + ")");
    for (std::int64_t frame = 0; xdmf_ && frame < frames_; ++frame) {
      text_ += frame_text(frame);
    }
    // A list that this run does not keep would be that of the run before.
    if (!xdmf_) std::filesystem::remove(run_.path("fields.xdmf"), failure);
    if (!vtkhdf_) std::filesystem::remove(run_.path("fields.vtkhdf"), failure);
  });
  open();
  flush();
}

void FieldWriter::copy_frames(const std::string& to) const try {
  const Hdf5Reader old(continued_);
  const OffsetFile from(continued_, OffsetFile::Access::read);
  const OffsetFile into(to, OffsetFile::Access::write);
  for (const StructureFields& fields : structures_) {
    for (const Quantity& quantity : fields.quantities) {
      for (std::int64_t frame = 0; frame < frames_; ++frame) {
        copy_numbers(
            from, old.offset(path_of(fields, quantity, frame)), into,
            quantity.offsets[static_cast<std::size_t>(frame)],
            static_cast<std::int64_t>(quantity.of_cells ? fields.cells : 3 * fields.nodes));
      }
    }
  }
  const double frames = static_cast<double>(frames_);
  into.write(frames_offset_, {&frames, 1});
} catch (const UserError&) {
  throw;
} catch (const std::runtime_error& error) {
  throw UserError(std::string("the fields cannot be continued, ") + error.what());
}

}  // namespace pounding
