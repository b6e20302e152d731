#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/byte_stream.h"

/// Content of a mesh file, before a scene gives its groups a meaning. It crosses from the program
/// that runs Gmsh to the one that computes as a stream of bytes.
namespace pounding {

/// Elements of one Gmsh type on one entity.
struct RawElements {
  int type = 0;                     ///< Gmsh's number: 1 line, 2 triangle, 3 quadrangle, ...
  std::vector<std::int64_t> tags;   ///< as in the file
  std::vector<std::int64_t> nodes;  ///< node tags, shape (elements, nodes of the type)

  static void members(auto& self, auto& stream) { stream(self.type, self.tags, self.nodes); }
};

/// A point, curve, surface or volume of the geometry with the elements on it.
struct RawEntity {
  int dimension = 0;
  int tag = 0;
  bool bounds_another = false;  ///< an entity of the next dimension ends on it
  std::vector<RawElements> elements;

  static void members(auto& self, auto& stream) {
    stream(self.dimension, self.tag, self.bounds_another, self.elements);
  }
};

/// A physical group of one dimension; its number takes the place of a missing name.
struct RawGroup {
  std::string name;
  int dimension = 0;
  std::vector<int> entities;  ///< their tags

  static void members(auto& self, auto& stream) {
    stream(self.name, self.dimension, self.entities);
  }
};

/// A Gmsh element type that the mesh holds.
struct RawType {
  int type = 0;
  int nodes = 0;     ///< of one element
  std::string name;  ///< "Hexahedron 8"

  static void members(auto& self, auto& stream) { stream(self.type, self.nodes, self.name); }
};

/// A parameter that has another value after a geometry was read than it was given.
struct ChangedParameter {
  std::string name;
  std::string value;  ///< afterwards; empty where it is no number

  static void members(auto& self, auto& stream) { stream(self.name, self.value); }
};

struct RawMesh {
  std::vector<std::int64_t> node_tags;
  std::vector<double> coordinates;  ///< shape (nodes, 3), in the order of the tags [m]
  std::vector<RawEntity> entities;
  std::vector<RawGroup> groups;
  std::vector<RawType> types;
  std::vector<std::string> files;  ///< that Gmsh opened, absolute paths, each once, in that order
  std::vector<ChangedParameter> changed;

  static void members(auto& self, auto& stream) {
    stream(self.node_tags, self.coordinates, self.entities, self.groups, self.types, self.files,
           self.changed);
  }
};

/// The mesh, or why there is none.
struct RawAnswer {
  RawMesh mesh;
  std::string error;     ///< empty or a line of Gmsh's
  std::string denied;    ///< empty or the deed at which the file was stopped: "start a program"
  bool landlock = true;  ///< Landlock guarded the process as well

  static void members(auto& self, auto& stream) {
    stream(self.error, self.denied, self.landlock, self.mesh);
  }
};

/// Writes the answer, for the same machine to read, array by array.
void write_answer(const RawAnswer& answer, const WriteBytes& write);

/// Reads such an answer, straight into its arrays. `most`: bytes that it cannot exceed. Throws
/// std::runtime_error where it is none, and the errors of `read`.
RawAnswer read_answer(const ReadBytes& read, std::size_t most);

}  // namespace pounding
