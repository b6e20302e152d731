#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <mpi.h>

#include "interactions/law_rows.h"
#include "interactions/pairing/interface.h"
#include "laws/tension_law.h"
#include "scene/scene.h"
#include "system/linear_system.h"

namespace pounding::interactions {

/// The pairs of contacts with fillers as rows of their own, L u of their gaps: how far each filler
/// is compressed, how fast, and the impulses by which it presses the sides apart.
class FillerPairs : public CoupledRows {
 public:
  static constexpr double sense = -1;

  /// Collective over `comm`.
  FillerPairs(MPI_Comm comm, const Interface& interface, std::span<const LinearSystem> systems,
              std::span<const Mesh> meshes);

  struct Pair {
    int contact = 0;      ///< index into the scene's contacts
    std::size_t row = 0;  ///< among the constraints of the interface
    FillerPart part;      ///< its clearance that of the state at rest, where the run starts from it
    std::array<double, 2> place{};  ///< on the tangent axes of the contact [m]
  };
  const std::vector<Pair>& all() const { return pairs_; }

  /// Compression d [m] and its rate [m/s] per pair, see CoupledRows. Members only, collective over
  /// them.
  void gather(std::span<double> compression, std::span<double> rate);

 private:
  void count_from_rest(std::span<const LinearSystem> systems);

  std::vector<Pair> pairs_;
};

/// Largest load of the filler of a contact, of the strip of its faces that is crushed, or of the
/// springs of a stop, and its loss.
struct FillerTotals {
  double peak_pressure = 0;               ///< of a pair [Pa]
  double peak_force = 0;                  ///< of all pairs together [N]
  double crushed_strain = 0;              ///< largest that stays, of a pair [-]
  double loss = 0;                        ///< energy that it took and did not keep [J]
  double crushed_depth = 0;               ///< largest that stays, of a pair [m]
  std::array<double, 2> crushed_place{};  ///< of that pair, on the tangent axes [m]
};

/// Fillers of all contacts, pair by pair: between the step of the structures without them and
/// contact, by their forces (FillerLaw).
class FillerRows final : public LawRows<FillerPairs> {
 public:
  /// `contacts` of the scene. References must outlive this object. Collective over `comm`.
  FillerRows(MPI_Comm comm, const Interface& interface, std::span<const Contact> contacts,
             std::span<const LinearSystem> systems, std::span<const Mesh> meshes, double time_step);
  ~FillerRows() override;

  void begin(const Step& step) override;
  void push(const Step& step) override;
  void finish(const Step& step) override;
  void keep(const StateKeeper& state) override;

  /// A stop or a strip that is crushed presses in the step just made, or lost energy in the one
  /// before; members only.
  bool strikes() const;
  /// Adds, per row of the interface, the impulses of stops and strips in the step just made [N s],
  /// and takes off their loss in the one before from the works [J]. Members only.
  void add_strikes(std::span<double> impulses, std::span<double> works) const;
  /// Per contact of the scene; members only.
  const std::vector<FillerTotals>& totals() const { return totals_; }
  const FillerPairs& pairs() const { return rows_; }
  /// Records some rows from now on, on members. Their work comes with the step after.
  void record(std::vector<std::size_t> rows) { records_.watch(std::move(rows), true); }
  const LinkRecords& records() const { return records_; }

 private:
  /// Closes the step before with the rates that it ended with.
  void close_step_before();
  void note_peaks();
  std::vector<std::string> record_names() const;

  std::vector<double> row_loss_;  ///< of the step before [J]
  double support_input_ = 0;      ///< work of supports against the fillers [J]
  double loss_ = 0;               ///< of the step before, of stops [J]
  double plastic_loss_ = 0;       ///< likewise, of crushing
  double duration_ = 0;           ///< of the forces in the step just made [s]
  std::vector<FillerTotals> totals_;
  std::vector<double> contact_force_;  ///< per contact
  LinkRecords records_;
};

}  // namespace pounding::interactions
