#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "laws/law_of.h"
#include "mesh/global_mesh.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/linear_system.h"
#include "system/trace.h"

namespace pounding {

/// End of a link that is held in a component, or that the ground is under a node.
struct HeldEnd {
  LocalIndex node = 0;
  int component = 0;
  double weight = 0;    ///< in the elongation
  bool ground = false;  ///< it is the ground itself, at the place of the node
};

/// A link between two nodes, or from one to the ground. This rank owns those that can move.
struct Link {
  static constexpr std::size_t most_points = 6;
  /// Points in the trace of all links, -1 where the end is held: a bar has three of each end, soil
  /// up to six of its node.
  std::array<int, most_points> point;
  /// b: of each point in the elongation, that of the second end less that of the first [m, rad].
  std::array<double, most_points> weight{};
  std::vector<HeldEnd> held{};     ///< ends that may be on a support
  std::vector<double> supports{};  ///< elongation by them, per column of SupportShapes; or empty
  /// Force along it of a wave from below, per velocity of Step::incident [N s/m]; or empty.
  std::vector<double> incident{};
  interactions::LinkOrigin origin;
  std::int64_t number = 0;  ///< among the elements of its structure's file; its name in checkpoints

  Link() { point.fill(-1); }
};

/// Links of a structure: devices between two nodes, or from one to the ground, with a law that is
/// no part of K u. Today these are the bars that resist stretching only, compression-only springs
/// along z, springs that yield on a circle, the dashpots of springs, one for each component, and of
/// bars, the dashpots and masses of soil in the six motions of a mat, and three dashpots at every
/// node of absorbing faces. Springs and bars that yield by a law of e_n alone are none: see
/// InelasticElements. Links that share a node that can move live on one rank, with all that moves
/// with their nodes (see `coupled_nodes`). Constant during a run; their state is with
/// StructureLinks.
class Links {
 public:
  /// Null if the structure has no link. Throws std::logic_error if the nodes of one live on several
  /// ranks.
  static std::unique_ptr<Links> build(const Structure& structure, const Mesh& mesh);

  /// Once the system's mass is complete, and again once it is known how it follows its supports.
  void find_trace(const LinearSystem& system, const Mesh& mesh);

  const std::vector<Link>& links() const { return links_; }  ///< of this rank
  const Trace& trace() const { return *trace_; }
  const std::vector<LocalIndex>& dofs() const { return dofs_; }  ///< of the mesh, per point of it
  const std::vector<TracePoint>& points() const { return points_; }  ///< likewise, in file order
  /// A wave enters through some link of some rank.
  bool driven() const { return driven_; }

 private:
  Links() = default;
  /// Throws UserError where nothing states the pressure on a sliding bearing.
  void refuse_unpressed(const Structure& structure) const;
  void add_bar(const Structure& structure, const Mesh& mesh, const ElementBlock& block,
               std::size_t element);
  void add_springs(const Structure& structure, const Mesh& mesh, const ElementBlock& block,
                   std::size_t element);
  void add_soil(const Structure& structure, const Mesh& mesh, const ElementBlock& block,
                std::size_t element);
  void add_absorbing(const Mesh& mesh, const AbsorbingNode& absorbing);
  /// Keeps a link whose points are local dofs as yet, if this rank owns those that can move.
  void keep(const Mesh& mesh, const ElementBlock& block, std::size_t element, const Link& link);

  bool driven_ = false;
  std::vector<Link> links_;
  std::vector<LocalIndex> dofs_;    ///< per point of the trace, increasing
  std::vector<TracePoint> points_;  ///< per point of the trace
  std::unique_ptr<Trace> trace_;
};

/// Nodes of the beams of a reduced structure whose sections yield, each with its six components;
/// some more than once.
std::vector<TracePoint> section_points(const Structure& structure, const GlobalMesh& mesh);

/// Ends of the springs of waves in pools, along these; some more than once.
std::vector<TracePoint> wave_points(const Structure& structure, const GlobalMesh& mesh);

/// Nodes of a structure's links, and components along which these may pull; some more than once.
std::vector<TracePoint> link_points(const Structure& structure, const GlobalMesh& mesh);

}  // namespace pounding
