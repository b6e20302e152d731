#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "common/types.h"

namespace pounding::stiffness {

/// Argument of a stiffness, w = u + beta v over the owned dofs; formed where it is read. `Number`:
/// double, or that of several products at once.
template <typename Number>
struct ArgumentOf {
  const Number* displacement = nullptr;  ///< u [m, rad]
  const Number* velocity = nullptr;      ///< v [m/s, rad/s]
  Number beta{};                         ///< [s]
  /// A translation [m] that elements which do not feel it may take off first: what is left of a
  /// body far from where it started has more digits.
  std::array<double, 3> origin{};

  Number operator[](std::size_t dof) const { return displacement[dof] + beta * velocity[dof]; }
  Number operator[](LocalIndex dof) const { return displacement[dof] + beta * velocity[dof]; }
};
using StiffnessArgument = ArgumentOf<double>;

/// Owned dofs that follow each other.
struct DofRange {
  LocalIndex begin = 0;
  LocalIndex end = 0;
  bool empty() const { return begin >= end; }
};

/// Takes a product K w range by range, while it is in the nearest cache. `Number`: double, or that
/// of several products at once.
template <typename Number>
class ReceiverOf {
 public:
  virtual ~ReceiverOf() = default;
  /// Forces of the owned dofs [begin, end) are final, force[0] being that of `begin`; nothing reads
  /// u and v of these dofs any more, so the receiver may change them. Ranges hold whole nodes and
  /// come in a fixed order, each owned dof once per product.
  virtual void receive(LocalIndex begin, LocalIndex end, const Number* force) = 0;
};
using ForceReceiver = ReceiverOf<double>;

/// Keeps a product in an array over the owned dofs, which must outlive this object.
template <typename Number>
class StoredForces final : public ReceiverOf<Number> {
 public:
  explicit StoredForces(Number* product) : product_(product) {}
  void receive(LocalIndex begin, LocalIndex end, const Number* force) override {
    std::copy(force, force + (end - begin), product_ + begin);
  }

 private:
  Number* product_;
};

/// Where the value of a dof stands: owned dofs in an array of their own, ghosts in another. A slot
/// below owned_dofs is an owned dof; owned_dofs + i is ghost value i; -1 is a clamped component.
struct DofSlots {
  LocalIndex owned_dofs = 0;
  std::vector<LocalIndex> of_dof;                  ///< per local dof, owned then ghost
  std::vector<std::array<LocalIndex, 6>> of_node;  ///< per local node: its components
  std::vector<LocalIndex> node_end;                ///< per owned node: one beyond its last dof
};

/// Value at a slot; 0 at -1. `owned` is indexed by dof.
template <typename Values>
inline double value_at(LocalIndex slot, LocalIndex owned_dofs, const Values& owned,
                       const double* ghosts) {
  if (slot < 0) return 0;
  return slot < owned_dofs ? owned[slot] : ghosts[slot - owned_dofs];
}

/// The product of elements in rows, of one kind and one frame. It visits chains of nodes in the
/// order of the mesh's numbering and keeps those in use in a small buffer, so that w is read and q
/// written once. The forces of a chain whose dofs nothing else touches later need not go to q: they
/// are handed over.
class ElementLines {
 public:
  virtual ~ElementLines() = default;

  /// Chains in the order in which `apply` is done with them.
  virtual std::size_t chain_count() const = 0;
  /// Owned dofs of a chain to which the elements add.
  virtual std::vector<LocalIndex> chain_dofs(std::size_t chain) const = 0;
  /// All dofs of the chain's nodes, those included to which the elements do not add, if they are
  /// owned and follow each other; else an empty range.
  virtual DofRange chain_range(std::size_t chain) const = 0;
  /// Decides for every chain whether its forces, final as they are, are handed over and not added
  /// to q; only for those with a range. Call once.
  virtual void set_handed_over(const std::vector<char>& handed_over) = 0;

  /// q += K w on the owned dofs that these elements touch, but for forces that are handed over.
  /// Allocates nothing.
  virtual void apply(const StiffnessArgument& w, const double* ghosts, double* q,
                     ForceReceiver& receiver) const = 0;
};

/// Ways of the element-wise product for elements of some kind: without any of them it is the same
/// to round-off. All are in use; tests leave them out.
struct ProductForms {
  bool bricks = true;      ///< boxes in rows, split by their mid-planes; else by their strains
  bool rectangles = true;  ///< rectangular shells likewise
  bool strains = true;     ///< elements of general shape by their strains; else sparse rows
  bool beams = true;       ///< from their local stiffnesses; else sparse rows
};

/// How many elements of a structure, over all ranks, are applied in which way.
struct ElementKinds {
  GlobalIndex bricks = 0;      ///< split by their mid-planes, in rows
  GlobalIndex rectangles = 0;  ///< shells likewise
  GlobalIndex general = 0;     ///< other hexahedra, quadrangles, triangles, by their strains
  GlobalIndex single = 0;      ///< of these, by numbers in 32 bits
  GlobalIndex skew = 0;        ///< hexahedra in 64 bits among these, not extruded along an axis
  GlobalIndex beams = 0;       ///< from their local stiffnesses
  GlobalIndex other = 0;       ///< in a sparse matrix
};

}  // namespace pounding::stiffness
