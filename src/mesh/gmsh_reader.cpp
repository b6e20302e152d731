#include "mesh/gmsh_reader.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <unistd.h>
#include <unordered_map>

#include <gmsh.h>

#include "common/error.h"
#include "elements/element.h"
#include "mesh/element_sizes.h"

namespace pounding {
namespace {

/// The Gmsh library, open for as long as this object lives.
class GmshSession {
 public:
  GmshSession() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
  }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
  ~GmshSession() { gmsh::finalize(); }
};

/// A .geo file that sets parameters and then includes the user's. Given to Gmsh as -setnumber they
/// would stay for the whole process, and reach the next structure.
class ParameterFile {
 public:
  explicit ParameterFile(const Structure& structure) {
    std::string name = (std::filesystem::temp_directory_path() / "pounding-XXXXXX.geo").string();
    const int descriptor = mkstemps(name.data(), 4);
    path_ = name;
    std::ofstream file(path_);
    for (const auto& [parameter, value] : structure.mesh_set) {
      char* end = nullptr;
      std::strtod(value.c_str(), &end);
      const bool number = *end == '\0';
      file << parameter << " = " << (number ? value : '"' + value + '"') << ";\n";
    }
    file << "Include \"" << std::filesystem::absolute(structure.mesh).string() << "\";\n";
    file.close();
    if (descriptor < 0 || !file) {
      throw UserError("the parameters of " + structure.mesh + " cannot be written to " + path_);
    }
    close(descriptor);
  }
  ParameterFile(const ParameterFile&) = delete;
  ParameterFile& operator=(const ParameterFile&) = delete;
  ~ParameterFile() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string mesh_option(const Structure& structure) {
  return "-" + structure.name + "_mesh " + structure.mesh;
}

/// The text of a .geo file and of the files that it includes.
std::string geometry_text(const std::filesystem::path& file, int depth = 0) {
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  std::string all = text.str();
  const std::string own = all;
  const std::string keyword = "Include";
  for (std::size_t at = own.find(keyword); at != std::string::npos && depth < 8;
       at = own.find(keyword, at + 1)) {
    const std::size_t open = own.find('"', at);
    const std::size_t close = open == std::string::npos ? open : own.find('"', open + 1);
    if (close != std::string::npos) {
      all += geometry_text(file.parent_path() / own.substr(open + 1, close - open - 1), depth + 1);
    }
  }
  return all;
}

/// Gmsh takes any -setnumber in silence: refuse a parameter that the geometry never mentions.
void check_parameters(const Structure& structure) {
  const std::string text = geometry_text(structure.mesh);
  for (const auto& [name, value] : structure.mesh_set) {
    if (text.find(name) == std::string::npos) {
      throw UserError("option -" + structure.name + "_mesh_set: " + structure.mesh +
                      " has no parameter '" + name + "' (value " + value +
                      "); remove it or correct its name");
    }
  }
}

void open_model(const Structure& structure) {
  if (!std::filesystem::is_regular_file(structure.mesh)) {
    throw UserError("option " + mesh_option(structure) +
                    ": no such file; give the path of a Gmsh .geo or .msh file");
  }
  const bool geometry = std::filesystem::path(structure.mesh).extension() == ".geo";
  if (geometry) {
    check_parameters(structure);
  } else if (!structure.mesh_set.empty()) {
    throw UserError("option -" + structure.name + "_mesh_set: " + structure.mesh +
                    " is a mesh, parameters apply to .geo files only");
  }
  bool thrown = false;
  gmsh::logger::start();
  try {
    if (geometry) {
      const ParameterFile parameters(structure);
      gmsh::open(parameters.path());
      gmsh::model::mesh::generate(3);
    } else {
      gmsh::open(structure.mesh);
    }
  } catch (const UserError&) {
    throw;
  } catch (...) {
    thrown = true;
  }
  std::vector<std::string> log;
  gmsh::logger::get(log);
  gmsh::logger::stop();
  const auto error = std::find_if(
      log.begin(), log.end(), [](const std::string& line) { return line.rfind("Error", 0) == 0; });
  if (thrown || error != log.end()) {
    std::string failure = error != log.end() ? *error : "unreadable";
    std::replace(failure.begin(), failure.end(), '\n', ' ');
    throw UserError("option " + mesh_option(structure) + ": Gmsh could not read it (" + failure +
                    ")");
  }
}

struct PhysicalGroup {
  int dimension = 0;
  std::vector<int> entities;
};

/// Named physical groups; the same name in several dimensions is one group of several parts.
std::map<std::string, std::vector<PhysicalGroup>> physical_groups() {
  std::map<std::string, std::vector<PhysicalGroup>> groups;
  gmsh::vectorpair pairs;
  gmsh::model::getPhysicalGroups(pairs);
  for (const auto& [dimension, tag] : pairs) {
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    if (name.empty()) {
      name = std::to_string(tag);
    }
    PhysicalGroup group;
    group.dimension = dimension;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, group.entities);
    groups[name].push_back(group);
  }
  return groups;
}

std::string names_of(const std::map<std::string, std::vector<PhysicalGroup>>& groups) {
  std::string names;
  for (const auto& [name, parts] : groups) {
    names += (names.empty() ? "" : ", ") + name;
  }
  return names.empty() ? "none" : names;
}

std::string kind_of(int gmsh_type) {
  std::string name;
  int dimension = 0;
  int order = 0;
  int nodes = 0;
  int primary = 0;
  std::vector<double> coordinates;
  gmsh::model::mesh::getElementProperties(gmsh_type, name, dimension, order, nodes, coordinates,
                                          primary);
  return name;
}

/// The kind of element that a Gmsh type becomes in a region, or nothing if the region takes none of
/// it. Gmsh: 1 line, 2 triangle, 3 quadrangle, 5 hexahedron, 15 point.
std::optional<ElementType> kind_in_region(ElementType wanted, int gmsh_type) {
  switch (wanted) {
    case ElementType::hex8:
    case ElementType::hex8_full:
      return gmsh_type == 5 ? std::optional(wanted) : std::nullopt;
    case ElementType::shell4:
    case ElementType::shell3:
      if (gmsh_type == 2) {
        return ElementType::shell3;
      }
      return gmsh_type == 3 ? std::optional(ElementType::shell4) : std::nullopt;
    case ElementType::beam:
    case ElementType::bar:
    case ElementType::tension_bar:
    case ElementType::spring:
    case ElementType::spring6:
      return gmsh_type == 1 ? std::optional(wanted) : std::nullopt;
    case ElementType::point_mass:
    case ElementType::point_mass6:
    case ElementType::grounded_spring:
    case ElementType::grounded_spring6:
      return gmsh_type == 15 ? std::optional(wanted) : std::nullopt;
  }
  return std::nullopt;
}

/// Reads region by region; node tags are translated to the file order at the end.
class MeshBuilder {
 public:
  explicit MeshBuilder(const Structure& structure)
      : structure_(structure), groups_(physical_groups()) {}

