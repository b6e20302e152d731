#include "mesh/start_states.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <utility>

#include "common/error.h"
#include "common/matrix3.h"
#include "elements/element_traits.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

/// Part of the mesh within which a place of the file is that of a node.
constexpr double node_margin = 1e-6;

constexpr std::array<std::string_view, 4> place_names{"node", "x", "y", "z"};
constexpr std::array<std::string_view, 12> value_names{"ux", "uy", "uz", "rx", "ry", "rz",
                                                       "vx", "vy", "vz", "wx", "wy", "wz"};

using Values = std::map<std::pair<GlobalIndex, int>, double>;

/// Start of one structure.
class StartMaker {
 public:
  StartMaker(const Structure& structure, const GlobalMesh& mesh)
      : structure_(structure), mesh_(mesh) {}

  NodalStart make() {
    take_groups(&Region::initial_displacement, "_initial_displacement", displacement_);
    take_groups(&Region::initial_velocity, "_initial_velocity", velocity_);
    if (!structure_.initial_state.empty()) read_file();
    return {values_of(displacement_), values_of(velocity_)};
  }

 private:
  static std::vector<NodalValue> values_of(const Values& values) {
    std::vector<NodalValue> list;
    for (const auto& [place, value] : values) list.push_back({place.first, place.second, value});
    return list;
  }

  void take_groups(std::optional<Vector3> Region::*start, const char* option, Values& values) {
    for (const ElementSet& set : mesh_.regions) {
      const Region& region = structure_.regions[static_cast<std::size_t>(set.region)];
      if (!(region.*start)) continue;
      for (const GlobalIndex node : set.connectivity) {
        for (int d = 0; d < 3; ++d) {
          if ((mesh_.free_components[node] >> d & 1) == 0) continue;
          const double value = (*(region.*start))[static_cast<std::size_t>(d)];
          const auto [found, is_new] = values.insert({{node, d}, value});
          if (is_new || found->second == value) continue;
          throw UserError("option -" + structure_.name + "_" + region.group + option +
                          ": the node at " + place_text(mesh_.position(node)) +
                          " is of another group as well, which starts differently; give them in "
                          "a file (-" +
                          structure_.name + "_initial_state)");
        }
      }
    }
  }

  [[noreturn]] void refuse(long line, const std::string& why) const {
    throw UserError("option -" + structure_.name + "_initial_state " + structure_.initial_state +
                    (line > 0 ? ", line " + std::to_string(line) : "") + ": " + why);
  }

  void read_file() {
    require_finite_file(structure_.initial_state);
    std::ifstream file(structure_.initial_state);
    if (!file) refuse(0, "no such file, or it cannot be read");
    std::string text;
    long rows = 0;
    for (long number = 1; std::getline(file, text); ++number) {
      text = trimmed(text);
      if (text.empty() || text[0] == '#') continue;
      const std::vector<std::string> words = split(text, ',');
      if (names_.empty()) {
        read_names(number, words);
      } else {
        read_row(number, words);
        ++rows;
      }
    }
    if (rows == 0) refuse(0, "no node in it");
  }

  void read_names(long line, const std::vector<std::string>& words) {
    for (const std::string& word : words) {
      const bool known = std::ranges::find(place_names, word) != place_names.end() ||
                         std::ranges::find(value_names, word) != value_names.end();
      if (!known || std::ranges::find(names_, word) != names_.end()) {
        refuse(line, "'" + word +
                         "' where names of columns belong, each once: node or x,y,z, then "
                         "some of ux to rz and vx to wz");
      }
      names_.push_back(word);
    }
    const auto has = [&](std::string_view name) {
      return std::ranges::find(names_, name) != names_.end();
    };
    const bool by_place = has("x") && has("y") && has("z");
    if (has("node") == by_place) refuse(line, "give node or x,y,z, to find the nodes by");
  }

  void read_row(long line, const std::vector<std::string>& words) {
    if (words.size() != names_.size()) {
      refuse(line, std::to_string(words.size()) + " values for " + std::to_string(names_.size()) +
                       " columns");
    }
    std::map<std::string, double> row;
    for (std::size_t i = 0; i < words.size(); ++i) {
      const auto number = parse_real(words[i]);
      if (!number) refuse(line, "'" + words[i] + "' is no number");
      row[names_[i]] = *number;
    }
    const GlobalIndex node = row.contains("node") ? node_of_tag(line, row["node"])
                                                  : node_at(line, {row["x"], row["y"], row["z"]});
    for (std::size_t k = 0; k < value_names.size(); ++k) {
      const auto given = row.find(std::string(value_names[k]));
      if (given == row.end()) continue;
      const auto component = static_cast<int>(k % 6);
      if ((mesh_.free_components[node] >> component & 1) == 0) {
        if (given->second == 0) continue;
        refuse(line, "the node is clamped, or does not turn, in " + std::string(value_names[k]));
      }
      (k < 6 ? displacement_ : velocity_)[{node, component}] = given->second;
    }
  }

  GlobalIndex node_of_tag(long line, double tag) const {
    const auto found =
        std::ranges::lower_bound(mesh_.node_tags, static_cast<std::int64_t>(std::llround(tag)));
    if (found == mesh_.node_tags.end() || static_cast<double>(*found) != tag) {
      refuse(line, "no element in use has a node of that number");
    }
    return found - mesh_.node_tags.begin();
  }

  /// Nodes in the order of x, made when the first is asked for.
  GlobalIndex node_at(long line, const Vector3& x) {
    if (by_x_.empty()) {
      for (GlobalIndex node = 0; node < mesh_.node_count(); ++node) by_x_.push_back(node);
      std::ranges::sort(by_x_, {}, [&](GlobalIndex node) { return mesh_.position(node)[0]; });
      near_ = node_margin * bounding_box({&mesh_, 1}).diagonal();
    }
    const auto first = std::ranges::lower_bound(
        by_x_, x[0] - near_, {}, [&](GlobalIndex node) { return mesh_.position(node)[0]; });
    GlobalIndex best = -1;
    for (auto at = first; at != by_x_.end() && mesh_.position(*at)[0] <= x[0] + near_; ++at) {
      if (norm(minus(mesh_.position(*at), x)) > near_) continue;
      if (best >= 0) refuse(line, "two nodes lie at " + place_text(x) + "; name one by its number");
      best = *at;
    }
    if (best < 0) refuse(line, "no element in use has a node at " + place_text(x));
    return best;
  }

  const Structure& structure_;
  const GlobalMesh& mesh_;
  Values displacement_;
  Values velocity_;
  std::vector<std::string> names_;  ///< of the columns of the file
  std::vector<GlobalIndex> by_x_;
  double near_ = 0;  ///< [m]
};

}  // namespace

std::vector<NodalStart> find_start_states(const Scene& scene, std::span<const GlobalMesh> meshes) {
  std::vector<NodalStart> starts;
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const Structure& structure = scene.structures[s];
    starts.push_back(StartMaker(structure, meshes[s]).make());
    refuse_if(scene.preload && !starts.back().displacement.empty(),
              "option -" + structure.name + "_initial_state " + structure.initial_state +
                  ": the run starts from the static equilibrium; no displacements with "
                  "-preload static");
  }
  return starts;
}

}  // namespace pounding
