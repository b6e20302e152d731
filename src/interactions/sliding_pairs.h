#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/saved_state.h"
#include "interactions/contact_operator.h"
#include "interactions/pairing/interface.h"

namespace pounding::interactions {

/// Pairs that are found anew as faces slide along each other. A node that has moved along its facet
/// by a tenth of it since its pair was found meets the facet that lies before it now, on the line
/// along its normal through the displaced nodes; where there is none the row stays open. Normals
/// stay those of the initial geometry.
///
/// Every rank of the interface holds the same and decides alike from the gathered displacements.
/// Not collective; the search allocates.
class SlidingPairs {
 public:
  /// Part of a facet by which a node slides before its pair is found anew.
  static constexpr double limit = 0.1;
  /// Most calls of find() for one look at all rows, and the longest time for it [s]: a node moves
  /// by little in so many steps and in so short a time.
  static constexpr int most_calls = 16;
  static constexpr double longest_time = 1e-3;

  /// Terms of all dofs that pairs may come to have, for a ContactOperator.
  static std::vector<ConstraintTerm> all_terms(const SlidingFaces& faces);

  /// `contact` must have columns for all_terms().
  SlidingPairs(const ContactOperator& contact, const Interface& interface);

  bool any() const { return !faces_.rows.empty(); }
  /// One call of find() in each step of so long [s].
  void set_time_step(double time_step);
  /// Looks at all rows, once in some calls; true if some were paired anew: their new terms and
  /// gaps are in `rows`, a list of all constraints. `displacement` per dof of the operator.
  bool find(std::span<const double> displacement, std::span<Constraint> rows);
  /// Also puts pairs that are brought back into `rows`, as find() does.
  void keep(const StateKeeper& state, std::span<Constraint> rows);

 private:
  struct Pair {
    int facet = 0;                    ///< into the facets
    std::array<double, 4> weights{};  ///< of its nodes
    Vector3 slip{};                   ///< relative displacement when it was found [m]
    bool open = true;                 ///< nothing is faced; the slip is still measured by the facet
  };
  Vector3 displacement_of(int node, std::span<const double> displacement) const;
  /// Displacement of a row's node beside that of the place that it faces.
  Vector3 relative(std::size_t row, const Pair& pair, std::span<const double> displacement) const;
  /// How far along its facet a node has slid since its pair was found, over the facet's size.
  double slid(std::size_t row, std::span<const double> displacement) const;
  void pair(std::size_t row, std::span<const double> displacement);
  void put(std::size_t row, std::span<Constraint> rows) const;

  SlidingFaces faces_;
  std::vector<std::array<int, 3>> columns_;  ///< per node, in the operator; -1: clamped
  std::vector<Pair> pairs_;                  ///< per row
  std::vector<char> changed_;                ///< per row: not the pair of the initial geometry
  int stride_ = 1;                           ///< calls of find() for one look
  int calls_ = 0;                            ///< of find(), since the last look
};

}  // namespace pounding::interactions
