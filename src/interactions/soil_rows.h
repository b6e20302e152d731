#pragma once

#include <cstddef>
#include <span>

#include <mpi.h>

#include "interactions/law_rows.h"
#include "interactions/pairing/interface.h"
#include "system/linear_system.h"

namespace pounding::interactions {

/// Rows of an interface's soil between mats, with their elongations and impulses. Collective over
/// `comm`.
CoupledRows make_soil_rows(MPI_Comm comm, const Interface& interface,
                           std::span<const LinearSystem> systems, std::span<const Mesh> meshes);

/// Soil that mats of several structures share (SoilRow), but for the springs of each mat, which its
/// structure has in K: springs between mats pull by e_n, dashpots, masses and hidden motions
/// (SoilLaw) are solved for together, the hidden motions known with the gather of the next step.
/// Supports move all ground of a structure, with which its u and the soil under it go, so that no
/// support works on these rows.
class SoilRows final : public LawRows<CoupledRows> {
 public:
  /// References must outlive this object. Collective over `comm`.
  SoilRows(MPI_Comm comm, const Interface& interface, std::span<const LinearSystem> systems,
           std::span<const Mesh> meshes, double time_step);

  void begin(const Step& step) override;
  void push(const Step& step) override;
  void finish(const Step& step) override;
  void keep(const StateKeeper& state) override;

  /// N_n of a row of the interface's soil in the step just made [N, N m]; 0 but on members.
  double force(std::size_t row) const { return force_[row]; }

 private:
  /// Closes the step before, `share` of one, with the rates that it ended with.
  void close_step_before(double share);

  double loss_ = 0;  ///< of the step before [J]
};

}  // namespace pounding::interactions
