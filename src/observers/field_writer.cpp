#include "observers/field_writer.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "common/error.h"
#include "common/parallel.h"
#include "io/schema.h"
#include "mesh/node_table.h"
#include "output/vtkhdf.h"

namespace pounding {
namespace {

constexpr const char* file_name = "fields.h5";

/// Places of the components `first` to `first` + 2 of the owned nodes.
std::vector<TracePoint> owned_places(const Mesh& mesh, int first) {
  std::vector<TracePoint> places;
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    for (int d = first; d < first + 3; ++d) places.push_back({mesh.file_node[node], d});
  }
  return places;
}

/// Whether a picture of the structure has rotations. Collective.
bool shows_rotations(const LinearSystem& system, const Mesh& mesh) {
  const bool rotates = component_columns(mesh) > 3;
  return rotates && !system.generalised;
}

std::size_t cells_of(const Mesh& mesh) {
  GlobalIndex count = 0;
  for (const ElementBlock& block : mesh.blocks) count += block.global_count;
  return static_cast<std::size_t>(count);
}

bool has_value(std::span<const double> values) {
  return std::ranges::any_of(values, [](double value) { return value != 0; });
}

std::string gigabytes(double bytes) {
  std::ostringstream text;
  text.precision(3);
  text << bytes / 1e9 << " GB";
  return text.str();
}

}  // namespace

FieldWriter::FieldWriter(Layout layout, std::span<const LinearSystem> systems,
                         std::span<const Mesh> meshes)
    : layout_(std::move(layout)), meshes_(meshes), impulses_(layout_.places.size(), 0.0) {
  structures_.reserve(meshes.size());
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    structures_.push_back(fields_of(systems[s], meshes[s], s));
  }
  const double bytes =
      size(layout_.steps, systems, meshes, !layout_.places.empty(), layout_.yields);
  on_rank0(layout_.comm, [&] {
    std::error_code failure;
    const auto space = std::filesystem::space(layout_.folder, failure);
    if (!failure && static_cast<double>(space.available) < bytes) {
      throw UserError("option -fields_interval: " + std::to_string(layout_.steps.count) +
                      " frames take up to " + gigabytes(bytes) + ", and " + layout_.folder +
                      " has " + gigabytes(static_cast<double>(space.available)) +
                      " left; give a longer interval, or -fields_start and -fields_end");
    }
  });
  if (!layout_.continued.empty()) return;
  create(layout_.folder + "/" + file_name);
  open();
}

FieldWriter::StructureFields FieldWriter::fields_of(const LinearSystem& system, const Mesh& mesh,
                                                    std::size_t structure) {
  const bool rotations = shows_rotations(system, mesh);
  StructureFields fields{mesh.structure,
                         static_cast<std::size_t>(mesh.global_nodes),
                         cells_of(mesh),
                         Trace(system, mesh, owned_places(mesh, 0), false),
                         {},
                         FileBlocks(mesh),
                         {},
                         {},
                         {}};
  const std::size_t owned = 3 * static_cast<std::size_t>(mesh.owned_nodes);
  fields.block.assign(3 * fields.blocks.count(), 0.0);
  const auto add = [&](const char* name, const char* unit) {
    fields.quantities.push_back({name, unit, std::vector<double>(owned, 0.0), {}});
  };
  add("displacement", "m");
  add("velocity", "m/s");
  if (rotations) {
    fields.rotation.emplace(system, mesh, owned_places(mesh, 3), false);
    add("rotation", "rad");
  }
  if (!layout_.places.empty()) add("contact_impulse", "N s");
  if (layout_.yields[structure] != 0) {
    for (const auto& [name, unit] :
         {std::pair{"ductility", "-"}, {"damage", "-"}, {"lost_energy", "J"}}) {
      fields.quantities.push_back({name, unit, {}, {}, true});
    }
  }
  for (std::size_t i = 0; i < layout_.places.size(); ++i) {
    const ContactPlace& place = layout_.places[i];
    if (place.structure != static_cast<int>(structure)) continue;
    const LocalIndex node = mesh.owned_node(place.node);
    if (node < 0) continue;
    fields.contact.push_back(
        {3 * static_cast<std::size_t>(node) + static_cast<std::size_t>(place.component), i});
  }
  return fields;
}

