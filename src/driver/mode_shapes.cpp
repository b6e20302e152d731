#include "driver/mode_shapes.h"

#include <cstdio>
#include <optional>

#include "common/parallel.h"
#include "io/hdf5_file.h"
#include "mesh/node_table.h"

namespace pounding {

void write_mode_shapes(MPI_Comm comm, const std::string& path, const Model& model) {
  std::optional<Hdf5File> file;
  on_rank0(comm, [&] { file.emplace(path); });
  for (std::size_t s = 0; s < model.meshes.size(); ++s) {
    const Mesh& mesh = model.meshes[s];
    const auto write = [&](const std::string& name, std::size_t columns,
                           const std::vector<double>& table) {
      on_rank0(comm, [&] { file->write_array(mesh.structure + "/" + name, columns, table); });
    };
    write("coordinates", 3, gather_coordinates(mesh));
    const std::size_t columns = component_columns(mesh);
    std::vector<double> frequencies;
    for (const Mode& mode : model.buildings[s].modal.modes) {
      frequencies.push_back(mode.frequency);
      char name[32];
      std::snprintf(name, sizeof name, "shapes/%04zu", frequencies.size());
      write(name, columns, gather_by_node(mesh, mode.shape, columns));
    }
    write("frequencies", 0, frequencies);
  }
  on_rank0(comm, [&] { file->close(); });
}

}  // namespace pounding
