#include "output/mesh_grid.h"

#include "common/parallel.h"

namespace pounding {
namespace {

/// Components of each owned node's displacement that are held, as write_mesh() codes them.
std::vector<double> clamped_components(const Mesh& mesh) {
  std::vector<double> rows;
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    rows.push_back(0x07 & ~mesh.free_components[node]);
  }
  return rows;
}

std::vector<std::int32_t> whole(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

void add_numbers(Hdf5File& file, const std::string& folder, const std::string& name,
                 const std::vector<std::int32_t>& values, std::vector<XdmfArray>& arrays) {
  const std::string path = folder + "/" + name;
  file.write_integers(path, 0, values);
  arrays.push_back({name, path, true, {values.size()}});
}

XdmfGrid write_mesh(Hdf5File* file, const Mesh& mesh, const CellTable& cells, std::size_t structure,
                    const MeshLabels& labels) {
  const std::vector<double> coordinates = gather_coordinates(mesh);
  const std::vector<double> clamped = gather_node_rows(mesh, clamped_components(mesh), 1);
  XdmfGrid grid;
  on_rank0(mesh.comm, [&] {
    const std::string& name = mesh.structure;
    const auto nodes = static_cast<std::size_t>(mesh.global_nodes);
    grid.name = name;
    grid.cells = cells.count();
    grid.notes.emplace_back("groups", numbered(labels.groups));
    grid.geometry = {"coordinates", name + "/coordinates", false, {nodes, 3}};
    grid.topology = {"topology", name + "/topology", true, {cells.topology.size()}};
    file->write_array(grid.geometry.path, 3, coordinates);
    file->write_integers(grid.topology.path, 0, cells.topology);
    std::vector<std::int32_t> groups;
    for (const std::int32_t region : cells.region) {
      groups.push_back(static_cast<std::int32_t>(labels.first[structure]) + region + 1);
    }
    add_numbers(*file, name, "group", groups, grid.cell_values);
    add_numbers(*file, name, "element", cells.element, grid.cell_values);
    add_numbers(*file, name, "rank", cells.rank, grid.cell_values);
    add_numbers(*file, name, "clamped", whole(clamped), grid.node_values);
    for (std::size_t c = 0; c < labels.contacts.size(); ++c) {
      if (labels.contact_nodes[structure][c].empty()) continue;
      std::vector<std::int32_t> touched(nodes, 0);
      for (const GlobalIndex node : labels.contact_nodes[structure][c]) touched[node] = 1;
      add_numbers(*file, name, "contact_" + labels.contacts[c], touched, grid.node_values);
    }
  });
  return grid;
}

std::string numbered(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(i + 1) + " " + names[i];
  }
  return text;
}

void write_group_names(Hdf5File& file, const MeshLabels& labels) {
  file.write_strings("groups", labels.groups);
}

}  // namespace pounding
