#pragma once

#include <array>
#include <vector>

#include "common/matrix3.h"
#include "common/memory.h"
#include "stiffness/rows/dof_places.h"
#include "stiffness/rows/element_lines.h"
#include "stiffness/rows/element_rows.h"
#include "stiffness/rows/product_forms.h"
#include "stiffness/shells/shell_chain.h"
#include "stiffness/shells/shell_class.h"

namespace pounding::stiffness {

/// Common data of congruent rectangles.
struct RectangleShape {
  ElementProperties properties;
  /// Edges along the two axes that follow the normal in cyclic order [m].
  std::array<double, 2> lengths{};
};

/// The product of the rectangular shells that lie in the planes across one axis of a frame. The
/// buffer holds the chains of nodes that are in use, a line of twelve arrays each, along and about
/// the run, across it, and the normal:
///
///     w -> [load chain] -> u0[] .. u5[] -> [runs] -> f0[] .. f5[] -> [store chain] -> q
class ShellLines final : public ElementLines {
 public:
  /// `rows` of splittable rectangles of `shapes`; `axes`: rows are the axes of the frame.
  ShellLines(const DofPlaces& places, const Matrix3& axes, int normal,
             const std::vector<RectangleShape>& shapes, const RectangleRows& rows,
             const ProductForms& forms);

  std::size_t chain_count() const override { return stores_.size(); }
  std::vector<LocalIndex> chain_dofs(std::size_t place) const override;
  DofRange chain_range(std::size_t place) const override;
  void set_handed_over(const std::vector<char>& handed_over) override;
  void apply(const StiffnessArgument& w, const double* ghosts, double* q,
             ForceReceiver& receiver) const override;

 private:
  struct Chain {
    int begin = 0;  ///< into places_: one per node if plain, else six
    int length = 0;
    bool plain = false;  ///< every node owns six dofs in a row
    DofRange range;      ///< as in chain_range
  };
  struct Transfer {
    int chain = 0;
    int start = 0;  ///< of the chain's line, into buffer_
    bool handed_over = false;
  };
  /// The entries of loads_ and stores_ up to the given ends come before it, after it.
  struct Run {
    int shape = 0;
    int count = 0;
    std::array<int, 2> start{};  ///< of the first nodes, into buffer_
    std::size_t loads_end = 0;
    std::size_t stores_end = 0;
  };

  void add_chain(const DofPlaces& places, const std::vector<LocalIndex>& nodes);
  void schedule(const RectangleRows& rows);
  void load_chain(const Transfer& transfer, const StiffnessArgument& w, const double* ghosts) const;
  void store_chain(const Transfer& transfer, double* q, ForceReceiver& receiver) const;
  void rotate(bool back, int length, double* values) const;
  SixArrays arrays(double* values) const;
  LocalIndex place(const Chain& chain, int node, int component) const;
  const Chain& chain_of(int number) const { return chains_[number]; }

  ProductForms forms_;
  LocalIndex owned_dofs_ = 0;
  bool rotated_ = false;
  Matrix3 axes_{};                  ///< along the run, across it, normal
  std::array<int, 3> component_{};  ///< where x, y, z stand in a line
  std::vector<ShellSplit> splits_;  ///< per shape
  std::vector<Chain> chains_;
  std::vector<LocalIndex> places_;
  std::vector<Run> runs_;
  std::vector<Transfer> loads_;
  std::vector<Transfer> stores_;
  int line_stride_ = 0;
  /// Lines of shape (12, line_stride): displacement, force. Work space of `apply`.
  mutable LaneArray buffer_;
  mutable LaneArray range_;  ///< forces of the range that is being handed over
};

}  // namespace pounding::stiffness
