#include "observers/field_writer.h"

#include <cstdio>
#include <filesystem>

#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "io/schema.h"
#include "mesh/node_table.h"
#include "observers/model_file.h"
#include "observers/yield_table.h"
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

bool has_value(std::span<const double> values) {
  return std::ranges::any_of(values, [](double value) { return value != 0; });
}

}  // namespace

FieldWriter::FieldWriter(const ObservedRun& run)
    : run_(run),
      steps_(planned_fields(run.scene, run.model).value()),
      continued_(run.continued_path(file_name)),
      xdmf_(run.scene.fields_format != FieldsFormat::vtkhdf),
      vtkhdf_(run.scene.fields_format != FieldsFormat::xdmf),
      labels_(mesh_labels(run.scene, run.model.interface)),
      yields_(yielding_structures(run.scene)) {
  if (run.contact_root() >= 0) impulses_.assign(run.scheme.contact()->dof_list().size(), 0.0);
  structures_.reserve(run.model.meshes.size());
  for (std::size_t s = 0; s < run.model.meshes.size(); ++s) structures_.push_back(fields_of(s));
  const double bytes = fields_size(run.scene, run.model, steps_);
  on_rank0(run_.comm, [&] {
    std::error_code failure;
    const auto space = std::filesystem::space(run.scene.output, failure);
    if (failure || static_cast<double>(space.available) >= bytes) return;
    throw UserError(sentence(
        "option -fields_interval: {} frames take up to {:.3g} GB, and {} has {:.3g} GB "
        "left; give a longer interval, or -fields_start and -fields_end",
        {steps_.count, bytes / 1e9, run.scene.output, static_cast<double>(space.available) / 1e9}));
  });
  if (!continued_.empty()) return;
  create(run_.path(file_name));
  open();
}

FieldWriter::StructureFields FieldWriter::fields_of(std::size_t structure) {
  const LinearSystem& system = run_.model.systems[structure];
  const Mesh& mesh = run_.model.meshes[structure];
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
  if (!impulses_.empty()) add("contact_impulse", "N s");
  if (yields_[structure] != 0) {
    for (const auto& [name, unit] :
         {std::pair{"ductility", "-"}, {"damage", "-"}, {"lost_energy", "J"}}) {
      fields.quantities.push_back({name, unit, {}, {}, true});
    }
  }
  for (std::size_t i = 0; i < impulses_.size(); ++i) {
    const interactions::InterfaceDof& dof = run_.scheme.contact()->dof_list()[i];
    if (dof.structure != static_cast<int>(structure)) continue;
    const LocalIndex node = mesh.owned_node(dof.node);
    if (node < 0) continue;
    fields.contact.push_back(
        {3 * static_cast<std::size_t>(node) + static_cast<std::size_t>(dof.component), i});
  }
  return fields;
}

double FieldWriter::time_of(std::int64_t frame) const {
  return static_cast<double>(steps_.first + frame * steps_.stride) * run_.model.time_step;
}

void FieldWriter::create(const std::string& path) {
  std::optional<Hdf5File> file;
  on_rank0(run_.comm, [&] {
    file.emplace(path);
    schema::write(*file, schema::fields);
    file->write_attribute("/", "title", run_.scene.title);
    file->write_attribute("/", "time_step", run_.model.time_step);
    file->write_attribute("/", "first_step", static_cast<double>(steps_.first));
    file->write_attribute("/", "stride", static_cast<double>(steps_.stride));
    write_group_names(*file, labels_);
    std::vector<double> times;
    for (std::int64_t f = 0; f < steps_.count; ++f) times.push_back(time_of(f));
    file->write_array("time", 0, times);
    file->write_attribute("time", "unit", "s");
    frames_offset_ = file->reserve("frames", {1});
  });
  grids_.clear();
  cell_nodes_.clear();
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    const CellTable cells = gather_cells(run_.model.meshes[s]);
    grids_.push_back(write_mesh(file ? &*file : nullptr, run_.model.meshes[s], cells, s, labels_));
    for (std::size_t cell = 0; yields_[s] != 0 && cell < cells.count(); ++cell) {
      structures_[s].cell_places[{cells.region[cell], cells.element[cell]}] = cell;
    }
    if (!vtkhdf_) continue;
    on_rank0(run_.comm,
             [&] { cell_nodes_.push_back(write_vtk_cells(*file, structures_[s].name, cells)); });
  }
  std::vector<std::int64_t> offsets;
  on_rank0(run_.comm, [&] {
    offsets = reserve(*file);
    file->close();
  });
  broadcast_array(run_.comm, offsets);
  auto next = offsets.begin();
  for (StructureFields& fields : structures_) {
    for (Quantity& quantity : fields.quantities) {
      quantity.offsets.assign(next, next + steps_.count);
      next += steps_.count;
    }
  }
}

