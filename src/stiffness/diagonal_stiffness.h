#pragma once

#include <vector>

#include "stiffness/stiffness.h"

namespace pounding::stiffness {

/// K as a diagonal: omega^2 of generalised coordinates whose basis is orthonormal in M. Nothing is
/// exchanged between ranks.
class DiagonalStiffness final : public Stiffness {
 public:
  /// `diagonal` of the owned dofs. Collective over `comm`.
  DiagonalStiffness(MPI_Comm comm, std::vector<double> diagonal);
  using Stiffness::apply;
  void start(const StiffnessArgument&) const override {}
  void finish(const StiffnessArgument& w, ForceReceiver& receiver) const override;
  void apply(Vec w, Vec q) const override;
  Mat matrix() const override { return matrix_.get(); }

 private:
  std::vector<double> diagonal_;
  mutable std::vector<double> force_;
  MatHandle matrix_;
};

}  // namespace pounding::stiffness
