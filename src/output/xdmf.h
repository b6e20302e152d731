#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Text of XDMF 3 files: the meaning of the arrays of an HDF5 file beside them.
namespace pounding {

/// An array of the HDF5 file: numbers per node or cell, or vectors of three.
struct XdmfArray {
  std::string name;                ///< as ParaView shows it
  std::string path;                ///< in the file
  bool whole = false;              ///< numbers of 4 bytes without a fraction; else doubles
  std::vector<std::size_t> shape;  ///< rows, columns (none for numbers)
};

/// A mesh with values at its nodes and in its cells.
struct XdmfGrid {
  std::string name;
  XdmfArray geometry;
  XdmfArray topology;  ///< mixed
  std::size_t cells = 0;
  std::vector<XdmfArray> node_values;
  std::vector<XdmfArray> cell_values;
  std::vector<std::pair<std::string, std::string>> notes;  ///< names with their text
};

/// `file`: name of the HDF5 file, in the folder of the text.
std::string xdmf_grid(const std::string& file, const XdmfGrid& grid);

/// Grids side by side, at a time [s] if there is one.
std::string xdmf_side_by_side(const std::string& name, std::optional<double> time,
                              const std::string& grids);

/// Grids one after the other, each with its time.
std::string xdmf_in_time(const std::string& name, const std::string& grids);

/// A whole file.
std::string xdmf_document(const std::string& grids);

}  // namespace pounding