double FieldWriter::size(const FieldSteps& steps, std::span<const LinearSystem> systems,
                         std::span<const Mesh> meshes, bool contacts,
                         std::span<const char> yields) {
  double bytes = 0;
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const int quantities =
        2 + (shows_rotations(systems[s], meshes[s]) ? 1 : 0) + (contacts ? 1 : 0);
    bytes += static_cast<double>(steps.count) * static_cast<double>(meshes[s].global_nodes) * 3 *
             sizeof(double) * quantities;
    if (yields[s] == 0) continue;
    bytes += static_cast<double>(steps.count) * static_cast<double>(cells_of(meshes[s])) * 3 *
             sizeof(double);
  }
  return bytes;
}

double FieldWriter::time_of(std::int64_t frame) const {
  return static_cast<double>(layout_.steps.first + frame * layout_.steps.stride) *
         layout_.time_step;
}

void FieldWriter::create(const std::string& path) {
  std::optional<Hdf5File> file;
  on_rank0(layout_.comm, [&] {
    file.emplace(path);
    schema::write(*file, schema::fields);
    file->write_attribute("/", "title", layout_.title);
    file->write_attribute("/", "time_step", layout_.time_step);
    file->write_attribute("/", "first_step", static_cast<double>(layout_.steps.first));
    file->write_attribute("/", "stride", static_cast<double>(layout_.steps.stride));
    write_group_names(*file, layout_.labels);
    std::vector<double> times;
    for (std::int64_t f = 0; f < layout_.steps.count; ++f) times.push_back(time_of(f));
    file->write_array("time", 0, times);
    file->write_attribute("time", "unit", "s");
    frames_place_ = file->reserve("frames", {1});
  });
  grids_.clear();
  cell_nodes_.clear();
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    const CellTable cells = gather_cells(meshes_[s]);
    grids_.push_back(write_mesh(file ? &*file : nullptr, meshes_[s], cells, s, layout_.labels));
    for (std::size_t cell = 0; layout_.yields[s] != 0 && cell < cells.count(); ++cell) {
      structures_[s].cell_places[{cells.region[cell], cells.element[cell]}] = cell;
    }
    if (!layout_.vtkhdf) continue;
    on_rank0(layout_.comm,
             [&] { cell_nodes_.push_back(write_vtk_cells(*file, structures_[s].name, cells)); });
  }
  std::vector<std::int64_t> places;
  on_rank0(layout_.comm, [&] {
    places = reserve(*file);
    file->close();
  });
  broadcast_array(layout_.comm, places);
  auto next = places.begin();
  for (StructureFields& fields : structures_) {
    for (Quantity& quantity : fields.quantities) {
      quantity.places.assign(next, next + layout_.steps.count);
      next += layout_.steps.count;
    }
  }
}

std::vector<std::int64_t> FieldWriter::reserve(Hdf5File& file) const {
  std::vector<std::int64_t> places;
  for (const StructureFields& fields : structures_) {
    for (const Quantity& quantity : fields.quantities) {
      for (std::int64_t frame = 0; frame < layout_.steps.count; ++frame) {
        places.push_back(file.reserve(path_of(fields, quantity, frame), fields.shape_of(quantity)));
      }
      const std::string group = fields.name + "/" + quantity.name;
      file.write_attribute(group, "unit", quantity.unit);
      if (quantity.name == "velocity") {
        file.write_attribute(group, "time_offset", layout_.time_step / 2);
      }
    }
  }
  return places;
}

std::string FieldWriter::path_of(const StructureFields& fields, const Quantity& quantity,
                                 std::int64_t frame) {
  char number[24];
  std::snprintf(number, sizeof number, "/%06lld", static_cast<long long>(frame));
  return fields.name + "/" + quantity.name + number;
}

void FieldWriter::open() {
  on_every_rank(layout_.comm, [&] {
    file_ =
        std::make_unique<PlacedFile>(layout_.folder + "/" + file_name, PlacedFile::Access::write);
  });
}

std::int64_t FieldWriter::next_due(std::int64_t step) const {
  const FieldSteps& steps = layout_.steps;
  if (step > steps.last()) return never;
  return step <= steps.first ? steps.first
                             : steps.first + next_multiple(step - steps.first, steps.stride);
}

StepNeeds FieldWriter::begin(const CdLagrange& stepper) {
  const State& state = stepper.state();
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    StructureFields& fields = structures_[s];
    const std::vector<double>& moved = state.structures[s].displacement;
    fields.displacement.apply(moved.data(), fields.quantities[0].owned.data(), 1,
                              state.supports.displacement);
    if (fields.rotation) {
      fields.rotation->apply(moved.data(), fields.quantities[2].owned.data(), 1,
                             state.supports.displacement);
    }
  }
  return {};
}

