#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "mesh/divide_beams.h"
#include "mesh/global_mesh.h"
#include "mesh/kept_inputs.h"
#include "scene/scene.h"

namespace pounding {

/// Files of which a mesh was made.
struct MeshFiles {
  /// Opened by Gmsh beside the one that the option names, each once, in that order; paths from the
  /// working folder where they lie in it, else absolute ones.
  std::vector<std::string> opened;
  bool landlock = true;  ///< Landlock guarded Gmsh as well as seccomp
};

/// Mesh that was read, and its files.
struct MeshRead {
  GlobalMesh mesh;
  MeshFiles files;
  std::vector<DividedLines> divided;
};

/// Meshes of structures, read one after the other by means of Gmsh, in a process of its own for
/// each: while one mesh is taken, Gmsh is at work on the next. To be used on one rank only.
class MeshReader {
 public:
  /// `structures` in the order in which they are asked for, alive while this object is used;
  /// `time_limit`: of Gmsh for each [s]; `splits`: how often every element is split (split_mesh.h),
  /// but for structures of matrices, which are for the nodes of their file; `kept`, or null: meshes
  /// that are not read again, to which these come.
  MeshReader(std::vector<const Structure*> structures, double time_limit, int splits,
             std::shared_ptr<KeptInputs> kept);
  MeshReader(const MeshReader&) = delete;
  MeshReader& operator=(const MeshReader&) = delete;
  ~MeshReader();

  /// The mesh of the next structure: a .geo file is meshed with the parameters of `mesh_set`,
  /// anything else is opened as a mesh. Keeps the groups of the scene's regions as elements and
  /// every named group as nodes and facets; marks rotations and clamped nodes. Throws UserError
  /// (missing file, unknown group, wrong element kind, element in two regions, no elements).
  MeshRead next();

 private:
  class Reading;
  std::unique_ptr<Reading> begin(std::size_t s) const;

  std::vector<const Structure*> structures_;
  double time_limit_;
  int splits_;
  std::shared_ptr<KeptInputs> kept_;
  std::size_t taken_ = 0;
  std::unique_ptr<Reading> ahead_;  ///< of the structure that is taken next
};

}  // namespace pounding