  GlobalMesh build() {
    for (const Region& region : structure_.regions) {
      read_region(region);
    }
    number_nodes();
    for (const auto& [name, parts] : groups_) {
      read_group(name, parts);
    }
    mark_components();
    check_element_sizes(structure_.name, mesh_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void unknown_group(const std::string& group, const std::string& option) const {
    throw UserError("option " + option + ": group '" + group + "' is not in " + structure_.mesh +
                    ", which has: " + names_of(groups_));
  }

  void read_region(const Region& region) {
    const std::string option = "-" + structure_.name + "_" + region.group + "_element";
    const auto found = groups_.find(region.group);
    if (found == groups_.end()) {
      unknown_group(region.group, option);
    }
    const std::size_t before = mesh_.regions.size();
    for (const PhysicalGroup& part : found->second) {
      for (const int entity : part.entities) {
        read_entity(region, option, part.dimension, entity);
      }
    }
    if (mesh_.regions.size() == before) {
      throw UserError("option " + option + ": group '" + region.group + "' of " + structure_.mesh +
                      " holds no elements");
    }
  }

  void read_entity(const Region& region, const std::string& option, int dimension, int entity) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags;
    std::vector<std::vector<std::size_t>> nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
    for (std::size_t k = 0; k < types.size(); ++k) {
      const auto kind = kind_in_region(region.element, types[k]);
      if (!kind) {
        throw UserError("option " + option + ": group '" + region.group + "' of " +
                        structure_.mesh + " holds " + kind_of(types[k]) +
                        " elements, which do not become " + element_name(region.element));
      }
      ElementSet& set = set_of(region, *kind);
      for (const std::size_t tag : tags[k]) {
        if (!seen_.insert({tag, is_addition(*kind)}).second) {
          throw UserError("option " + option + ": element " + std::to_string(tag) + " of group '" +
                          region.group + "' already belongs to another region of " +
                          structure_.name);
        }
        set.tags.push_back(static_cast<std::int64_t>(tag));
      }
      for (const std::size_t tag : nodes[k]) {
        set.connectivity.push_back(static_cast<GlobalIndex>(tag));
      }
    }
  }

  /// Springs may share lines and points with another region (a mass on a spring).
  static bool is_addition(ElementType type) {
    return type == ElementType::grounded_spring || type == ElementType::grounded_spring6 ||
           type == ElementType::spring || type == ElementType::spring6;
  }

  /// The set of this kind in the region that is being read.
  ElementSet& set_of(const Region& region, ElementType kind) {
    const int number = static_cast<int>(&region - structure_.regions.data());
    for (ElementSet& set : mesh_.regions) {
      if (set.region == number && set.type == kind) {
        return set;
      }
    }
    ElementSet set;
    set.group = region.group;
    set.region = number;
    set.type = kind;
    mesh_.regions.push_back(std::move(set));
    return mesh_.regions.back();
  }

  /// File order of the nodes in use, and their coordinates.
  void number_nodes() {
    std::set<GlobalIndex> used;
    for (const ElementSet& set : mesh_.regions) {
      used.insert(set.connectivity.begin(), set.connectivity.end());
    }
    mesh_.node_tags.assign(used.begin(), used.end());
    index_.reserve(used.size());
    for (std::size_t i = 0; i < mesh_.node_tags.size(); ++i) {
      index_[mesh_.node_tags[i]] = static_cast<GlobalIndex>(i);
    }
    for (ElementSet& set : mesh_.regions) {
      for (GlobalIndex& node : set.connectivity) {
        node = index_.at(node);
      }
    }
    std::vector<std::size_t> tags;
    std::vector<double> coordinates;
    std::vector<double> parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters);
    mesh_.coordinates.resize(3 * mesh_.node_tags.size());
    for (std::size_t i = 0; i < tags.size(); ++i) {
      const auto found = index_.find(static_cast<std::int64_t>(tags[i]));
      if (found != index_.end()) {
        std::copy_n(&coordinates[3 * i], 3,
                    &mesh_.coordinates[static_cast<std::size_t>(3 * found->second)]);
      }
    }
  }

