#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "system/block_factorisation.h"

namespace pounding {

/// Added mass of water on the nodes that it wets, all of one rank. With p the pressures of wetted
/// nodes, A the Laplacian on these, all others condensed, a_i the area of the water's faces at a
/// node, out of the water, and N u = (a_i . u_i),
///
///     f = N^T p,    A p = -rho N u'',    so that    S = rho N^T A^-1 N
///
/// Y has the columns M^-1/2 N_i^T / D_i^1/2, D_i = N_i M^-1 N_i^T, orthonormal since a node has one
/// pressure; where D_i is 0 a pressure moves nothing and is condensed as well. With them
///
///     S = M^1/2 Y P Y^T M^1/2,    P = rho D^1/2 A^-1 D^1/2,    H = P (I + P)^-1
///     (M + S)^-1 = M^-1/2 (I - Y H Y^T) M^-1/2,    I - H = T T^T
///
/// H is kept by tiles of neighbouring nodes, as products of low rank where these lie apart and know
/// little of each other; it is good to `tile_error`, and P and T are those of H as it is kept.
///
/// Fields have six places per node, in the order of the node's dofs. Products allocate nothing and
/// are the same bits on every run.
class AddedMass {
 public:
  static constexpr std::size_t width = BlockFactorisation::width;
  static constexpr double tile_error = 1e-9;

  /// `lumped_mass` of all owned dofs [kg, kg m2]. Without nodes where the water moves none of this
  /// rank. Throws UserError without memory for full matrices of the wetted nodes.
  AddedMass(const Mesh& mesh, const WaterBody& water, std::span<const double> lumped_mass);

  const std::vector<NodeDofs>& nodes() const { return nodes_; }  ///< in the order of fields
  /// Force of the pressures on the first three dofs of each node where the ground, and all that
  /// the water wets with it, is accelerated by -1 along a direction [kg].
  const std::vector<Vector3>& ground_force(std::size_t d) const { return ground_force_[d]; }

  /// Forces to changes of velocity: x = (M + S)^-1 x.
  void solve(double* x) const;
  /// x = G^-1 x and x = G^-T x with (M + S)^-1 = G^-T G^-1, G^-T = M^-1/2 F, F = I + Y (T - I) Y^T.
  void solve_half(double* x) const;
  void solve_transposed_half(double* x) const;
  /// v^T S v of a vector over the owned dofs.
  double added_product(const double* v) const;

  /// An entry by owned dofs.
  struct Entry {
    LocalIndex row = 0, column = 0;
    double value = 0;
  };
  std::vector<Entry> mass_entries() const;  ///< of S
  std::vector<Entry> half_entries() const;  ///< of F - I

 private:
  /// Block of H: full, `left` by rows, or left^T right.
  struct Tile {
    std::size_t row = 0, rows = 0, column = 0, columns = 0;
    bool full = true;
    std::size_t rank = 0;
    std::vector<double> left;   ///< (rows, columns), or (rank, rows)
    std::vector<double> right;  ///< (rank, columns)

    /// Makes it a product where that is shorter, of crosses through the largest entries left.
    void shorten();
  };

  void find_nodes(const Mesh& mesh, const WaterBody& water, std::span<const double> lumped_mass);
  void sort_nodes(std::span<const Vector3> place, std::size_t first, std::size_t end);
  void add_node(const Mesh& mesh, const WaterBody& water, std::span<const double> lumped_mass,
                std::size_t k);
  void find_ground_force(const WaterBody& water, const std::vector<double>& response);
  void keep_tiles(const std::vector<double>& h);
  std::vector<double> rest() const;                 ///< I - H of H as it is kept, (n, n)
  void collect(const double* x, double* q) const;   ///< q = Y^T x
  void spread(const double* q, double* x) const;    ///< x += Y q
  void scale(double* x) const;                      ///< x = M^-1/2 x
  void multiply(const double* q, double* t) const;  ///< t = H q
  /// Y B Y^T between two scalings by `scaling` of each place.
  std::vector<Entry> entries_of(const std::vector<double>& b,
                                const std::vector<double>& scaling) const;

  std::vector<std::size_t> wetted_;  ///< of the water's wetted nodes those that move, in order
  std::vector<std::size_t> begin_;   ///< of the clusters of these, and the end
  std::vector<NodeDofs> nodes_;
  std::vector<Vector3> unit_;      ///< of Y, at the first three dofs of each node
  std::vector<double> weight_;     ///< D^1/2 per node
  std::vector<double> root_mass_;  ///< M^1/2 per place of a field; 1 where there is no dof
  std::vector<double> inverse_root_mass_;
  std::vector<Tile> tiles_;
  std::vector<double> root_;  ///< T, (n, n) by rows
  std::array<std::vector<Vector3>, 3> ground_force_;
  mutable std::vector<double> from_, to_, part_;  ///< scratch of products
};

}  // namespace pounding
