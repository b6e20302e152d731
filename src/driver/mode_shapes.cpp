#include "driver/mode_shapes.h"

#include <cstdio>
#include <optional>

#include "common/parallel.h"
#include "driver/mesh_labels.h"
#include "io/hdf5_file.h"
#include "io/new_file.h"
#include "io/schema.h"
#include "mesh/node_table.h"

namespace pounding {
namespace {

/// The first three of six columns.
std::vector<double> without_rotations(const std::vector<double>& table) {
  std::vector<double> moved;
  for (std::size_t i = 0; i < table.size(); i += 6) {
    moved.insert(moved.end(), table.begin() + static_cast<std::ptrdiff_t>(i),
                 table.begin() + static_cast<std::ptrdiff_t>(i + 3));
  }
  return moved;
}

std::string frequency_note(const std::vector<double>& frequencies) {
  std::string text;
  for (const double frequency : frequencies) {
    char value[32];
    std::snprintf(value, sizeof value, "%s%.4g", text.empty() ? "" : " ", frequency);
    text += value;
  }
  return text;
}

}  // namespace

void write_mode_shapes(MPI_Comm comm, const Scene& scene, const Model& model) {
  const MeshLabels labels = mesh_labels(scene, model.interface);
  std::optional<Hdf5File> file;
  on_rank0(comm, [&] {
    file.emplace(scene.output + "/modes.h5");
    schema::write(*file, schema::modes);
    write_group_names(*file, labels);
  });
  std::string grids;
  for (std::size_t s = 0; s < model.meshes.size(); ++s) {
    const Mesh& mesh = model.meshes[s];
    XdmfGrid grid = write_mesh(file ? &*file : nullptr, mesh, gather_cells(mesh), s, labels);
    const std::size_t columns = component_columns(mesh);
    std::vector<double> frequencies;
    for (const Mode& mode : model.buildings[s].modal.modes) {
      frequencies.push_back(mode.frequency);
      char number[16];
      std::snprintf(number, sizeof number, "%04zu", frequencies.size());
      const std::string path = mesh.structure + "/shapes/" + number;
      const std::string moved = columns > 3 ? mesh.structure + "/displacements/" + number : path;
      const std::vector<double> table = gather_by_node(mesh, mode.shape, columns);
      on_rank0(comm, [&] {
        file->write_array(path, columns, table);
        if (columns > 3) file->write_array(moved, 3, without_rotations(table));
      });
      grid.node_values.push_back({std::string("mode_") + number,
                                  moved,
                                  false,
                                  {static_cast<std::size_t>(mesh.global_nodes), 3}});
    }
    on_rank0(comm, [&] {
      file->write_array(mesh.structure + "/frequencies", 0, frequencies);
      grid.notes.emplace_back("frequencies [Hz]", frequency_note(frequencies));
      grids += xdmf_grid("modes.h5", grid);
    });
  }
  on_rank0(comm, [&] {
    file->close();
    write_whole_file(scene.output + "/modes.xdmf",
                     xdmf_document(xdmf_side_by_side("modes", std::nullopt, grids)));
  });
}

}  // namespace pounding