  void read_group(const std::string& name, const std::vector<PhysicalGroup>& parts) {
    NodeGroup& group = mesh_.groups[name];
    std::set<GlobalIndex> nodes_in_use;
    for (const PhysicalGroup& part : parts) {
      for (const int entity : part.entities) {
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> tags;
        std::vector<std::vector<std::size_t>> nodes;
        gmsh::model::mesh::getElements(types, tags, nodes, part.dimension, entity);
        for (std::size_t k = 0; k < types.size(); ++k) {
          add_elements(part.dimension, nodes[k], tags[k].size(), group, nodes_in_use);
        }
      }
    }
    group.nodes.assign(nodes_in_use.begin(), nodes_in_use.end());
  }

  void add_elements(int dimension, const std::vector<std::size_t>& nodes, std::size_t elements,
                    NodeGroup& group, std::set<GlobalIndex>& nodes_in_use) const {
    const std::size_t width = elements == 0 ? 0 : nodes.size() / elements;
    for (std::size_t e = 0; e < elements; ++e) {
      Facet facet;
      bool whole = (dimension == 1 || dimension == 2) && width <= 4;
      for (std::size_t a = 0; a < width; ++a) {
        const auto found = index_.find(static_cast<std::int64_t>(nodes[e * width + a]));
        if (found == index_.end()) {
          whole = false;
          continue;
        }
        nodes_in_use.insert(found->second);
        if (a < 4) {
          facet.nodes[a] = found->second;
        }
      }
      if (whole) {
        facet.count = static_cast<int>(width);
        group.facets.push_back(facet);
      }
    }
  }

  void mark_components() {
    mesh_.components.assign(mesh_.node_tags.size(), 0);
    for (const ElementSet& set : mesh_.regions) {
      const std::uint8_t mask = element_layout(set.type).components == 6 ? 0x3f : 0x07;
      for (const GlobalIndex node : set.connectivity) {
        mesh_.components[static_cast<std::size_t>(node)] |= mask;
      }
    }
    mesh_.free_components = mesh_.components;
    for (const Clamp& clamp : structure_.clamps) {
      const std::string& name = clamp.group;
      const auto found = mesh_.groups.find(name);
      const std::string option = "-" + structure_.name + "_clamp";
      if (found == mesh_.groups.end()) {
        unknown_group(name, option);
      }
      if (found->second.nodes.empty()) {
        throw UserError("option " + option + ": no element of the scene uses a node of group '" +
                        name + "'");
      }
      for (const GlobalIndex node : found->second.nodes) {
        mesh_.free_components[static_cast<std::size_t>(node)] &=
            static_cast<std::uint8_t>(~clamp.components);
      }
    }
  }

  const Structure& structure_;
  std::map<std::string, std::vector<PhysicalGroup>> groups_;
  GlobalMesh mesh_;
  std::unordered_map<std::int64_t, GlobalIndex> index_;
  std::set<std::pair<std::size_t, bool>> seen_;
};

}  // namespace

GlobalMesh read_mesh(const Structure& structure) {
  const GmshSession session;
  open_model(structure);
  return MeshBuilder(structure).build();
}

}  // namespace pounding
