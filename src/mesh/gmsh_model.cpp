#include "mesh/gmsh_model.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <sys/mman.h>
#include <unistd.h>

#include <gmsh.h>

#include "mesh/interposed_calls.h"

namespace pounding {
namespace {

/// Opens the Gmsh library, for good: closed, it would remove files of its own.
void start_gmsh(std::span<char*> arguments) {
  gmsh::initialize(static_cast<int>(arguments.size()), arguments.data(), false);
  gmsh::option::setNumber("General.Terminal", 1);  // errors are read there if it crashes
  gmsh::option::setNumber("General.NumThreads", 1);
  gmsh::logger::start();
}

std::vector<std::string> logged(std::string_view head) {
  std::vector<std::string> log;
  gmsh::logger::get(log);
  std::erase_if(log, [&](const std::string& line) { return !line.starts_with(head); });
  return log;
}

/// The first error that Gmsh logged and the last, "" for none.
std::string logged_error() {
  const std::vector<std::string> errors = logged("Error");
  if (errors.empty()) return "";
  return errors.front() + (errors.size() > 1 ? " ... " + errors.back() : "");
}

/// Lets Gmsh run a text of its language. False if it finds an error there.
bool run_text(const std::string& text) {
  const int file = memfd_create("text", 0);
  const bool written = write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  bool run = written;
  try {
    if (written) gmsh::merge("/proc/self/fd/" + std::to_string(file));
  } catch (...) {
    run = false;
  }
  close(file);
  return run;
}

/// Whether a parameter still has the value that it was given as a number or a word.
bool keeps_value(std::string_view kind, const std::string& name, const std::string& value,
                 ChangedParameter& now) {
  constexpr std::string_view head = "Direct: value of a parameter ";
  const bool number = kind == "-setnumber";
  const std::string shown = number ? name : "StrCmp(" + name + ", \"" + value + "\")";
  const bool run = run_text("Printf(\"value of a parameter %.17g\", " + shown + ");\n");
  now.name = name;
  const std::vector<std::string> lines = logged(head);
  if (!run || lines.empty()) return false;
  const std::string text = lines.back().substr(head.size());
  if (!number) return std::strtod(text.c_str(), nullptr) == 0;
  const double found = std::strtod(text.c_str(), nullptr);
  std::array<char, 32> brief{};
  std::snprintf(brief.data(), brief.size(), "%.9g", found);
  now.value = brief.data();
  return found == std::strtod(value.c_str(), nullptr);
}

/// Parameters that the geometry gave a value of its own.
std::vector<ChangedParameter> changed_parameters(std::span<char* const> arguments) {
  std::vector<ChangedParameter> changed;
  for (std::size_t i = 1; i + 2 < arguments.size(); i += 3) {
    ChangedParameter now;
    if (!keeps_value(arguments[i], arguments[i + 1], arguments[i + 2], now)) {
      changed.push_back(std::move(now));
    }
  }
  return changed;
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

/// Formats without named groups have their elements by a number: of its property (Nastran) or its
/// reference (Medit), which Gmsh makes that of an entity. Each is a group.
std::vector<RawGroup> groups_by_number(const std::vector<RawEntity>& entities) {
  std::vector<RawGroup> groups;
  for (const RawEntity& entity : entities) {
    if (entity.elements.empty()) continue;
    groups.push_back({std::to_string(entity.tag), entity.dimension, {entity.tag}});
  }
  return groups;
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

RawAnswer gmsh_mesh(const MeshTask& task, Denied denied) {
  start_gmsh(task.arguments);
  RawAnswer answer;
  const Guard guard = guard_process(denied);
  if (guard == Guard::none) {
    answer.error = "this system lets no process be guarded by seccomp, and none runs without";
    return answer;
  }
  answer.landlock = guard == Guard::seccomp_and_landlock;
  note_opened_files();
  try {
    gmsh::open(task.file);
    if (task.make) gmsh::model::mesh::generate(3);
    answer.error = logged_error();
    if (answer.error.empty()) answer.mesh = take_mesh();
    const bool named = task.make || task.file.ends_with(".msh");
    if (!named && answer.mesh.groups.empty()) {
      answer.mesh.groups = groups_by_number(answer.mesh.entities);
    }
  } catch (...) {
    answer.error = logged_error();
    if (answer.error.empty()) answer.error = "unreadable";
  }
  answer.mesh.files = opened_files();
  if (answer.error.empty()) answer.mesh.changed = changed_parameters(task.arguments);
  return answer;
}

}  // namespace pounding
