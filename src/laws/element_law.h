#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace pounding::interactions {

/// One of the laws in one dimension that an element follows, as it is in a memory.
struct PartState {
  double elongation = 0;  ///< [m, rad], of a shell its shear strain
  double force = 0;       ///< [N, N m], of a shell its shear stress [Pa]
  double ductility = 0;   ///< largest elongation over that of its first corner
  double lost = 0;        ///< energy [J]
  double taken = 0;       ///< lost and held [J]
  double damage = 0;      ///< of a shell that cracks, d / (1 + d) of the worse face
};

/// Law of the nodal forces of elements that yield or break, as a function of their displacements
/// and of a history: g_n beside the elastic force K u_n, which the structure's K gives. Its secant
/// energy is that of an elastic element about its losses: with f_n = K u_n + g_n and this
/// B^T s(e_n - p_n), element and step hold together
///
///     E_{n+1/2} = 1/2 f_n . u_{n+1} - W_n,      W_n = 1/2 s . p_n less what hardening keeps
///
/// which for a linear element is 1/2 u_{n+1}^T K u_n, and a step in which p stays loses nothing.
/// The tangent of f stays below K, so that the stable step is that of the elastic structure. Pure
/// functions: no MPI, no PETSc.
class ElementLaw {
 public:
  struct Response {
    double offset = 0;    ///< W_n [J]
    bool acts = false;    ///< whether any force was added
    bool yields = false;  ///< whether it left its straight line
  };

  virtual ~ElementLaw() = default;

  /// Numbers of the history of one element.
  virtual std::size_t memory_size() const = 0;
  /// Whether the displacement of a dof of an element counts, and a force of the law may act there.
  virtual bool acts_on(std::size_t /*element*/, std::size_t /*dof*/) const { return true; }
  /// Brings the history of an element to its displacements u_n [m, rad] and adds the forces g_n
  /// [N, N m] with which it resists beside K u_n, both node by node, component by component.
  /// `element`: its number among those that this rank has of the region, block by block.
  virtual Response respond(std::size_t element, std::span<const double> displacement,
                           std::span<double> memory, std::span<double> force) const = 0;

  /// Adds `factor` times the stiffness of an element on its first line to a matrix over its dofs,
  /// where K holds nothing of it.
  virtual void add_tangent(std::size_t /*element*/, double /*factor*/,
                           std::span<double> /*matrix*/) const {}

  /// Names of its laws in one dimension, "shear_y" say, the same of every element; none where it
  /// has no such parts.
  virtual std::vector<std::string> parts() const { return {}; }
  /// Ductility of one of them, that of its PartState.
  virtual double ductility(std::size_t element, std::size_t number,
                           std::span<const double> memory) const {
    return part(element, number, memory).ductility;
  }
  /// One of them in the memory of an element.
  virtual PartState part(std::size_t /*element*/, std::size_t /*number*/,
                         std::span<const double> /*memory*/) const {
    return {};
  }
};

/// Law of the elements of a region.
struct RegionLaw {
  int region = 0;  ///< its number in the structure
  std::shared_ptr<const ElementLaw> law;
  /// No damping of K acts on it: springs and bars, which the K of a step does not hold, and every
  /// law of a reduced structure, whose modes hold it as elastic.
  bool apart = false;
};

}  // namespace pounding::interactions
