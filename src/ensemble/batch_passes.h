#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ensemble/coordinate_rows.h"
#include "ensemble/member_scene.h"
#include "mesh/mesh.h"
#include "observers/member_result.h"
#include "observers/run_statistics.h"

namespace pounding {

/// Some rows over the coordinates of structures that are stepped in batches.
class BatchRows {
 public:
  /// The arguments are read here only; `systems` of any of the runs, `columns`: number of those of
  /// the supports' motion.
  BatchRows(std::span<const interactions::Constraint> rows, std::span<const LinearSystem> systems,
            std::span<const Mesh> meshes, std::size_t columns);
  std::size_t size() const { return products_.size(); }
  /// sums += the rows times the displacements of coordinates and supports.
  void add_to(std::vector<BatchValue>& sums, std::span<const StatesOfRuns> states,
              const std::vector<BatchValue>& supports);
  /// Value of a row in one run at rest.
  double at_rest(std::size_t row, std::span<const LinearSystem> systems) const;

 private:
  std::vector<CoordinateRows> of_structures_;
  std::vector<double> carried_;  ///< by supports, shape (rows, columns); or empty
  std::vector<BatchValue> products_;
};

/// Looks in eight runs how far nodes of primaries go into secondaries in passes that are not taken,
/// and how far pairs move, as often as a single run does.
class BatchPasses {
 public:
  /// `scenes` and `models`: per member, `models` with the gaps at the start. The arguments are read
  /// here only.
  BatchPasses(std::span<const MemberScene* const> scenes, std::span<const Model> models,
              std::span<const Mesh> meshes);

  bool due(std::int64_t step) const { return moving_.size() > 0 && step % stride_ == 0; }
  /// `supports`: their displacements, per column.
  void look(std::span<const StatesOfRuns> states, const std::vector<BatchValue>& supports,
            std::int64_t step, double time);
  void fill(std::size_t member, MemberResult& result) const;

 private:
  BatchRows watched_;
  BatchRows moving_;              ///< three for each pair
  std::vector<BatchValue> gaps_;  ///< per row that is watched, unloaded [m]
  std::vector<int> contact_;      ///< per row that is watched
  std::vector<BatchValue> openings_;
  std::vector<BatchValue> start_;    ///< per moving row, of the rest with its sign turned [m]
  std::vector<BatchValue> moved_;    ///< since then
  std::vector<BatchValue> largest_;  ///< without signs
  std::vector<std::array<OtherPass, batch_size>> deepest_;        ///< per contact
  std::vector<std::array<std::size_t, batch_size>> deepest_row_;  ///< and where
  std::int64_t stride_ = 1;
};

}  // namespace pounding
