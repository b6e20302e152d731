#pragma once

#include <array>
#include <vector>

#include "system/brick_class.h"
#include "system/brick_rows.h"
#include "system/dof_places.h"
#include "system/stiffness.h"

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
/// so that w is read and q written once, and what the runs work on stays in the nearest cache. The
/// forces of a chain whose dofs nothing else touches later need not go to q: they are handed over.
class BrickLines {
 public:
  /// `rows` of splittable bricks of `shapes`; `axes`: rows are the axes of the frame.
  BrickLines(const DofPlaces& places, const Matrix3& axes, const std::vector<BrickShape>& shapes,
             const BrickRows& rows);

  /// What becomes of the forces of a chain.
  enum class Outcome : char {
    add,        ///< to q
    complete,   ///< with what q holds already they are final: handed over, q is zero again
    hand_over,  ///< final as they are: q is left alone
  };

  /// Chains in the order in which `apply` is done with them.
  std::size_t chain_count() const { return stores_.size(); }
  /// Owned dofs of a chain to which the bricks add.
  std::vector<LocalIndex> chain_dofs(std::size_t place) const;
  /// All dofs of the chain's nodes, rotations included, if they are owned and follow each other;
  /// else an empty range.
  DofRange chain_range(std::size_t place) const;
  /// Decides for every chain; other outcomes than `add` for those with a range only. Ranges
  /// finished by the same run that lie side by side are handed over as one. Call once.
  void set_outcomes(const std::vector<Outcome>& outcomes);

  /// q += K w on the owned dofs that these bricks touch, but see Outcome. Allocates nothing.
  void apply(const StiffnessArgument& w, const double* ghosts, double* q,
             ForceReceiver& receiver) const;

 private:
  struct Chain {
    int begin = 0;  ///< into places_: one per node if plain, else x, y, z of each node
    int length = 0;
    bool plain = false;  ///< every node owns x, y, z in a row, and one more dof follows
    DofRange range;      ///< as in chain_range
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
    Outcome outcome = Outcome::add;
    LocalIndex begin = 0;  ///< first dof of what is handed over with this chain
    LocalIndex end = 0;    ///< one beyond its last if this chain completes it, else 0
  };

  void add_chain(const DofPlaces& places, const std::vector<LocalIndex>& nodes);
  void schedule(const BrickRows& rows);
  void load_chain(const Transfer& transfer, const StiffnessArgument& w, const double* ghosts) const;
  void store_chain(const Transfer& transfer, double* q, ForceReceiver& receiver) const;
  void add_forces(const Chain& chain, const std::array<const double*, 3>& force, double* q) const;
  void complete_range(const Transfer& transfer, double* q) const;

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
  mutable std::vector<double> range_;  ///< forces of the range that is being handed over
};

}  // namespace pounding
