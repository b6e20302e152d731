#pragma once

/// Costs that were measured on one machine and decide about speed only, never about results. About
/// nanoseconds of a step on a core; their ratios matter, to within a factor of two. Of an element:
/// `mpirun -n 1 build/pounding -options_file SCENE -dry_run` prints the microseconds of a step;
/// that of a slab or a frame of one kind, over its number of elements, is the cost of one with its
/// share of the nodes. Of products: `run/benchmark --shapes` compares those by elements with those
/// of assembled matrices. Of cuts: `run/scaling` compares ranks.
namespace pounding::measured_costs {

/// One element in a step, its share of the nodes included.
inline constexpr int brick = 18;          ///< hexahedron in rows
inline constexpr int rectangle = 20;      ///< quadrangle of a shell in rows
inline constexpr int triangle = 20;       ///< of a shell, by its strains
inline constexpr int sparse_wedge6 = 45;  ///< wedge in a sparse matrix
inline constexpr int sparse_tet4 = 12;    ///< tetrahedron in a sparse matrix
inline constexpr int beam = 14;           ///< from its local stiffness
inline constexpr int small = 2;           ///< bars, springs, points
inline constexpr int extruded = 20;       ///< hexahedron extruded along an axis, by its strains
inline constexpr int skew = 45;           ///< hexahedron of any other shape
inline constexpr int inelastic = 60;      ///< a law in one dimension beside its stiffness

/// A node of a cluster: its part in a solution instead of a division. Of shells and solids, whose
/// factor fills in more, from a scene whose elements are all scaled beside the same unscaled: 86
/// and 145 in squares of 121 and 441 nodes, 190 and 590 in cubes of 125 and 512.
inline constexpr int cluster_node = 36;  ///< of beams, bars, springs
inline constexpr int cluster_node_of_shells = 120;
inline constexpr int cluster_node_of_solids = 400;

/// Ranks that share a structure and wait for each other's values, per structure: on the two-storey
/// pair and 2 ranks, the loss by the even cut.
inline constexpr double sharing = 4000;

/// Cutting a contact costs messages whenever the interface is looked at: more than a cut between
/// two elements, which weighs their shared nodes.
inline constexpr int contact_cut = 64;

/// One element in so many has to have a kernel of its own for the product by elements to be taken:
/// those without cost somewhat more in its rows than in an assembled matrix, beams a third to a
/// fifth of that, the others a fifth or less.
inline constexpr int elements_per_kernel = 4;

}  // namespace pounding::measured_costs