std::vector<std::int64_t> FieldWriter::reserve(Hdf5File& file) const {
  std::vector<std::int64_t> taken;
  for (const StructureFields& fields : structures_) {
    for (const Quantity& quantity : fields.quantities) {
      for (std::int64_t frame = 0; frame < steps_.count; ++frame) {
        taken.push_back(file.reserve(path_of(fields, quantity, frame), fields.shape_of(quantity)));
      }
      const std::string group = fields.name + "/" + quantity.name;
      file.write_attribute(group, "unit", quantity.unit);
      if (quantity.name == "velocity") {
        file.write_attribute(group, "time_offset", run_.model.time_step / 2);
      }
    }
  }
  return taken;
}

std::string FieldWriter::path_of(const StructureFields& fields, const Quantity& quantity,
                                 std::int64_t frame) {
  char number[24];
  std::snprintf(number, sizeof number, "/%06lld", static_cast<long long>(frame));
  return fields.name + "/" + quantity.name + number;
}

void FieldWriter::open() {
  on_every_rank(run_.comm, [&] {
    file_ = std::make_unique<OffsetFile>(run_.path(file_name), OffsetFile::Access::write);
  });
}

std::int64_t FieldWriter::next_due(std::int64_t step) const {
  const FieldSteps& steps = steps_;
  if (step > steps.last()) return never;
  return step <= steps.first ? steps.first
                             : steps.first + next_multiple(step - steps.first, steps.stride);
}

StepNeeds FieldWriter::begin(const CdLagrange& stepper) {
  const State& state = stepper.state();
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    StructureFields& fields = structures_[s];
    const std::vector<double>& moved = state.structures[s].displacement;
    stepper.bring(s, fields.displacement.dofs());
    if (fields.rotation) stepper.bring(s, fields.rotation->dofs());
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
  const FieldSteps& steps = steps_;
  const bool counts = step > steps.first - steps.stride && step <= steps.last();
  if (counts && run_.scheme.touching()) run_.scheme.contact()->add_dof_impulses(impulses_);
}

void FieldWriter::observe(const CdLagrange& stepper) {
  const State& state = stepper.state();
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    StructureFields& fields = structures_[s];
    stepper.bring(s, fields.displacement.dofs());
    fields.displacement.apply(state.structures[s].velocity.data(),
                              fields.quantities[1].owned.data(), 1, state.supports.velocity);
    const auto impulse = std::ranges::find(fields.quantities, "contact_impulse", &Quantity::name);
    for (const auto& [value, place] : fields.contact) impulse->owned[value] = impulses_[place];
    if (yields_[s] != 0) write_cells(s);
    for (Quantity& quantity : fields.quantities) {
      if (quantity.of_cells) continue;
      fields.blocks.to_file(quantity.owned, 3, fields.block);
      on_every_rank(run_.comm, [&] {  // places without a value are 0
        if (!has_value(fields.block)) return;
        constexpr std::int64_t bytes = 3 * sizeof(double);
        const std::int64_t offset = quantity.offsets[static_cast<std::size_t>(frames_)];
        file_->write(offset + bytes * fields.blocks.first(), fields.block);
      });
    }
  }
  std::ranges::fill(impulses_, 0.0);
  on_rank0(run_.comm, [&] {
    const double frames = static_cast<double>(frames_ + 1);
    file_->write(frames_offset_, {&frames, 1});
    if (xdmf_) text_ += frame_text(frames_);
  });
  ++frames_;
}

void FieldWriter::write_cells(std::size_t structure) {
  constexpr std::size_t width = 5;
  const std::vector<double> rows = gather_rows(run_.comm, yielding_elements(run_, structure));
  on_rank0(run_.comm, [&] {
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
      file_->write(quantity.offsets[static_cast<std::size_t>(frames_)], values);
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
        const double offset = quantity.name == "velocity" ? run_.model.time_step / 2 : 0;
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
  write_vtkhdf(run_.path("fields.vtkhdf"), file_name, grids_, cell_nodes_, arrays, times);
}

void FieldWriter::flush() {
  on_rank0(run_.comm, [&] {
    if (frames_ == 0) return;
    if (vtkhdf_) list_for_vtk();
    if (!xdmf_) return;
    write_whole_file(run_.path("fields.xdmf"), xdmf_document(xdmf_in_time("fields", text_)));
  });
}

void FieldWriter::finish(bool /*complete*/) {
  flush();
  on_every_rank(run_.comm, [&] { file_->sync(); });
}

OutputKind fields_output() {
  return output<FieldWriter>(
      {{file_name, "the motion of all nodes at the frames", "", true},
       {"fields.xdmf", "the frames of fields.h5 for ParaView", "", true},
       {"fields.vtkhdf", "the frames of fields.h5 for ParaView 5.12 and later", "", true}},
      [](const ObservedRun& run) { return run.scene.fields_interval > 0; });
}

}  // namespace pounding
