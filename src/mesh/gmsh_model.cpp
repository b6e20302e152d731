#include "mesh/gmsh_model.h"

#include <algorithm>
#include <set>

#include <gmsh.h>

namespace pounding {
namespace {

/// The Gmsh library, open for as long as this object lives.
class GmshSession {
 public:
  GmshSession() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::logger::start();
  }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
  ~GmshSession() { gmsh::finalize(); }
};

/// The first error that Gmsh logged, "" for none.
std::string logged_error() {
  std::vector<std::string> log;
  gmsh::logger::get(log);
  const auto error =
      std::ranges::find_if(log, [](const std::string& line) { return line.starts_with("Error"); });
  return error == log.end() ? "" : *error;
}

std::vector<std::int64_t> signed_tags(const std::vector<std::size_t>& tags) {
  return {tags.begin(), tags.end()};
}

RawEntity take_entity(int dimension, int tag) {
  RawEntity entity;
  entity.dimension = dimension;
  entity.tag = tag;
  std::vector<int> upward;
  std::vector<int> downward;
  gmsh::model::getAdjacencies(dimension, tag, upward, downward);
  entity.bounds_another = !upward.empty();
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags;
  std::vector<std::vector<std::size_t>> nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension, tag);
  for (std::size_t k = 0; k < types.size(); ++k) {
    entity.elements.push_back({types[k], signed_tags(tags[k]), signed_tags(nodes[k])});
  }
  return entity;
}

RawType describe_type(int type) {
  RawType description;
  description.type = type;
  int dimension = 0;
  int order = 0;
  int primary = 0;
  std::vector<double> coordinates;
  gmsh::model::mesh::getElementProperties(type, description.name, dimension, order,
                                          description.nodes, coordinates, primary);
  return description;
}

RawMesh take_mesh() {
  RawMesh mesh;
  std::vector<std::size_t> tags;
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(tags, mesh.coordinates, parameters);
  mesh.node_tags = signed_tags(tags);
  gmsh::vectorpair pairs;
  gmsh::model::getEntities(pairs);
  std::set<int> types;
  for (const auto& [dimension, tag] : pairs) {
    mesh.entities.push_back(take_entity(dimension, tag));
    for (const RawElements& elements : mesh.entities.back().elements) types.insert(elements.type);
  }
  for (const int type : types) mesh.types.push_back(describe_type(type));
  gmsh::model::getPhysicalGroups(pairs);
  for (const auto& [dimension, tag] : pairs) {
    RawGroup group;
    group.dimension = dimension;
    gmsh::model::getPhysicalName(dimension, tag, group.name);
    if (group.name.empty()) group.name = std::to_string(tag);
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, group.entities);
    mesh.groups.push_back(std::move(group));
  }
  return mesh;
}

}  // namespace

RawAnswer gmsh_mesh(const std::string& file, bool make) {
  const GmshSession session;
  RawAnswer answer;
  try {
    gmsh::open(file);
    if (make) gmsh::model::mesh::generate(3);
    answer.error = logged_error();
    if (answer.error.empty()) answer.mesh = take_mesh();
  } catch (...) {
    answer.error = logged_error();
    if (answer.error.empty()) answer.error = "unreadable";
  }
  return answer;
}

}  // namespace pounding
