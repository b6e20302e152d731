#include "output/vtkhdf.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

namespace pounding {
namespace {

/// A code of XDMF's mixed topology, the nodes of such a cell, and VTK's type.
struct VtkCell {
  std::int32_t code;
  std::size_t nodes;
  std::uint8_t type;
};

/// Vertex, line, triangle, quadrangle, tetrahedron, wedge, hexahedron.
constexpr VtkCell vtk_cells[] = {{1, 1, 1},  {2, 2, 3},  {4, 3, 5}, {5, 4, 9},
                                 {6, 4, 10}, {8, 6, 13}, {9, 8, 12}};

/// Names the datasets that are parts of one, and counts its rows.
class StackedRows {
 public:
  void add(const std::string& dataset, std::size_t count) {
    parts_.push_back({dataset, rows_, count});
    rows_ += count;
  }
  void skip(std::size_t count) { rows_ += count; }

  void write(Hdf5File& file, const std::string& name, hid_t type, std::size_t columns,
             const std::string& source) const {
    file.write_virtual(name, type, rows_, columns, source, parts_);
  }

 private:
  std::vector<VirtualRows> parts_;
  std::size_t rows_ = 0;
};

std::size_t nodes_of(const XdmfGrid& grid) {
  return grid.geometry.shape[0];
}

/// Writes one file.
class VtkhdfWriter {
 public:
  VtkhdfWriter(Hdf5File& file, const std::string& source, std::span<const XdmfGrid> grids,
               std::span<const std::size_t> cell_nodes)
      : file_(file), source_(source), grids_(grids), cell_nodes_(cell_nodes) {}

  void write_grids() {
    std::vector<std::int64_t> points, cells, ids;
    StackedRows coordinates, connectivity, offsets, types;
    for (std::size_t g = 0; g < grids_.size(); ++g) {
      const XdmfGrid& grid = grids_[g];
      points.push_back(static_cast<std::int64_t>(nodes_of(grid)));
      cells.push_back(static_cast<std::int64_t>(grid.cells));
      ids.push_back(static_cast<std::int64_t>(cell_nodes_[g]));
      coordinates.add(grid.geometry.path, nodes_of(grid));
      connectivity.add(grid.name + "/connectivity", cell_nodes_[g]);
      offsets.add(grid.name + "/offsets", grid.cells + 1);
      types.add(grid.name + "/types", grid.cells);
      nodes_ += nodes_of(grid);
      cells_ += grid.cells;
    }
    file_.write_long_integers("VTKHDF/NumberOfPoints", points);
    file_.write_long_integers("VTKHDF/NumberOfCells", cells);
    file_.write_long_integers("VTKHDF/NumberOfConnectivityIds", ids);
    coordinates.write(file_, "VTKHDF/Points", H5T_NATIVE_DOUBLE, 3, source_);
    connectivity.write(file_, "VTKHDF/Connectivity", H5T_NATIVE_INT32, 0, source_);
    offsets.write(file_, "VTKHDF/Offsets", H5T_NATIVE_INT32, 0, source_);
    types.write(file_, "VTKHDF/Types", H5T_NATIVE_UINT8, 0, source_);
  }

  /// Numbers that stay: those of cells, which every grid has, and those of nodes, which only the
  /// grids have that a contact touches.
  void write_numbers() {
    for (const XdmfArray& array : grids_[0].cell_values) {
      StackedRows rows;
      for (const XdmfGrid& grid : grids_) rows.add(grid.name + "/" + array.name, grid.cells);
      rows.write(file_, "VTKHDF/CellData/" + array.name, H5T_NATIVE_INT32, 0, source_);
      cell_numbers_.push_back(array.name);
    }
    for (const XdmfGrid& owner : grids_) {
      for (const XdmfArray& array : owner.node_values) {
        if (std::ranges::find(node_numbers_, array.name) != node_numbers_.end()) continue;
        node_numbers_.push_back(array.name);
        StackedRows rows;
        for (const XdmfGrid& grid : grids_) {
          const auto own = std::ranges::find(grid.node_values, array.name, &XdmfArray::name);
          if (own == grid.node_values.end()) {
            rows.skip(nodes_of(grid));
          } else {
            rows.add(own->path, nodes_of(grid));
          }
        }
        rows.write(file_, "VTKHDF/PointData/" + array.name, H5T_NATIVE_INT32, 0, source_);
      }
    }
  }

