#pragma once

/// Contact geometry: which secondary node faces which place of the primary face, along which
/// normal, at which initial gap.
///
/// Signs, for the whole program: the normal n points from the secondary side outwards, to the
/// primary. The gap is g = g0 + L u with L u = n . (u_primary - u_secondary); g > 0 is open. The
/// impulse lambda >= 0 [N s] is a compression; L^T lambda acts on the dofs, which pushes the
/// primary along +n and the secondary along -n.

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/matrix3.h"
#include "mesh/global_mesh.h"
#include "soil/impedance.h"

namespace pounding::interactions {

/// The parts of the faces of a scene along which pairs are found anew as they slide, as the meshes
/// are: rows of the interface, the facets that each may come to face and the nodes of both.
struct SlidingFaces {
  struct Node {
    int structure = 0;
    GlobalIndex node = 0;  ///< file order
    Vector3 position{};    ///< [m]
  };
  struct Facet {
    int count = 0;               ///< 3 or 4 nodes
    std::array<int, 4> nodes{};  ///< into `nodes`
    double half_thickness = 0;   ///< of a shell [m]
    double size = 0;             ///< side of a square of its area [m]
  };
  struct Row {
    int constraint = 0;
    int contact = 0;            ///< index into the scene's contacts
    int node = 0;               ///< secondary, into `nodes`
    Vector3 normal{};           ///< outward there, unit
    double half_thickness = 0;  ///< of a shell there [m]
    double depth = 0;           ///< how far behind it a facet may lie [m]
    double offset = 0;          ///< the gap given less that of the meshes [m]
    int first = 0;              ///< of the facets that it may face, into `candidates`
    int end = 0;
  };
  std::vector<Node> nodes;
  std::vector<Facet> facets;
  std::vector<Row> rows;
  std::vector<int> candidates;

  bool empty() const { return rows.empty(); }

  static void members(auto& self, auto& stream) {
    stream(self.nodes, self.facets, self.rows, self.candidates);
  }
};

/// One term of a constraint: coefficient times the displacement component of a node.
struct ConstraintTerm {
  int structure = 0;
  GlobalIndex node = 0;  ///< file order
  int component = 0;     ///< 0-2
  double coefficient = 0;
};

/// A rectangle in the plane of a face, lowest and highest along each of the tangent axes [m].
using Patch = std::array<std::array<double, 2>, 2>;

/// Filler of a joint at one pair of a contact, the strip of its faces that is crushed there, or the
/// spring of a stop that gives way.
struct FillerPart {
  double area = 0;       ///< [m2], of a spring 1; 0: there is none
  double thickness = 0;  ///< [m], of a spring 0
  double clearance = 0;  ///< by which the joint closes before it is pressed [m]
  double depth = 0;  ///< of a strip of the faces, beyond which contact is hard; 0: it is none [m]

  /// The row is no hard contact, however far it is pressed.
  bool is_spring() const { return area > 0 && thickness == 0; }
  /// The force is that of a strike of the contact.
  bool strikes() const { return is_spring() || depth > 0; }
};

/// One row of L with its initial gap.
struct Constraint {
  int contact = 0;  ///< index into the scene's contacts
  std::vector<ConstraintTerm> terms;
  double initial_gap = 0;         ///< of hard contact: until a filler is dense or a strip
                                  ///< crushed to the last [m]
  double geometric_gap = 0;       ///< of the meshes, between the surfaces of shells [m]
  double surveyed = 0;            ///< gap of a survey there, if the contact has one [m]
  double facet_size = 0;          ///< of the facet that it faces, or twice how far pairs may slide
                                  ///< where they are found anew; 0: a wall, endless [m]
  Vector3 at{};                   ///< secondary node [m]
  std::array<double, 2> place{};  ///< and on the tangent axes [m]
  std::array<double, 2> level{};  ///< and in the mean plane of the face, lengths kept [m]
  Patch patch{};                  ///< part of that plane that belongs to it
  /// Place on that face, from 0 to 1 along the tangent axes; of a row of a stop that acts the other
  /// way (1, 0), so that it has the second of two gaps.
  std::array<double, 2> share{};
  bool matched = false;  ///< faces one primary node exactly
  double friction = 0;   ///< Coulomb's coefficient [-]
  FillerPart filler;

  /// Gap of the faces where hard contact has `gap` [m].
  double of_faces(double gap) const { return gap - filler.depth; }

  static void members(auto& self, auto& stream) {
    stream(self.contact, self.terms, self.initial_gap, self.geometric_gap, self.surveyed,
           self.facet_size, self.at, self.place, self.level, self.patch, self.share, self.matched,
           self.friction, self.filler);
  }
};

/// Initial gap of a row that faces nothing yet [m].
constexpr double open_gap = 1e30;

/// Survey of a joint, as it lies on the face.
struct SurveyReport {
  int points = 0;       ///< 0: there is none
  int beyond = 0;       ///< pairs beyond the hull of the points
  double farthest = 0;  ///< how far that is at most [m]
  double mean_gap = 0;  ///< of the pairs at the start [m]
  Vector3 narrowest{};  ///< place of the pair with the smallest gap [m]

