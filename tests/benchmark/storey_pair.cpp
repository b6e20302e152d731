#include "benchmark/storey_pair.h"

#include <utility>
#include <vector>

namespace pounding::measuring {
namespace {

constexpr int length_x = 6;  // [m]
constexpr int length_y = 4;  // [m]
constexpr int storeys = 3;
constexpr int column_height = 2;  // [m], below a slab of 1 m
constexpr int storey_height = column_height + 1;
constexpr double gap = 0.05;  // [m]

/// Numbers the nodes of the bricks that are there, brick by brick.
class StoreyMesh {
 public:
  StoreyMesh(int cells_per_metre, double origin_x)
      : n_(cells_per_metre),
        origin_x_(origin_x),
        number_(static_cast<std::size_t>((length_x * n_ + 1) * (length_y * n_ + 1) *
                                         (storeys * storey_height * n_ + 1)),
                -1) {
    ElementSet body;
    body.group = "body";
    for (int k = 0; k < storeys * storey_height * n_; ++k) {
      for (int j = 0; j < length_y * n_; ++j) {
        for (int i = 0; i < length_x * n_; ++i) {
          if (in_slab(k) || in_column(i, j)) {
            add_brick(i, j, k, body);
          }
        }
      }
    }
    mesh.regions.push_back(std::move(body));
    mesh.components.assign(mesh.node_tags.size(), 0x07);
  }

  /// Nodes of the slabs in the plane of constant i, in the order of z, then y.
  std::vector<GlobalIndex> slab_edge(int i) const {
    std::vector<GlobalIndex> nodes;
    for (int storey = 0; storey < storeys; ++storey) {
      const int bottom = (storey * storey_height + column_height) * n_;
      for (int k = bottom; k <= bottom + n_; ++k) {
        for (int j = 0; j <= length_y * n_; ++j) {
          nodes.push_back(number_[place(i, j, k)]);
        }
      }
    }
    return nodes;
  }

  GlobalMesh mesh;

 private:
  bool in_slab(int k) const { return k / n_ % storey_height == column_height; }
  bool in_column(int i, int j) const {
    return (i < n_ || i >= (length_x - 1) * n_) && (j < n_ || j >= (length_y - 1) * n_);
  }

  std::size_t place(int i, int j, int k) const {
    return static_cast<std::size_t>((k * (length_y * n_ + 1) + j) * (length_x * n_ + 1) + i);
  }

  GlobalIndex node(int i, int j, int k) {
    GlobalIndex& number = number_[place(i, j, k)];
    if (number < 0) {
      number = mesh.node_count();
      mesh.node_tags.push_back(number + 1);
      const double h = 1.0 / n_;
      mesh.coordinates.insert(mesh.coordinates.end(), {origin_x_ + h * i, h * j, h * k});
      mesh.free_components.push_back(k == 0 ? 0 : 0x07);
    }
    return number;
  }

  void add_brick(int i, int j, int k, ElementSet& body) {
    body.tags.push_back(static_cast<std::int64_t>(body.tags.size()) + 1);
    for (int top = k; top <= k + 1; ++top) {
      for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        body.connectivity.push_back(node(i + a, j + b, top));
      }
    }
  }

  int n_;
  double origin_x_;
  std::vector<GlobalIndex> number_;  ///< per place of the full grid; -1: no node
};

interactions::Constraint facing(const GlobalMesh& mesh, GlobalIndex secondary,
                                GlobalIndex primary) {
  interactions::Constraint constraint;
  constraint.terms = {{1, primary, 0, 1.0}, {0, secondary, 0, -1.0}};
  constraint.initial_gap = constraint.geometric_gap = gap;
  const Vector3 x = mesh.position(secondary);
  constraint.place = {x[1], x[2]};
  constraint.matched = true;
  return constraint;
}

}  // namespace

StoreyPair build_storey_pair(int cells_per_metre) {
  StoreyMesh left(cells_per_metre, 0);
  StoreyMesh right(cells_per_metre, length_x + gap);
  const std::vector<GlobalIndex> secondary = left.slab_edge(length_x * cells_per_metre);
  const std::vector<GlobalIndex> primary = right.slab_edge(0);
  StoreyPair pair;
  for (std::size_t i = 0; i < secondary.size(); ++i) {
    pair.interface.constraints.push_back(facing(left.mesh, secondary[i], primary[i]));
  }
  pair.interface.model_size = 2 * length_x + gap;
  pair.meshes = {std::move(left.mesh), std::move(right.mesh)};
  return pair;
}

}  // namespace pounding::measuring
