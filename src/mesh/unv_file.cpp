#include "mesh/unv_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <unordered_map>
#include <unordered_set>

#include "common/error.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

/// Elements of the format that are read as cells of Gmsh's types.
struct UnvElement {
  int kind;  ///< "FE descriptor id"
  int gmsh_type;
  int dimension;
  int nodes;
  const char* name;
};

constexpr auto known_elements = std::to_array<UnvElement>({
    {11, 1, 1, 2, "Line 2"},          {21, 1, 1, 2, "Line 2"},
    {22, 1, 1, 2, "Line 2"},          {136, 1, 1, 2, "Line 2"},
    {41, 2, 2, 3, "Triangle 3"},      {51, 2, 2, 3, "Triangle 3"},
    {61, 2, 2, 3, "Triangle 3"},      {81, 2, 2, 3, "Triangle 3"},
    {91, 2, 2, 3, "Triangle 3"},      {44, 3, 2, 4, "Quadrilateral 4"},
    {54, 3, 2, 4, "Quadrilateral 4"}, {64, 3, 2, 4, "Quadrilateral 4"},
    {84, 3, 2, 4, "Quadrilateral 4"}, {94, 3, 2, 4, "Quadrilateral 4"},
    {111, 4, 3, 4, "Tetrahedron 4"},  {112, 6, 3, 6, "Prism 6"},
    {115, 5, 3, 8, "Hexahedron 8"},   {137, 15, 0, 1, "Point"},
    {161, 15, 0, 1, "Point"},
});

/// Kinds of beams and rods, which have a line more, for their orientation.
constexpr auto oriented = std::to_array<int>({11, 21, 22, 23, 24});

constexpr auto group_sets = std::to_array<int>({2435, 2452, 2467, 2477});

/// Datasets whose content would be missed, and their content.
struct UnreadSet {
  int number;
  const char* content;
};
constexpr auto unread_sets = std::to_array<UnreadSet>({{15, "nodes"},
                                                       {781, "nodes"},
                                                       {71, "elements"},
                                                       {780, "elements"},
                                                       {752, "groups"},
                                                       {2400, "groups"},
                                                       {2417, "groups"},
                                                       {2429, "groups"},
                                                       {2430, "groups"},
                                                       {2432, "groups"}});

bool has_code(const auto& list, int value) {
  return std::ranges::find(list, value) != list.end();
}

/// An element of the file, with the numbers of its cell.
struct Cell {
  int type = 0;
  int dimension = 0;
  int property = 0;
  std::vector<std::int64_t> nodes;
  std::vector<int> groups;  ///< places in the list of groups, increasing
};

struct Group {
  std::string name;
  std::vector<std::int64_t> nodes;
};

class UnvReader {
 public:
  UnvReader(const std::string& option, const std::string& file)
      : option_(option), file_(file), stream_(file) {}

  RawMesh read() {
    while (next()) {
      if (trimmed(line_) == "-1") read_dataset();
    }
    if (cells_.empty()) refuse("no elements (dataset 2412); is it a universal file?");
    if (groups_.empty()) group_by_property();
    fill_entities();
    fill_groups();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw UserError("option " + option_ + ": " + file_ + " line " + std::to_string(number_) + ": " +
                    why);
  }

  bool next() {
    ++number_;
    return static_cast<bool>(std::getline(stream_, line_));
  }

  /// The next line of a dataset; false where it ends.
  bool next_record() {
    if (!next()) refuse("the file ends within a dataset");
    return trimmed(line_) != "-1";
  }

  void require_record() {
    if (!next_record()) refuse("a dataset that ends too early");
  }