  static void members(auto& self, auto& stream) {
    stream(self.points, self.beyond, self.farthest, self.mean_gap, self.narrowest);
  }
};

/// Row of the soil that mats of several structures share, over the nodes that carry it: with the
/// elongation e of its terms it pulls by the law of the soil under a mat. One with a stiffness,
/// which may be negative, is a spring between mats and nothing else.
struct SoilRow {
  std::vector<ConstraintTerm> terms;
  Impedance impedance;

  static void members(auto& self, auto& stream) { stream(self.terms, self.impedance); }
};

/// Report of the pairs found for one contact.
struct InterfaceReport {
  std::string contact;
  int passes = 1;
  int pairs = 0;
  int matched = 0;
  int unmatched_nodes = 0;  ///< secondary nodes that face nothing
  double smallest_gap = 0;  ///< initial [m]
  double largest_gap = 0;
  std::array<double, 2> geometric_gap{};   ///< smallest and largest of the meshes, not
                                           ///< numbers for a wall [m]
  std::array<double, 2> half_thickness{};  ///< of the shells at the faces of the secondary and of
                                           ///< the primary, the largest [m]
  int overlapping = 0;                     ///< pairs whose initial gap is negative
  int carried = 0;                         ///< nodes without a row, which ties let follow others
                                           ///< of the face that have friction
  int left_behind = 0;                     ///< of the unmatched nodes, those with a facet too far
                                           ///< behind them
  double farthest_behind = 0;              ///< how far that is at most [m]
  int inner_facets = 0;                    ///< facets with elements on both of their sides
  Vector3 normal{0, 0, 0};                 ///< mean
  std::array<int, 2> tangent_axes{};       ///< global axes of `place`
  std::vector<int> patch_pairs;            ///< pairs in each patch of the gap
  SurveyReport survey;
  double filler_area = 0;                    ///< of all pairs [m2]; 0: no filler
  std::array<double, 2> filler_thickness{};  ///< smallest and largest [m]

  static void members(auto& self, auto& stream) {
    stream(self.contact, self.passes, self.pairs, self.matched, self.unmatched_nodes,
           self.smallest_gap, self.largest_gap, self.geometric_gap, self.half_thickness,
           self.overlapping, self.carried, self.left_behind, self.farthest_behind,
           self.inner_facets, self.normal, self.tangent_axes, self.patch_pairs, self.survey,
           self.filler_area, self.filler_thickness);
  }
};

struct Interface {
  std::vector<Constraint> constraints;  ///< in the order of the contacts, nodes in file order
  std::vector<InterfaceReport> reports;
  SlidingFaces sliding;
  std::vector<BoundingBox> extents;   ///< per structure
  double model_size = 0;              ///< largest extent of the scene [m]
  std::vector<std::string> warnings;  ///< doubts; rank 0 only
  /// Rows of second passes that are not taken: they never act, and a run looks how far nodes of the
  /// primary go into the secondary.
  std::vector<Constraint> watched;
  std::vector<SoilRow> soil;  ///< between mats; see find_soil_rows

  /// Members that every rank has: rows and extents.
  static void members(auto& self, auto& stream) {
    stream(self.constraints, self.watched, self.soil, self.sliding, self.extents, self.model_size);
  }
};

/// Whether some contact has a filler, a strip that is crushed, or a spring.
bool has_fillers(const Interface& interface);

/// Leaves out rows from `first` on that are there before: of two passes over nodes that face each
/// other. The report loses them.
void drop_repeated(std::size_t first, Interface& interface, InterfaceReport& report);

/// Facing nodes, for the partition.
std::vector<NodeLink> facing_nodes(const Interface& interface);

/// The outward normal of the secondary side of a constraint, whose terms are the last ones: a unit
/// vector.
Vector3 normal_of(const Constraint& constraint);

/// Global axes of the plane that is most nearly across a unit vector.
std::array<int, 2> axes_across(const Vector3& normal);

/// Two unit vectors across a unit vector and each other; axes for an axis.
std::array<Vector3, 2> tangents_of(const Vector3& normal);

/// Two rows per constraint: what L is for gap rates, for the displacements along two tangents, in
/// the order of the constraints, with the same weights.
std::vector<Constraint> tangential_rows(std::span<const Constraint> constraints);

/// Three rows per constraint, for the displacement of the primary relative to the secondary along
/// x, y and z, in the order of the constraints, with the same weights.
std::vector<Constraint> component_rows(std::span<const Constraint> constraints);

/// How far outside a facet, or deeper than its elements are, relative to its size, a node may lie
/// and still face it: shells in one plane lie as deep as they are thick.
constexpr double facet_tolerance = 1e-6;

/// Weights of a facet's nodes where those within 1e-6 of 0 are 0, and one within 1e-6 of 1 is the
/// node itself.
std::array<double, 4> snapped(std::array<double, 4> weights);

/// Adds a node to a constraint, with a weight along a normal.
void add_terms(int structure, GlobalIndex node, double weight, const Vector3& normal,
               Constraint& constraint);

}  // namespace pounding::interactions
