#pragma once

namespace pounding::stiffness {

/// Forms of the element-wise product that serve its speed alone: without any of them it is the same
/// to round-off. All are in use; only who measures what one earns leaves it out.
struct ProductForms {
  bool bricks = true;      ///< boxes in rows, split by their mid-planes; else by their strains
  bool rectangles = true;  ///< rectangular shells likewise
  bool strains = true;     ///< elements of general shape by their strains; else sparse rows
  bool beams = true;       ///< from their local stiffnesses; else sparse rows
  // Bricks and rectangles in rows:
  bool best_axis = true;  ///< rows along the axis that takes least time; else along axis 0
  bool hand_over = true;  ///< a chain that is alone hands its forces over; else with the last
  // Bricks in rows:
  bool best_thickness = true;  ///< pairs along the better axis; else along the one after the next
  bool both_sides = true;      ///< bricks before and behind a pair in one step
  bool lent_lines = true;      ///< chains of a pair that is alone lend it their lines
  bool row_pairs = true;       ///< two rows of such a pair are loaded as sums and differences
  bool rows = true;            ///< dofs that follow each other move in vectors; else node by node
  bool part_cores = true;      ///< they do where some nodes of the chain move otherwise
  bool set_behind = true;      ///< the first forces on a pair are set, not added to zeros
  bool set_joins = true;       ///< the first forces on a chain likewise
  // Rectangles in rows:
  bool shell_vectors = true;  ///< nodes with six dofs move in vectors
};

}  // namespace pounding::stiffness