void FieldWriter::follow(const CdLagrange& stepper) {
  const std::int64_t step = stepper.state().step - 1;
  const FieldSteps& steps = layout_.steps;
  if (step > steps.first - steps.stride && step <= steps.last()) layout_.add_impulses(impulses_);
}

void FieldWriter::observe(const CdLagrange& stepper) {
  const State& state = stepper.state();
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    StructureFields& fields = structures_[s];
    fields.displacement.apply(state.structures[s].velocity.data(),
                              fields.quantities[1].owned.data(), 1, state.supports.velocity);
    const auto impulse = std::ranges::find(fields.quantities, "contact_impulse", &Quantity::name);
    for (const auto& [value, place] : fields.contact) impulse->owned[value] = impulses_[place];
    if (layout_.yields[s] != 0) write_cells(s);
    for (Quantity& quantity : fields.quantities) {
      if (quantity.of_cells) continue;
      fields.blocks.to_file(quantity.owned, 3, fields.block);
      on_every_rank(layout_.comm, [&] {  // places without a value are 0
        if (!has_value(fields.block)) return;
        constexpr std::int64_t bytes = 3 * sizeof(double);
        const std::int64_t place = quantity.places[static_cast<std::size_t>(frames_)];
        file_->write(place + bytes * fields.blocks.first(), fields.block);
      });
    }
  }
  std::ranges::fill(impulses_, 0.0);
  on_rank0(layout_.comm, [&] {
    const double frames = static_cast<double>(frames_ + 1);
    file_->write(frames_place_, {&frames, 1});
    if (layout_.xdmf) text_ += frame_text(frames_);
  });
  ++frames_;
}

void FieldWriter::write_cells(std::size_t structure) {
  constexpr std::size_t width = 5;
  const std::vector<double> rows = gather_rows(layout_.comm, layout_.yielding(structure));
  on_rank0(layout_.comm, [&] {
    StructureFields& fields = structures_[structure];
    std::size_t column = 2;
    for (const Quantity& quantity : fields.quantities) {
      if (!quantity.of_cells) continue;
      std::vector<double> values(fields.cells, 0.0);
      for (std::size_t r = 0; r < rows.size(); r += width) {
        const std::pair key{static_cast<std::int32_t>(rows[r]),
                            static_cast<std::int32_t>(rows[r + 1])};
        values[fields.cell_places.at(key)] = rows[r + column];
      }
      ++column;
      if (!has_value(values)) continue;
      file_->write(quantity.places[static_cast<std::size_t>(frames_)], values);
    }
  });
}

std::string FieldWriter::frame_text(std::int64_t frame) const {
  std::string grids;
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    const StructureFields& fields = structures_[s];
    XdmfGrid grid = grids_[s];
    for (const Quantity& quantity : fields.quantities) {
      (quantity.of_cells ? grid.cell_values : grid.node_values)
          .push_back(
              {quantity.name, path_of(fields, quantity, frame), false, fields.shape_of(quantity)});
    }
    grids += xdmf_grid(file_name, grid);
  }
  return xdmf_side_by_side("frame " + std::to_string(frame), time_of(frame), grids);
}

void FieldWriter::list_for_vtk() const {
  std::vector<VtkhdfArray> arrays;
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    const StructureFields& fields = structures_[s];
    for (const Quantity& quantity : fields.quantities) {
      auto array = std::ranges::find(arrays, quantity.name, &VtkhdfArray::name);
      if (array == arrays.end()) {
        const double offset = quantity.name == "velocity" ? layout_.time_step / 2 : 0;
        array = arrays.insert(array, {quantity.name, quantity.unit, offset, {}, quantity.of_cells});
        array->paths.resize(structures_.size());
      }
      for (std::int64_t frame = 0; frame < frames_; ++frame) {
        array->paths[s].push_back(path_of(fields, quantity, frame));
      }
    }
  }
  std::vector<double> times;
  for (std::int64_t frame = 0; frame < frames_; ++frame) times.push_back(time_of(frame));
  write_vtkhdf(layout_.folder + "/fields.vtkhdf", file_name, grids_, cell_nodes_, arrays, times);
}

void FieldWriter::flush() {
  on_rank0(layout_.comm, [&] {
    if (frames_ == 0) return;
    if (layout_.vtkhdf) list_for_vtk();
    if (!layout_.xdmf) return;
    write_whole_file(layout_.folder + "/fields.xdmf", xdmf_document(xdmf_in_time("fields", text_)));
  });
}

void FieldWriter::finish(bool /*complete*/) {
  flush();
  on_every_rank(layout_.comm, [&] { file_->sync(); });
}

}  // namespace pounding
