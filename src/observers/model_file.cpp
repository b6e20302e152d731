#include "observers/model_file.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "common/facts.h"
#include "common/integer_sets.h"
#include "common/parallel.h"
#include "interactions/pairing/interface.h"
#include "io/hdf5_file.h"
#include "io/new_file.h"
#include "io/schema.h"
#include "mesh/node_table.h"

namespace pounding {
namespace {

/// Number of a name in a list from 1 on, where it is put if it is not there.
std::int32_t number_of(const std::string& name, std::vector<std::string>& names) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::int32_t>(found - names.begin()) + 1;
  names.push_back(name);
  return static_cast<std::int32_t>(names.size());
}

struct Names {
  std::vector<std::string> materials;
  std::vector<std::string> sections;
};

/// Adds the properties that regions give the cells of a structure.
void add_properties(Hdf5File& file, const Structure& structure, const CellTable& cells,
                    Names& names, XdmfGrid& grid) {
  const auto add_number = [&](const std::string& name, const auto& number) {
    std::vector<std::int32_t> values;
    for (const std::int32_t r : cells.region) values.push_back(number(structure.regions[r]));
    add_numbers(file, structure.name, name, values, grid.cell_values);
  };
  const auto add = [&](const std::string& name, const auto& row, std::size_t columns = 0) {
    std::vector<double> values;
    for (const std::int32_t r : cells.region) {
      const auto of_cell = row(structure.regions[r]);
      values.insert(values.end(), of_cell.begin(), of_cell.end());
    }
    const std::string path = structure.name + "/" + name;
    file.write_array(path, columns, values);
    XdmfArray array{name, path, false, {cells.count()}};
    if (columns > 0) array.shape.push_back(columns);
    grid.cell_values.push_back(array);
  };
  add_number("material", [&](const Region& region) {
    return has_extent(region.element) ? number_of(region.material.name, names.materials) : 0;
  });
  add_number("section", [&](const Region& region) {
    return region.section ? number_of(region.section->name, names.sections) : 0;
  });
  add("thickness", [](const Region& region) { return std::array{region.thickness}; });
  add("area", [](const Region& region) {
    return std::array{region.section ? region.section->area : region.area};
  });
  add("young", [](const Region& region) { return std::array{region.material.young}; });
  add("density", [](const Region& region) { return std::array{region.material.density}; });
  add("mass", [](const Region& region) { return std::array{region.mass}; });
  const auto add_springs = [&](const char* name, bool spread) {
    const auto stiffness = [spread](const Region& region) {
      if ((region.spread != Spread::none) != spread) return Vector3{0, 0, 0};
      return Vector3{region.stiffness[0], region.stiffness[1], region.stiffness[2]};
    };
    add(name, stiffness, 3);
  };
  add_springs("spring_stiffness", false);
  if (std::ranges::any_of(structure.regions,
                          [](const Region& region) { return region.spread != Spread::none; })) {
    add_springs("spring_stiffness_spread", true);  // per length or area
  }
}

/// Points and cells beside the structures, on rank 0.
struct Marks {
  std::vector<double> points;
  std::vector<std::int32_t> topology;
  std::vector<std::int32_t> numbers;  ///< per cell: of the contact or probe
  std::vector<double> gaps;           ///< per cell [m]

  GlobalIndex add_point(const Vector3& x) {
    points.insert(points.end(), x.begin(), x.end());
    return static_cast<GlobalIndex>(points.size() / 3) - 1;
  }
};

Vector3 position(const std::vector<double>& coordinates, GlobalIndex node) {
  const double* const x = &coordinates[3 * static_cast<std::size_t>(node)];
  return {x[0], x[1], x[2]};
}

/// The pairs of the contacts; those without a place that they face, on walls or while they are
/// open, get one on their normal, at their gap.
Marks contact_marks(const Scene& scene, const Model& model,
                    const std::vector<std::vector<double>>& coordinates) {
  Marks marks;
  for (std::size_t r = 0; r < model.interface.constraints.size(); ++r) {
    const interactions::Constraint& row = model.interface.constraints[r];
    if (row.initial_gap == interactions::open_gap) continue;
    const bool at_rest = scene.contacts[row.contact].gap_at_rest && !model.start_gaps.empty();
    const double gap = at_rest ? model.start_gaps[r] : row.of_faces(row.initial_gap);
    std::array<Vector3, 2> places{};  // of the two sides, weighted
    std::array<double, 2> weights{};
    const Vector3 normal = interactions::normal_of(row);
    for (const interactions::ConstraintTerm& term : row.terms) {
      const double weight = term.coefficient * normal[static_cast<std::size_t>(term.component)];
      const std::size_t side = weight < 0 ? 0 : 1;
      const Vector3 x = position(coordinates[static_cast<std::size_t>(term.structure)], term.node);
      weights[side] += weight;
      for (std::size_t d = 0; d < 3; ++d) places[side][d] += weight * x[d];
    }
    if (weights[0] == 0) continue;
    for (std::size_t d = 0; d < 3; ++d) {
      places[0][d] /= weights[0];
      places[1][d] = weights[1] > 0 ? places[1][d] / weights[1] : places[0][d] + gap * normal[d];
    }
    const std::array<GlobalIndex, 2> line{marks.add_point(places[0]), marks.add_point(places[1])};
    add_cell(line, false, marks.topology);
    marks.numbers.push_back(row.contact + 1);
    marks.gaps.push_back(gap);
  }
  return marks;
}

Marks probe_marks(std::span<const ResolvedProbe> probes,
                  const std::vector<std::vector<double>>& coordinates) {
  Marks marks;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    const std::vector<double>& nodes = coordinates[static_cast<std::size_t>(probes[p].structure)];
    for (const GlobalIndex node : probes[p].nodes) {
      const std::array<GlobalIndex, 1> point{marks.add_point(position(nodes, node))};
      add_cell(point, false, marks.topology);
      marks.numbers.push_back(static_cast<std::int32_t>(p) + 1);
    }
  }
  return marks;
}

