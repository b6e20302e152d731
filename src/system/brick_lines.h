#pragma once

#include <array>
#include <vector>

#include "system/brick_class.h"
#include "system/brick_rows.h"
#include "system/dof_places.h"

namespace pounding {

/// What congruent bricks share.
struct BrickShape {
  ElementType type = ElementType::hex8;
  ElementProperties properties;
  Vector3 lengths{};
};

/// The product of the bricks of one frame. It visits their runs in the order of the mesh's
/// numbering and keeps in a small buffer only the chains of nodes that are in use:
///
///     w -> [load chain] -> x[] y[] z[] -> runs -> fx[] fy[] fz[] -> [store chain] -> q
///
/// so that w is read and q written once, and what the runs work on stays in the nearest cache.
class BrickLines {
 public:
  /// `rows` of splittable bricks of `shapes`; `axes`: rows are the axes of the frame.
  BrickLines(const DofPlaces& places, const Matrix3& axes, const std::vector<BrickShape>& shapes,
             const BrickRows& rows);

  /// q = K w on the owned dofs that these bricks touch, or q += K w. Allocates nothing.
  void apply(const double* owned, const double* ghosts, double* q, bool add) const;

  /// Sets 1 where `apply` writes, shape (owned_dofs).
  void mark_touched(std::vector<char>& touched) const;

 private:
  struct Chain {
    int begin = 0;  ///< into places_: one per node if plain, else x, y, z of each node
    int length = 0;
    bool plain = false;  ///< every node owns x, y, z in a row, and one more dof follows
  };
  struct Run {
    int split = 0;
    int count = 0;
    std::array<int, 4> start{};  ///< of the first nodes, into buffer_
    int loads_end = 0;           ///< loads_ up to here come before this run
    int stores_end = 0;          ///< stores_ up to here come after it
  };
  struct Transfer {
    int chain = 0;
    int start = 0;  ///< of the chain's line, into buffer_
  };

  void add_chain(const DofPlaces& places, const std::vector<LocalIndex>& nodes);
  void schedule(const BrickRows& rows);
  void load_chain(const Transfer& transfer, const double* owned, const double* ghosts) const;
  void store_chain(const Transfer& transfer, double* q, bool add) const;

  LocalIndex owned_dofs_ = 0;
  bool rotated_ = false;
  Matrix3 axes_{};                  ///< run axis first
  std::array<int, 3> component_{};  ///< where x, y, z stand in a line
  std::vector<BrickSplit> splits_;  ///< per shape
  std::vector<Chain> chains_;
  std::vector<LocalIndex> places_;
  std::vector<Run> runs_;
  std::vector<Transfer> loads_;
  std::vector<Transfer> stores_;
  int line_stride_ = 0;
  /// Lines of shape (6, line_stride): displacement, force. Work space of `apply`.
  mutable std::vector<double> buffer_;
};

}  // namespace pounding