  void write_array(const VtkhdfArray& array, std::size_t steps) {
    StackedRows rows;
    for (std::size_t step = 0; step < steps; ++step) {
      for (std::size_t g = 0; g < grids_.size(); ++g) {
        const std::size_t count = array.of_cells ? grids_[g].cells : nodes_of(grids_[g]);
        if (array.paths[g].empty()) {
          rows.skip(count);
        } else {
          rows.add(array.paths[g][step], count);
        }
      }
    }
    const std::string name =
        (array.of_cells ? "VTKHDF/CellData/" : "VTKHDF/PointData/") + array.name;
    rows.write(file_, name, H5T_NATIVE_DOUBLE, array.of_cells ? 0 : 3, source_);
    file_.write_attribute(name, "unit", array.unit);
    if (array.time_offset != 0) file_.write_attribute(name, "time_offset", array.time_offset);
  }

  /// Where the values of each step begin: the mesh does not change.
  void write_steps(std::span<const VtkhdfArray> arrays, const std::vector<double>& times) {
    const std::vector<std::int64_t> first(times.size(), 0);
    const std::vector<std::int64_t> parts(times.size(), static_cast<std::int64_t>(grids_.size()));
    std::vector<std::int64_t> at_nodes, of_cells;
    for (std::size_t step = 0; step < times.size(); ++step) {
      at_nodes.push_back(static_cast<std::int64_t>(step * nodes_));
      of_cells.push_back(static_cast<std::int64_t>(step * cells_));
    }
    const std::string steps = "VTKHDF/Steps/";
    file_.write_array(steps + "Values", 0, times);
    file_.write_long_integers(steps + "NumberOfParts", parts);
    for (const char* name :
         {"PartOffsets", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"}) {
      file_.write_long_integers(steps + name, first);
    }
    for (const std::string& name : cell_numbers_) {
      file_.write_long_integers(steps + "CellDataOffsets/" + name, first);
    }
    for (const std::string& name : node_numbers_) {
      file_.write_long_integers(steps + "PointDataOffsets/" + name, first);
    }
    for (const VtkhdfArray& array : arrays) {
      file_.write_long_integers(
          steps + (array.of_cells ? "CellDataOffsets/" : "PointDataOffsets/") + array.name,
          array.of_cells ? of_cells : at_nodes);
    }
    file_.write_attribute("VTKHDF/Steps", "NSteps",
                          std::vector{static_cast<std::int64_t>(times.size())});
  }

 private:
  Hdf5File& file_;
  const std::string& source_;
  std::span<const XdmfGrid> grids_;
  std::span<const std::size_t> cell_nodes_;
  std::size_t nodes_ = 0;  ///< of all grids
  std::size_t cells_ = 0;  ///< of all grids
  std::vector<std::string> cell_numbers_;
  std::vector<std::string> node_numbers_;
};

}  // namespace

std::size_t write_vtk_cells(Hdf5File& file, const std::string& grid, const CellTable& cells) {
  std::vector<std::int32_t> connectivity;
  std::vector<std::int32_t> offsets{0};
  std::vector<std::uint8_t> types;
  auto next = cells.topology.begin();
  while (next != cells.topology.end()) {
    const auto cell = std::ranges::find(vtk_cells, *next, &VtkCell::code);
    if (cell == std::end(vtk_cells)) {
      throw std::logic_error("no cell of VTK has XDMF's code " + std::to_string(*next));
    }
    next += cell->nodes < 3 ? 2 : 1;  // of points and lines the number of nodes follows
    connectivity.insert(connectivity.end(), next, next + static_cast<std::ptrdiff_t>(cell->nodes));
    next += static_cast<std::ptrdiff_t>(cell->nodes);
    offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
    types.push_back(cell->type);
  }
  file.write_integers(grid + "/connectivity", 0, connectivity);
  file.write_integers(grid + "/offsets", 0, offsets);
  file.write_bytes(grid + "/types", types);
  return connectivity.size();
}

void write_vtkhdf(const std::string& path, const std::string& source,
                  std::span<const XdmfGrid> grids, std::span<const std::size_t> cell_nodes,
                  std::span<const VtkhdfArray> arrays, const std::vector<double>& times) {
  Hdf5File file(path + ".new");
  VtkhdfWriter writer(file, source, grids, cell_nodes);
  writer.write_grids();
  writer.write_numbers();
  for (const VtkhdfArray& array : arrays) writer.write_array(array, times.size());
  writer.write_steps(arrays, times);
  file.write_attribute("VTKHDF", "Version", std::vector<std::int64_t>{2, 0});
  file.write_attribute("VTKHDF", "Type", "UnstructuredGrid");
  file.close();
  file.move_to(path);
}

}  // namespace pounding
