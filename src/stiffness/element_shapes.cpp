#include "stiffness/element_shapes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "common/parallel.h"

namespace pounding::stiffness {
namespace {

constexpr std::size_t rectangle_size = 4 * 3;

/// Nodes in some axes, relative to the first one, and the box around them.
struct LocalNodes {
  LocalNodes(const Matrix3& axes, std::span<const double> coordinates)
      : count(coordinates.size() / 3) {
    for (std::size_t a = 0; a < count; ++a) {
      Vector3 x{};
      for (std::size_t d = 0; d < 3; ++d) x[d] = coordinates[3 * a + d] - coordinates[d];
      positions[a] = multiply(axes, x);
      for (std::size_t d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], positions[a][d]);
        high[d] = std::max(high[d], positions[a][d]);
      }
    }
    for (std::size_t d = 0; d < 3; ++d) lengths[d] = high[d] - low[d];
  }

  std::size_t count;
  std::array<Vector3, 8> positions{};
  Vector3 low{1e300, 1e300, 1e300};
  Vector3 high{-1e300, -1e300, -1e300};
  Vector3 lengths{};
};

/// The box or rectangle in known axes, if it is one there.
std::optional<Box> box_in(const Matrix3& axes, std::span<const double> coordinates,
                          double tolerance) {
  const LocalNodes nodes(axes, coordinates);
  Box box;
  box.lengths = nodes.lengths;
  std::array<std::size_t, 3> thinnest_first{0, 1, 2};
  std::stable_sort(thinnest_first.begin(), thinnest_first.end(),
                   [&](std::size_t a, std::size_t b) { return box.lengths[a] < box.lengths[b]; });
  const bool flat = coordinates.size() == rectangle_size;
  const double allowed = tolerance * box.lengths[thinnest_first[flat ? 1 : 0]];
  if (flat) {
    const std::size_t normal = thinnest_first[0];
    if (!(box.lengths[normal] <= allowed)) return std::nullopt;
    box.normal = static_cast<int>(normal);
    box.lengths[normal] = 0;
  }
  box.corner.fill(-1);
  for (std::size_t a = 0; a < nodes.count; ++a) {
    const Vector3& x = nodes.positions[a];
    std::size_t bits = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      if (static_cast<int>(d) == box.normal) continue;
      const bool far = x[d] - nodes.low[d] > box.lengths[d] / 2;
      const double face = far ? nodes.high[d] : nodes.low[d];
      if (!(std::abs(x[d] - face) <= allowed)) return std::nullopt;
      bits |= static_cast<std::size_t>(far) << d;
    }
    if (box.corner[bits] >= 0) return std::nullopt;
    box.corner[bits] = static_cast<int>(a);
  }
  return box;
}

/// Orthonormal axes along the first edges of an element; nothing if they do not span a plane.
std::optional<Matrix3> edge_axes(std::span<const double> coordinates) {
  const auto edge = [&](std::size_t node) {
    Vector3 e{};
    for (std::size_t d = 0; d < 3; ++d) e[d] = coordinates[3 * node + d] - coordinates[d];
    return e;
  };
  const auto unit = [](Vector3 e) {
    const double length = norm(e);
    for (double& x : e) x /= length;
    return e;
  };
  const Vector3 x = unit(edge(1));
  const Vector3 z = unit(cross(x, edge(3)));
  const Matrix3 axes{x, cross(z, x), z};
  return std::isfinite(determinant(axes)) ? std::optional(axes) : std::nullopt;
}

constexpr std::size_t most_ranges = 10000;  // per rank; a mesh without equal elements has no use

constexpr std::int64_t no_tag = std::numeric_limits<std::int64_t>::max();

/// Shortest distance of a node from the first one of its element, per block over all ranks [m].
std::vector<double> shortest_distances(const Mesh& mesh) {
  ElementWork work;
  std::vector<double> shortest;
  for (const ElementBlock& block : mesh.blocks) {
    double& distance = shortest.emplace_back(INFINITY);
    for (std::size_t e = 0; has_shape(block.type) && e < block.count(); ++e) {
      const auto x = gather_coordinates(mesh, block, e, work);
      for (std::size_t i = 3; i < x.size(); i += 3) {
        distance = std::min(distance, std::hypot(x[i] - x[0], x[i + 1] - x[1], x[i + 2] - x[2]));
      }
    }
  }
  reduce_over_ranks(mesh.comm, MPI_MIN, shortest);
  return shortest;
}

/// Boxes that fit in none of the frames so far: the first of them by its tag, and its axes.
struct Candidate {
  std::int64_t tag = no_tag;
  Matrix3 axes{};
};

Candidate first_outside(const Mesh& mesh, const ElementBlock& block, const ElementFrames& frames) {
  ElementWork work;
  Candidate candidate;
  for (std::size_t e = 0; e < block.count(); ++e) {
    if (block.tags[e] >= candidate.tag) continue;
    const auto x = gather_coordinates(mesh, block, e, work);
    if (frames.recognise(x, congruence)) continue;
    if (const auto axes = ElementFrames::axes_of_box(x, congruence)) {
      candidate = {block.tags[e], *axes};
    }
  }
  return candidate;
}

/// The candidate with the smallest tag on every rank. Collective.
Candidate first_of_all(MPI_Comm comm, Candidate candidate) {
  std::int64_t smallest = candidate.tag;
  reduce_over_ranks(comm, MPI_MIN, smallest);
  int rank = candidate.tag == smallest ? rank_of(comm) : size_of(comm);
  reduce_over_ranks(comm, MPI_MIN, rank);
  MPI_Bcast(candidate.axes.data(), 9, MPI_DOUBLE, rank, comm);
  return {smallest, candidate.axes};
}

}  // namespace

