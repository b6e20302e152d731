#include "stiffness/element_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/parallel.h"
#include "stiffness/element_loop.h"

namespace pounding::stiffness {
namespace {

constexpr double congruence = 1e-10;  // of the shortest edge
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
  MPI_Allreduce(MPI_IN_PLACE, shortest.data(), static_cast<int>(shortest.size()), MPI_DOUBLE,
                MPI_MIN, mesh.comm);
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
  MPI_Allreduce(MPI_IN_PLACE, &smallest, 1, MPI_INT64_T, MPI_MIN, comm);
  int rank = candidate.tag == smallest ? rank_of(comm) : size_of(comm);
  MPI_Allreduce(MPI_IN_PLACE, &rank, 1, MPI_INT, MPI_MIN, comm);
  MPI_Bcast(candidate.axes.data(), 9, MPI_DOUBLE, rank, comm);
  return {smallest, candidate.axes};
}

}  // namespace

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

}  // namespace pounding::stiffness
