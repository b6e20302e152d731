#pragma once

#include <memory>
#include <span>
#include <vector>

#include "interactions/dashpot_modes.h"
#include "interactions/structure_links.h"

namespace pounding::interactions {

/// The links of a structure in generalised coordinates where all of them are dashpots: braked
/// together in their modes (DashpotModes). Local.
class ModalDashpots final : public StructureLinks {
 public:
  /// All links of a system are dashpots that no wave drives and no support carries.
  static bool are_all_links(const LinearSystem& system);

  ModalDashpots(const LinearSystem& system, std::size_t structure, double time_step);

  void begin(const Step& step) override;
  void push(const Step& step) override;
  void finish(const Step& step) override;
  double force(std::size_t link) const override;

 private:
  DashpotModes make_modes(const LinearSystem& system) const;

  DashpotModes modes_;
  std::vector<double> force_;
  std::vector<double> before_;  ///< e_{n-1} less e_n, of all links
  std::vector<double> after_;   ///< (e_{n+1} - e_{n-1}) / 2
};

}  // namespace pounding::interactions
