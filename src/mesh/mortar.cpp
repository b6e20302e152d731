#include "mesh/mortar.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/dense_matrix.h"
#include "common/matrix3.h"
#include "mesh/facet_overlap.h"
#include "mesh/global_mesh.h"

namespace pounding {
namespace {

/// Parts of a facet: more than this beyond all of it is covered twice; less than `hardly` of it is
/// not covered.
constexpr double twice = 1e-6;
constexpr double hardly = 1e-2;

/// Part of a node's facets that has to be covered.
constexpr double mostly = 0.5;

/// Parts of a node's largest entry that are round-off.
constexpr double relative_round_off = 1e-12;

double size_of(const std::vector<OverlapPoint>& points) {
  double sum = 0;
  for (const OverlapPoint& point : points) sum += point.weight;
  return sum;
}

/// Part that a facet has in common with one that it follows.
struct Piece {
  const Facet* followed = nullptr;
  std::vector<OverlapPoint> points;
  Vector3 middle() const {
    const double whole = size_of(points);
    Vector3 mean{0, 0, 0};
    for (const OverlapPoint& point : points) {
      for (std::size_t d = 0; d < 3; ++d) mean[d] += point.weight / whole * point.x[d];
    }
    return mean;
  }
};

double size_of(const std::vector<Piece>& pieces) {
  double sum = 0;
  for (const Piece& piece : pieces) sum += size_of(piece.points);
  return sum;
}

/// Sums of w phi_i of a facet.
std::array<double, 4> sums_of(const std::vector<OverlapPoint>& points) {
  std::array<double, 4> sums{};
  for (const OverlapPoint& point : points) {
    for (std::size_t i = 0; i < 4; ++i) sums[i] += point.weight * point.shares[i];
  }
  return sums;
}

/// The factors of phi_k in mu_i, shape (n, n): D A^-1, A = sum of w phi phi^T, D = sum of w phi.
std::vector<double> dual_factors(const std::vector<Piece>& pieces, std::size_t n) {
  std::vector<double> factors(n * n, 0.0);
  std::array<double, 4> sums{};
  for (const Piece& piece : pieces) {
    for (const auto& [x, phi, bulges, weight] : piece.points) {
      for (std::size_t i = 0; i < n; ++i) {
        sums[i] += weight * phi[i];
        for (std::size_t k = 0; k < n; ++k) factors[n * i + k] += weight * phi[i] * phi[k];
      }
    }
  }
  if (!invert_definite(factors)) return {};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) factors[n * i + k] *= sums[i];
  }
  return factors;
}

class Mortar {
 public:
  Mortar(const GlobalMesh& mesh, const FollowedFacets& followed,
         const std::map<GlobalIndex, TiedNode>& places)
      : mesh_(mesh), followed_(followed), places_(places) {}

  void add(const Facet& facet) {
    const std::vector<Vector3> corners = corners_of(mesh_, facet);
    const std::vector<OverlapPoint> whole = overlap_points(corners, corners);
    const std::array<double, 4> sums = sums_of(whole);
    for (std::size_t i = 0; i < corners.size(); ++i) rows_[facet.nodes[i]].whole += sums[i];
    const std::vector<Piece> pieces = pieces_of(corners, size_of(whole));
    const std::vector<double> factors = dual_factors(pieces, corners.size());
    if (factors.empty()) return;
    for (const Piece& piece : pieces) add(facet, piece, factors);
  }

  std::map<GlobalIndex, TiedNode> rows() const {
    std::map<GlobalIndex, TiedNode> rows;
    for (const auto& [node, row] : rows_) {
      if (!(row.covered > 0) || row.covered < mostly * row.whole) continue;
      TiedNode tied{node, places_.at(node).group, row.carriers};
      for (Carrier& carrier : tied.carriers) {
        for (double& value : carrier.block) value /= row.covered;
      }
      const bool turns = (mesh_.components[node] & rotation_bits) != 0;
      settle(places_.at(node), turns ? 36 : 18, tied);
      rows[node] = std::move(tied);
    }
    return rows;
  }

 private:
  /// Sums of one node.
  struct Row {
    double whole = 0;    ///< of w phi over its facets
    double covered = 0;  ///< of w mu
    std::vector<Carrier> carriers;
  };

  /// Pieces of a facet of a given size in common with those followed.
  std::vector<Piece> pieces_of(const std::vector<Vector3>& corners, double size) const {
    std::vector<Piece> pieces;
    for (const Facet* facet : followed_.near(box_of(corners))) {
      const std::vector<Vector3> other = corners_of(mesh_, *facet);
      Piece piece{facet, overlap_points(corners, other)};
      if (piece.points.empty()) continue;
      const double distance = nearest_point(other, piece.middle()).distance;
      if (distance <= followed_.reach(*facet)) pieces.push_back(std::move(piece));
    }
    if (size_of(pieces) > (1 + twice) * size) {  // one behind the other
      std::erase_if(pieces, [&](const Piece& piece) {
        return std::ranges::count(followed_.nearest(piece.middle()), piece.followed,
                                  &FollowedPoint::facet) == 0;
      });
    }
    const double covered = size_of(pieces);
    if (covered < hardly * size || covered > (1 + twice) * size) pieces.clear();
    return pieces;
  }