std::optional<Box> ElementFrames::recognise(std::span<const double> coordinates,
                                            double tolerance) const {
  for (std::size_t frame = 0; frame < axes_.size(); ++frame) {
    if (auto box = box_in(axes_[frame], coordinates, tolerance)) {
      box->frame = static_cast<int>(frame);
      return box;
    }
  }
  return std::nullopt;
}

std::optional<Matrix3> ElementFrames::axes_of_box(std::span<const double> coordinates,
                                                  double tolerance) {
  const auto axes = edge_axes(coordinates);
  return axes && box_in(*axes, coordinates, tolerance) ? axes : std::nullopt;
}

void CommonValues::add(double value) {
  if (!too_many_) add_range(value, value);
}

void CommonValues::add_range(double low, double high) {
  // Starts from the first range that ends no farther than the tolerance below.
  auto range = ranges_.upper_bound(low);
  while (range != ranges_.begin() && std::prev(range)->second >= low - tolerance_) --range;
  while (range != ranges_.end() && range->first <= high + tolerance_) {
    low = std::min(low, range->first);
    high = std::max(high, range->second);
    range = ranges_.erase(range);
  }
  ranges_[low] = high;
  too_many_ = ranges_.size() > most_ranges;
}

void CommonValues::agree(MPI_Comm comm) {
  too_many_ = on_any_rank(comm, too_many_);
  if (too_many_) {
    ranges_.clear();
    return;
  }
  std::vector<double> mine;
  for (const auto& [low, high] : ranges_) mine.insert(mine.end(), {low, high});
  const std::vector<double> all = gather_rows(comm, mine);
  for (std::size_t i = 0; i < all.size(); i += 2) add_range(all[i], all[i + 1]);
  too_many_ = false;
}

double CommonValues::operator()(double value) const {
  if (too_many_) return std::round(value / tolerance_) * tolerance_;
  const auto range = std::prev(ranges_.upper_bound(value));
  return range->first + (range->second - range->first) / 2;
}

ElementShapes::ElementShapes(const Mesh& mesh) : mesh_(mesh) {
  find_frames();
  const std::vector<double> shortest = shortest_distances(mesh);
  boxes_.resize(mesh.blocks.size());
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    if (has_shape(mesh.blocks[b].type)) find_boxes(b);
    find_common_values(b, congruence * shortest[b]);
  }
}

/// Block by block, each box that fits in no frame yet brings its own.
void ElementShapes::find_frames() {
  for (const ElementBlock& block : mesh_.blocks) {
    while (has_shape(block.type) && !frames_.full()) {
      const Candidate next = first_of_all(mesh_.comm, first_outside(mesh_, block, frames_));
      if (next.tag == no_tag) break;
      frames_.add(next.axes);
    }
  }
}

void ElementShapes::find_boxes(std::size_t block) {
  ElementWork work;
  for (std::size_t e = 0; e < mesh_.blocks[block].count(); ++e) {
    const auto x = gather_coordinates(mesh_, mesh_.blocks[block], e, work);
    boxes_[block].push_back(frames_.recognise(x, congruence).value_or(Box{}));
  }
}

void ElementShapes::find_common_values(std::size_t block, double tolerance) {
  CommonValues& lengths = lengths_.emplace_back(tolerance);
  CommonValues& distances = distances_.emplace_back(tolerance);
  for (std::size_t e = 0; e < boxes_[block].size(); ++e) {
    if (boxes_[block][e].frame >= 0) {
      for (const double length : boxes_[block][e].lengths) lengths.add(length);
    } else {
      for (const double distance : own_coordinates(block, e)) distances.add(distance);
    }
  }
  lengths.agree(mesh_.comm);
  distances.agree(mesh_.comm);
  for (Box& box : boxes_[block]) {
    if (box.frame < 0) continue;
    for (double& length : box.lengths) length = lengths(length);
  }
}

const Box* ElementShapes::box(std::size_t block, std::size_t element) const {
  const Box& box = boxes_[block][element];
  return box.frame >= 0 ? &box : nullptr;
}

std::vector<double> ElementShapes::own_coordinates(std::size_t block, std::size_t element) const {
  ElementWork work;
  const auto x = gather_coordinates(mesh_, mesh_.blocks[block], element, work);
  std::vector<double> relative(x.size());
  for (std::size_t i = 0; i < relative.size(); ++i) relative[i] = x[i] - x[i % 3];
  return relative;
}

std::vector<double> ElementShapes::coordinates(std::size_t block, std::size_t element) const {
  std::vector<double> x = own_coordinates(block, element);
  const Box* const box = this->box(block, element);
  if (box == nullptr) {
    for (double& distance : x) distance = distances_[block](distance);
    return x;
  }
  const Matrix3& r = frames_.axes(box->frame);
  for (std::size_t bits = 0; bits < 8; ++bits) {
    if (box->corner[bits] < 0) continue;
    const std::size_t node = box->corner[bits];
    for (std::size_t i = 0; i < 3; ++i) {
      x[3 * node + i] = 0;
      for (std::size_t d = 0; d < 3; ++d) {
        if ((bits >> d & 1) != 0) x[3 * node + i] += r[d][i] * box->lengths[d];
      }
    }
  }
  const std::array<double, 3> first{x[0], x[1], x[2]};
  for (std::size_t i = 0; i < x.size(); ++i) x[i] -= first[i % 3];
  return x;
}

void ElementShapes::find_coordinates(std::size_t block, std::size_t element,
                                     ElementWork& work) const {
  if (has_shape(mesh_.blocks[block].type)) {
    std::ranges::copy(coordinates(block, element), work.coordinates.begin());
  } else {
    gather_coordinates(mesh_, mesh_.blocks[block], element, work);
  }
}

}  // namespace pounding::stiffness