XdmfGrid write_marks(Hdf5File& file, const std::string& name, const std::string& number,
                     const Marks& marks) {
  XdmfGrid grid;
  grid.name = name;
  grid.cells = marks.numbers.size();
  const std::string folder = "marks/" + name + "/";
  grid.geometry = {"points", folder + "points", false, {marks.points.size() / 3, 3}};
  grid.topology = {"topology", folder + "topology", true, {marks.topology.size()}};
  file.write_array(grid.geometry.path, 3, marks.points);
  file.write_integers(grid.topology.path, 0, marks.topology);
  add_numbers(file, "marks/" + name, number, marks.numbers, grid.cell_values);
  if (!marks.gaps.empty()) {
    grid.cell_values.push_back({"initial_gap", folder + "initial_gap", false, {grid.cells}});
    file.write_array(folder + "initial_gap", 0, marks.gaps);
  }
  return grid;
}

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
    text += sentence(text.empty() ? "{:.4g}" : " {:.4g}", {frequency});
  }
  return text;
}

}  // namespace

void write_model(MPI_Comm comm, const Scene& scene, const Model& model) {
  const MeshLabels labels = mesh_labels(scene, model.interface);
  std::optional<Hdf5File> file;
  on_rank0(comm, [&] {
    file.emplace(scene.output + "/model.h5");
    schema::write(*file, schema::model);
    write_group_names(*file, labels);
  });
  std::string grids;
  Names names;
  std::vector<std::vector<double>> coordinates;
  for (std::size_t s = 0; s < model.meshes.size(); ++s) {
    const CellTable cells = gather_cells(model.meshes[s]);
    XdmfGrid grid = write_mesh(file ? &*file : nullptr, model.meshes[s], cells, s, labels);
    coordinates.push_back(gather_coordinates(model.meshes[s]));
    on_rank0(comm, [&] {
      add_properties(*file, scene.structures[s], cells, names, grid);
      const std::vector<double>& base = model.buildings[s].absorbing.base;
      if (!base.empty()) file->write_array(grid.name + "/absorbing_base", 4, base);
      grids += xdmf_grid("model.h5", grid);
    });
  }
  on_rank0(comm, [&] {
    const std::vector<std::string> probes = names_of(model.probes);
    for (const auto& [name, list] :
         {std::pair("contacts", &labels.contacts), std::pair("probes", &probes),
          std::pair("materials", &std::as_const(names.materials)),
          std::pair("sections", &std::as_const(names.sections))}) {
      file->write_strings(name, *list);
    }
    const Marks pairs = contact_marks(scene, model, coordinates);
    const Marks points = probe_marks(model.probes, coordinates);
    for (const auto& [name, marks, list] : {std::tuple("contact", &pairs, &labels.contacts),
                                            std::tuple("probe", &points, &std::as_const(probes))}) {
      if (marks->numbers.empty()) continue;
      XdmfGrid grid = write_marks(*file, std::string(name) + "s", name, *marks);
      grid.notes.emplace_back(std::string(name) + "s", numbered(*list));
      grids += xdmf_grid("model.h5", grid);
    }
    file->close();
    write_whole_file(scene.output + "/model.xdmf",
                     xdmf_document(xdmf_side_by_side("model", std::nullopt, grids)));
    std::printf("model for ParaView: %s/model.xdmf\n", scene.output.c_str());
  });
}

OutputKind model_output() {
  return {{{"model.h5", "the meshes with groups, supports, contacts and probes", "", true},
           {"model.xdmf", "model.h5 for ParaView", "", true},
           {"modes.h5", "the shapes of the modes", "", true},
           {"modes.xdmf", "modes.h5 for ParaView", "", true}}};
}

MeshLabels mesh_labels(const Scene& scene, const interactions::Interface& interface) {
  MeshLabels labels;
  for (const Structure& structure : scene.structures) {
    labels.first.push_back(labels.groups.size());
    for (const Region& region : structure.regions) {
      labels.groups.push_back(structure.name + ":" + region.group);
    }
  }
  labels.contacts = names_of(scene.contacts);
  labels.contact_nodes.assign(scene.structures.size(),
                              std::vector<std::vector<GlobalIndex>>(scene.contacts.size()));
  for (const interactions::Constraint& row : interface.constraints) {
    for (const interactions::ConstraintTerm& term : row.terms) {
      labels.contact_nodes[term.structure][row.contact].push_back(term.node);
    }
  }
  for (auto& contacts : labels.contact_nodes) {
    for (std::vector<GlobalIndex>& nodes : contacts) keep_once(nodes);
  }
  return labels;
}

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