  /// The whole numbers of the line, ten columns each.
  std::vector<std::int64_t> integers() const {
    std::vector<std::int64_t> values;
    for (std::size_t i = 0; i < line_.size(); i += 10) {
      const std::string text = trimmed(std::string_view(line_).substr(i, 10));
      if (text.empty()) continue;
      std::int64_t value = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error != std::errc() || end != text.data() + text.size()) {
        refuse("'" + text + "' is no whole number of ten columns");
      }
      values.push_back(value);
    }
    return values;
  }

  std::vector<std::int64_t> integers(std::size_t least) const {
    std::vector<std::int64_t> values = integers();
    if (values.size() < least) {
      refuse("it has " + std::to_string(values.size()) + " numbers, and not " +
             std::to_string(least));
    }
    return values;
  }

  /// Real numbers of 25 columns each, whose exponent may be a D.
  std::array<double, 3> reals() const {
    std::array<double, 3> values{};
    for (std::size_t d = 0; d < 3; ++d) {
      std::string text = trimmed(line_.size() > 25 * d ? line_.substr(25 * d, 25) : "");
      std::ranges::replace(text, 'D', 'E');
      std::ranges::replace(text, 'd', 'e');
      char* end = nullptr;
      values[d] = std::strtod(text.c_str(), &end);
      if (text.empty() || *end != '\0' || !std::isfinite(values[d])) {
        refuse("'" + text + "' is no number of 25 columns");
      }
    }
    return values;
  }

  void read_dataset() {
    require_record();
    const int set = static_cast<int>(integers(1)[0]);
    const auto unread = std::ranges::find(unread_sets, set, &UnreadSet::number);
    if (unread != unread_sets.end()) {
      refuse("dataset " + std::to_string(set) + " of " + unread->content +
             " is not read; export the mesh with datasets 2411, 2412 and 2467, or as .msh");
    }
    if (set == 164) {
      read_units();
    } else if (set == 2420) {
      read_systems();
    } else if (set == 2411) {
      read_nodes();
    } else if (set == 2412) {
      read_elements();
    } else if (has_code(group_sets, set)) {
      read_groups();
    } else {
      while (next_record()) {
      }
    }
  }

  void read_units() {
    require_record();
    require_record();
    const double length = reals()[0];
    if (length != 1) {
      refuse("lengths in another unit (dataset 164 has the factor " + trimmed(line_.substr(0, 25)) +
             "); export the mesh in metres");
    }
    while (next_record()) {
    }
  }

  /// Coordinate systems are taken if they are the global one.
  void read_systems() {
    require_record();
    require_record();
    while (next_record()) {
      if (integers(2)[1] != 0) refuse("a coordinate system that is not Cartesian; export without");
      require_record();  // its name
      for (std::size_t row = 0; row < 4; ++row) {
        require_record();
        const std::array<double, 3> values = reals();
        for (std::size_t d = 0; d < 3; ++d) {
          if (values[d] != (row == d ? 1 : 0)) {
            refuse("a coordinate system that is turned or moved; export without");
          }
        }
      }
    }
  }

  void read_nodes() {
    while (next_record()) {
      const std::int64_t label = integers(1)[0];
      if (!nodes_.insert(label).second) refuse("node " + std::to_string(label) + " occurs twice");
      require_record();
      const std::array<double, 3> place = reals();
      mesh_.node_tags.push_back(label);
      mesh_.coordinates.insert(mesh_.coordinates.end(), place.begin(), place.end());
    }
  }

  void read_elements() {
    while (next_record()) {
      const std::vector<std::int64_t> head = integers(6);
      const auto kind = static_cast<int>(head[1]);
      const std::int64_t count = head[5];
      if (count < 1 || count > 100) refuse("an element of " + std::to_string(count) + " nodes");
      if (has_code(oriented, kind)) require_record();
      Cell cell;
      cell.property = static_cast<int>(head[2]);
      while (static_cast<std::int64_t>(cell.nodes.size()) < count) {
        require_record();
        for (const std::int64_t node : integers(1)) cell.nodes.push_back(node);
      }
      describe(kind, cell);
      if (!cells_.emplace(head[0], static_cast<std::int64_t>(order_.size())).second) {
        refuse("element " + std::to_string(head[0]) + " occurs twice");
      }
      for (const std::int64_t node : cell.nodes) {
        if (!nodes_.contains(node)) {
          refuse("element " + std::to_string(head[0]) + " has the node " + std::to_string(node) +
                 ", which does not come before it");
        }
      }
      labels_.push_back(head[0]);
      order_.push_back(std::move(cell));
    }
  }

  /// Type and dimension of a cell. One that no element of the program is made of keeps its number,
  /// so that messages can name it.
  void describe(int kind, Cell& cell) {
    const auto known = std::ranges::find(known_elements, kind, &UnvElement::kind);
    const auto width = static_cast<int>(cell.nodes.size());
    RawType type{1000 + kind, width, "element kind " + std::to_string(kind)};
    cell.dimension = kind > 100 ? 3 : kind > 40 ? 2 : 1;
    if (known != known_elements.end() && known->nodes == width) {
      type = {known->gmsh_type, width, known->name};
      cell.dimension = known->dimension;
    }
    cell.type = type.type;
    const auto same = std::ranges::find(mesh_.types, type.type, &RawType::type);
    if (same == mesh_.types.end()) {
      mesh_.types.push_back(std::move(type));
    } else if (same->nodes != width) {
      refuse("elements of kind " + std::to_string(kind) + " with different numbers of nodes");
    }
  }

  void read_groups() {
    while (next_record()) {
      const std::vector<std::int64_t> head = integers(8);
      require_record();
      Group group{trimmed(line_), {}};
      if (group.name.empty()) group.name = std::to_string(head[0]);
      const auto place = static_cast<int>(groups_.size());
      for (std::int64_t left = head[7]; left > 0;) {
        require_record();
        const std::vector<std::int64_t> entries = integers(4);
        for (std::size_t i = 0; i + 3 < entries.size() && left > 0; i += 4, --left) {
          add_member(entries[i], entries[i + 1], place, group);
        }
      }
      groups_.push_back(std::move(group));
    }
  }

  void add_member(std::int64_t kind, std::int64_t label, int place, Group& group) {
    if (kind == 7) {
      if (!nodes_.contains(label)) {
        refuse("group '" + group.name + "' names a node that is missing");
      }
      group.nodes.push_back(label);
    } else if (kind == 8) {
      const auto found = cells_.find(label);
      if (found == cells_.end()) {
        refuse("group '" + group.name + "' names element " + std::to_string(label) +
               ", which does not come before it");
      }
      std::vector<int>& groups = order_[static_cast<std::size_t>(found->second)].groups;
      if (groups.empty() || groups.back() != place) groups.push_back(place);
    } else {
      refuse("group '" + group.name + "' holds more than elements and nodes (type " +
             std::to_string(kind) + ")");
    }
  }

  void group_by_property() {
    std::map<int, int> places;
    for (Cell& cell : order_) {
      const auto [place, fresh] = places.emplace(cell.property, static_cast<int>(groups_.size()));
      if (fresh) groups_.push_back({std::to_string(cell.property), {}});
      cell.groups = {place->second};
    }
  }

  /// One entity for the cells of a dimension that are in the same groups.
  void fill_entities() {
    std::map<std::pair<int, std::vector<int>>, std::map<int, RawElements>> parts;
    for (std::size_t c = 0; c < order_.size(); ++c) {
      const Cell& cell = order_[c];
      RawElements& elements = parts[{cell.dimension, cell.groups}][cell.type];
      elements.type = cell.type;
      elements.tags.push_back(labels_[c]);
      elements.nodes.insert(elements.nodes.end(), cell.nodes.begin(), cell.nodes.end());
    }
    for (auto& [key, by_type] : parts) {
      RawEntity entity = fresh_entity(key.first);
      for (auto& [type, elements] : by_type) entity.elements.push_back(std::move(elements));
      for (const int group : key.second) members_[{group, key.first}].push_back(entity.tag);
      mesh_.entities.push_back(std::move(entity));
    }
  }

  RawEntity fresh_entity(int dimension) {
    RawEntity entity;
    entity.dimension = dimension;
    entity.tag = ++last_tag_;
    return entity;
  }

  /// Nodes of a group are points, with numbers beyond those of the elements.
  void fill_groups() {
    const std::int64_t beyond = *std::ranges::max_element(labels_);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const Group& group = groups_[g];
      if (group.nodes.empty()) continue;
      RawEntity entity = fresh_entity(0);
      RawElements points{15, group.nodes, group.nodes};
      for (std::int64_t& tag : points.tags) tag += beyond;
      entity.elements.push_back(std::move(points));
      members_[{static_cast<int>(g), 0}].push_back(entity.tag);
      mesh_.entities.push_back(std::move(entity));
      const bool known = std::ranges::find(mesh_.types, 15, &RawType::type) != mesh_.types.end();
      if (!known) mesh_.types.push_back({15, 1, "Point"});
    }
    for (auto& [key, entities] : members_) {
      const auto& [group, dimension] = key;
      mesh_.groups.push_back(
          {groups_[static_cast<std::size_t>(group)].name, dimension, std::move(entities)});
    }
  }

  const std::string& option_;
  const std::string& file_;
  std::ifstream stream_;
  std::string line_;
  std::int64_t number_ = 0;  ///< of the line
  RawMesh mesh_;
  std::unordered_set<std::int64_t> nodes_;
  std::unordered_map<std::int64_t, std::int64_t> cells_;  ///< label -> place
  std::vector<Cell> order_;
  std::vector<std::int64_t> labels_;
  std::vector<Group> groups_;
  std::map<std::pair<int, int>, std::vector<int>> members_;  ///< (group, dimension) -> entities
  int last_tag_ = 0;
};

}  // namespace

RawMesh read_unv(const std::string& option, const std::string& file) {
  return UnvReader(option, file).read();
}

}  // namespace pounding