  void add(const Facet& facet, const Piece& piece, const std::vector<double>& factors) {
    const std::vector<Vector3> followed = corners_of(mesh_, *piece.followed);
    const std::size_t n = facet.corners().size();
    const bool turns = followed_.turns(*piece.followed);
    std::array<std::array<double, 4>, 4> bulges{};  // of edges, per corner
    for (const OverlapPoint& point : piece.points) {
      const FollowedPoint at{piece.followed, nearest_point(followed, point.x)};
      for (std::size_t i = 0; i < n; ++i) {
        double weight = 0;
        for (std::size_t k = 0; k < n; ++k) weight += factors[n * i + k] * point.shares[k];
        weight *= point.weight;
        Row& row = rows_[facet.nodes[i]];
        row.covered += weight;
        followed_.follow(at, point.x, weight, row.carriers);
        for (std::size_t e = 0; e < n; ++e) bulges[i][e] += weight * point.bulges[e];
      }
    }
    if (!turns) return;
    const FollowedPoint middle{piece.followed, nearest_point(followed, piece.middle())};
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t e = 0; e < (n == 2 ? 1 : n); ++e) {
        take_off(middle, bulges[i][e] / 8, {facet.nodes[e], facet.nodes[(e + 1) % n]},
                 rows_[facet.nodes[i]].carriers);
      }
    }
  }

  /// Takes off the bending of an edge of the nodes' facet, by the turns of its ends.
  void take_off(const FollowedPoint& middle, double bulge, const std::array<GlobalIndex, 2>& ends,
                std::vector<Carrier>& carriers) const {
    const Vector3 edge = minus(mesh_.position(ends[1]), mesh_.position(ends[0]));
    for (std::size_t end = 0; end < 2; ++end) {
      const double factor = end == 0 ? -bulge : bulge;
      for (const Carrier& from : places_.at(ends[end]).carriers) {
        Carrier& carrier = carrier_of(from.node, carriers);
        for (std::size_t j = 0; j < 6; ++j) {
          const Vector3 turn{factor * from.block[18 + j], factor * from.block[24 + j],
                             factor * from.block[30 + j]};
          const Vector3 shift = followed_.bent(middle, cross(turn, edge));
          for (std::size_t d = 0; d < 3; ++d) carrier.block[6 * d + j] += shift[d];
        }
      }
    }
  }

  /// Takes the row of the place where the other one is the same in the entries that the node has
  /// components for, and carriers that are round-off from it elsewhere.
  static void settle(const TiedNode& place, std::size_t entries, TiedNode& tied) {
    std::array<double, 4> largest{};  // of translations and rotations by either
    const auto kind = [](std::size_t k) { return k / 18 * 2 + k % 6 / 3; };
    for (const Carrier& carrier : tied.carriers) {
      for (std::size_t k = 0; k < entries; ++k) {
        largest[kind(k)] = std::max(largest[kind(k)], std::abs(carrier.block[k]));
      }
    }
    TiedNode left = tied;
    for (const Carrier& carrier : place.carriers) {
      Carrier& other = carrier_of(carrier.node, left.carriers);
      for (std::size_t k = 0; k < entries; ++k) other.block[k] -= carrier.block[k];
    }
    const auto is_nothing = [&](const Carrier& carrier) {
      for (std::size_t k = 0; k < entries; ++k) {
        if (std::abs(carrier.block[k]) > relative_round_off * largest[kind(k)]) return false;
      }
      return true;
    };
    if (std::ranges::all_of(left.carriers, is_nothing)) {
      tied = place;
      return;
    }
    std::erase_if(tied.carriers, is_nothing);
  }

  const GlobalMesh& mesh_;
  const FollowedFacets& followed_;
  const std::map<GlobalIndex, TiedNode>& places_;
  std::map<GlobalIndex, Row> rows_;
};

}  // namespace

std::map<GlobalIndex, TiedNode> mortar_rows(const GlobalMesh& mesh,
                                            const std::vector<Facet>& facets,
                                            const FollowedFacets& followed,
                                            const std::map<GlobalIndex, TiedNode>& places) {
  Mortar mortar(mesh, followed, places);
  for (const Facet& facet : facets) {
    if (facet.count >= 2) mortar.add(facet);
  }
  return mortar.rows();
}

}  // namespace pounding
