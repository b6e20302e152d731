#pragma once

#include <array>
#include <vector>

#include "common/matrix3.h"
#include "common/memory.h"
#include "stiffness/bricks/brick_chains.h"
#include "stiffness/bricks/brick_class.h"
#include "stiffness/bricks/line_schedule.h"
#include "stiffness/rows/chain_line.h"
#include "stiffness/rows/dof_places.h"
#include "stiffness/rows/element_lines.h"
#include "stiffness/rows/element_rows.h"

namespace pounding::stiffness {

/// Common data of congruent bricks.
struct BrickShape {
  ElementType type = ElementType::hex8;
  ElementProperties properties;
  Vector3 lengths{};
};

/// The product of the bricks of one frame. The buffer holds the chains of nodes, and the pairs of
/// chains, that are in use:
///
///     w -> [load chain] -> x[] y[] z[] -> [split pair] -> sums, differences -> [steps]
///       -> forces of sums, differences -> [join pair] -> fx[] fy[] fz[] -> [store chain] -> q
///
/// What the steps work on stays in the nearest cache. The chains of a layer one brick thick hold
/// the sums and differences of their pair themselves. Ranges finished one after the other that lie
/// side by side are handed over as one, as long as they stay small.
class BrickLines final : public ElementLines {
 public:
  /// `rows` of splittable bricks of `shapes`; `axes`: rows are the axes of the frame.
  BrickLines(const DofPlaces& places, const Matrix3& axes, const std::vector<BrickShape>& shapes,
             const BrickRows& rows, const ProductForms& forms);

  std::size_t chain_count() const override { return stores_.size(); }
  std::vector<LocalIndex> chain_dofs(std::size_t place) const override;
  DofRange chain_range(std::size_t place) const override;
  void set_handed_over(const std::vector<char>& handed_over) override;
  void apply(const StiffnessArgument& w, const double* ghosts, double* q,
             ForceReceiver& receiver) const override;

 private:
  struct Store {
    ChainStore place;
    bool handed_over = false;
  };

  struct PairEnd {
    int node = 0;
    std::array<LocalIndex, 3> near{};  ///< places of x, y, z, as in ChainEnd
    std::array<LocalIndex, 3> far{};
  };
  /// How a pair of rows is loaded: a stretch of both in vectors, other nodes one by one.
  struct PairLoad {
    int begin = 0;
    int count = 0;
    std::array<LocalIndex, 2> first{};  ///< dofs of the first node
    std::vector<PairEnd> ends;
  };

  void sort_stores(std::size_t begin, std::size_t end);
  void make_room();
  void load_chain(const ChainLoad& load, const StiffnessArgument& w, const double* ghosts) const;
  Vector3 value(const std::array<LocalIndex, 3>& place, const StiffnessArgument& w,
                const double* ghosts) const;
  PairLoad plan_load(const PairPlace& place) const;
  void load_pair(const PairPlace& place, const PairLoad& load, const StiffnessArgument& w,
                 const double* ghosts) const;
  void split_chains(std::size_t number, const StiffnessArgument& w, const double* ghosts) const;
  void apply_step(const LineStep& step) const;
  void join_chains(const PairJoin& join) const;
  void store_chain(const Store& store, double* q, ForceReceiver& receiver) const;
  void add_core(const Store& store, double* q) const;
  void add_ends(const Store& store, double* q) const;
  void collect_forces(const Store& store, double* range) const;
  ComponentArrays displacements(int start) const;
  ComponentArrays forces(int start) const;
  void clear_forces(int start, int length) const;

  ProductForms forms_;
  LocalIndex owned_dofs_ = 0;
  bool rotated_ = false;
  Matrix3 axes_{};                      ///< those of the pairs
  std::array<int, 3> component_{};      ///< where x, y, z stand in a line
  std::vector<BrickStencil> stencils_;  ///< per shape
  BrickChains chains_;
  LineSchedule schedule_;
  std::vector<PairLoad> pair_loads_;  ///< per split
  std::vector<Store> stores_;         ///< those of schedule_
  int line_stride_ = 0;
  /// Lines of shape (6, line_stride): displacement, force. Work space of `apply`.
  mutable LaneArray buffer_;
  mutable LaneArray range_;  ///< forces of a core until they are handed over
  mutable LaneArray added_;  ///< of a chain that is added to q
};

}  // namespace pounding::stiffness
