#pragma once

#include <span>
#include <vector>

#include "common/saved_state.h"
#include "interactions/contact_operator.h"
#include "interactions/interface_gather.h"
#include "interactions/pairing/interface.h"
#include "system/linear_system.h"
#include "system/trace.h"

namespace pounding::interactions {

/// How far the two sides of a contact have slid along each other.
struct Slide {
  double distance = 0;    ///< of the pair that slid farthest beside the size of its facet [m]
  double facet_size = 0;  ///< of that pair's facet; 0: a wall, endless [m]
  double since = -1;      ///< when a pair was first seen beyond `limit` [s]; below 0: none was

  /// Part of a facet beyond which a node may face another one, or none.
  static constexpr double limit = 0.5;
};

/// Pairs are found once, in the initial geometry. This keeps how far each node has moved along the
/// facet that it faces, whether they touch or not. It reads displacements and changes nothing;
/// nothing allocates after construction.
class SlideWatch {
 public:
  /// `contacts`: their number. Collective over `comm`.
  SlideWatch(MPI_Comm comm, const Interface& interface, std::span<const LinearSystem> systems,
             std::span<const Mesh> meshes, int contacts);

  /// This rank takes part in looks.
  bool member() const { return gather_.member(); }
  /// u over the owned dofs of a structure; `supports`: that of the supports, see Trace::apply.
  void set_displacement(std::size_t structure, const double* displacement,
                        std::span<const double> supports = {});
  /// Looks at all pairs at a time [s]. Members only, collective over them.
  void look(double time);

  /// Per contact; members only.
  const std::vector<Slide>& slides() const { return slides_; }
  /// The lowest member.
  int root() const { return gather_.root(); }

  void save(SavedState& saved) const;
  void load(const SavedState& saved);

 private:
  ContactOperator operator_;
  std::vector<Trace> traces_;             ///< per structure
  std::vector<std::size_t> first_known_;  ///< per structure, into the values of this rank
  InterfaceGather gather_;
  std::vector<double> mine_;
  std::vector<double> displacement_;  ///< per dof of the operator
  std::vector<int> contact_;          ///< per constraint
  std::vector<double> facet_size_;    ///< per constraint [m]
  std::vector<Slide> slides_;
};

}  // namespace pounding::interactions
