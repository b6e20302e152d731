#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "io/hdf5_file.h"
#include "mesh/node_table.h"
#include "output/xdmf.h"

/// VTKHDF files of version 2.0, an unstructured grid over time: VTK's own HDF5 format, which
/// ParaView reads rank by rank. Those made here are lists: their arrays are virtual datasets over
/// the arrays of another HDF5 file, so that no number is in two files.
namespace pounding {

/// A vector at the nodes, or a number of the cells, that changes from step to step.
struct VtkhdfArray {
  std::string name;
  std::string unit;
  double time_offset = 0;  ///< of its values after the time of the step [s]
  /// Per grid, the datasets of shape (nodes, 3) or (cells), one per step; empty where it is 0 all
  /// the time.
  std::vector<std::vector<std::string>> paths;
  bool of_cells = false;
};

/// Adds the cells of a grid to a file as VTK codes them: GRID/connectivity (nodes in file order,
/// cell after cell), GRID/offsets (cells + 1) and GRID/types. Returns the length of connectivity.
/// Rank 0.
std::size_t write_vtk_cells(Hdf5File& file, const std::string& grid, const CellTable& cells);

/// Writes a whole VTKHDF file over the file `source` in the same folder, under another name first,
/// so that there is the old one, or none, until the new one is complete. Every grid is a part of
/// each step, with the cells of write_vtk_cells(); numbers of nodes that a grid lacks are 0 there,
/// and every grid has the numbers of cells of the first. `cell_nodes`: lengths of connectivity.
/// `times`: of the steps [s]. Throws UserError (no space). Rank 0.
void write_vtkhdf(const std::string& path, const std::string& source,
                  std::span<const XdmfGrid> grids, std::span<const std::size_t> cell_nodes,
                  std::span<const VtkhdfArray> arrays, const std::vector<double>& times);

}  // namespace pounding
