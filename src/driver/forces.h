#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/saved_state.h"
#include "driver/model.h"
#include "driver/solver.h"
#include "driver/total_forces.h"
#include "scene/scene.h"
#include "system/element_forces.h"

namespace pounding {

/// The value of a force that was largest in magnitude, and when.
struct ForcePeak {
  double value = 0;  ///< [N, N m], of shells per length [N/m, N]
  double time = 0;   ///< [s]
};

/// Peaks of an item of the option `forces`.
struct ForceReport {
  std::string name;
  std::vector<std::string> components;  ///< "Fx", "N", ...
  std::vector<std::string> elements;    ///< numbers in the file; one empty name of a total
  std::vector<ForcePeak> peaks;         ///< shape (elements, components)
  std::optional<Vector3> about{};       ///< of a total: point that its moments are about [m]

  /// The element whose peak of a component is the largest.
  std::size_t largest(std::size_t component) const;
};

/// Forces that the scene wants recorded: totals and those of elements, at the instants of the
/// samples. Names of columns: "base.Fx", "columns.17.My1". Each rank adds up its part, rank 0 gets
/// the sums, so that a sample has one message more. Peaks count samples from `peaks_start` on.
class Forces {
 public:
  /// References must outlive this object. Throws UserError for what has no such forces. Collective.
  Forces(MPI_Comm comm, const Scene& scene, const Model& model);

  /// Columns with a history, which are the first; the same on all ranks.
  const std::vector<std::string>& recorded() const { return recorded_; }
  /// Their unit, in words.
  const std::string& unit() const { return unit_; }

  /// Tells the stepper whose forces are asked for. Before the first step. Local.
  void watch(CdLagrange& stepper) const;
  /// Before the step to t_n that is sampled, which is asked for forces. Local.
  void begin(const State& state);
  /// After it; on rank 0 `values` has the columns with a history then. Collective.
  void end(const Solver& solver);
  std::span<const double> values() const { return {columns_.data(), recorded_.size()}; }

  /// Peaks so far, of rank 0. A continued run may count them from another time on where none that
  /// counted before it belongs to them: `load`, after the state is there, throws UserError
  /// otherwise, on every rank alike.
  void save(SavedState& saved) const;
  void load(const SavedState& saved, double time);

  /// Per item; complete on rank 0.
  std::vector<ForceReport> report() const;

 private:
  struct Item {
    std::string name;
    std::vector<std::string> components;
    std::vector<std::string> elements;
    std::optional<Vector3> about{};  ///< of the moments of a total [m]
    std::size_t first = 0;           ///< of its columns
    std::size_t columns() const { return components.size() * elements.size(); }
  };
  struct Total {
    std::size_t structure = 0;
    std::size_t first = 0;
    std::unique_ptr<TotalForce> force;
  };
  /// Elements of a structure whose forces are asked for.
  struct Elements {
    std::size_t structure = 0;
    std::unique_ptr<ElementForces> forces;
  };
  void lay_out(const Scene& scene, const Model& model);

  MPI_Comm comm_;
  double peaks_start_;
  std::vector<Item> items_;
  std::vector<std::string> recorded_;
  std::string unit_ = "N, N m";
  std::vector<Total> totals_;
  std::vector<Elements> elements_;
  std::vector<double> part_;     ///< of this rank, per column
  std::vector<double> columns_;  ///< sums, rank 0
  std::vector<ForcePeak> peaks_;
};

/// `forces.csv`: the peak of every component of every element, of `digits` significant digits.
/// Throws UserError if it cannot be written.
void write_forces(const std::string& path, std::span<const ForceReport> reports, int digits);

/// The table of the console.
void print_forces(std::span<const ForceReport> reports);

}  // namespace pounding
