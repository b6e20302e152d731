#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <mpi.h>

#include "common/saved_state.h"
#include "dynamics/update.h"
#include "system/linear_system.h"

namespace pounding {

/// A step of one structure, as the rows of the ledger see it.
struct LedgerStep {
  const StepSums& sums;
  const LinearSystem& system;
  double time_step = 0;     ///< [s]
  double mass_damping = 0;  ///< alpha as the step has it [1/s]
  const std::array<double, 3>& ground_acceleration;
};

/// A row of the energy ledger: energy that left the structures or came to them since the start.
struct LedgerRow {
  using Work = void (*)(const LedgerStep& step, double& work);

  std::string_view name;  ///< column of energy.csv
  /// Key of summary.json; empty: the row is in no file, the watchdog alone looks at it.
  std::string_view key;
  int sign = 0;  ///< of the row in the identity: 1 taken, -1 given, 0 a part of another row
  Work add;      ///< adds the work of a step [J]
  /// Adds the part that counts of the first half step, before which the balance begins; or null.
  Work start = nullptr;
  double StepSums::*before = nullptr;  ///< of the step before, which came with this one
  /// Parts that can only take, of which this is the loss: a run in which they gave is stopped.
  std::string_view taker{};
  std::string_view sentence{};  ///< of the report, where the row is more than round-off
};

/// A number of the step, added as it is; or as a power summed over both ends of the step.
template <auto number>
void plain(const LedgerStep& step, double& work) {
  work += step.sums.*number;
}
template <auto number>
void mean_power(const LedgerStep& step, double& work) {
  work += step.time_step / 2 * step.sums.*number;
}

inline void damping_work(const LedgerStep& step, double& work) {
  work += step.time_step / 4 * step.mass_damping * step.sums.mass_sum;
  if (step.system.damping.beta != 0) work += step.time_step / 2 * step.sums.stiffness_work;
  work += step.sums.damping_loss;
}
inline void gravity_work(const LedgerStep& step, double& work) {
  for (std::size_t d = 0; d < 3; ++d) {
    const double momentum = step.sums.momentum[d] + step.sums.water_momentum[d];
    work += step.time_step / 2 * step.system.gravity[d] * momentum;
  }
}
inline void input_work(const LedgerStep& step, double& work) {
  for (std::size_t d = 0; d < 3; ++d) {
    const double pull = step.system.gravity[d] - step.ground_acceleration[d];
    work += step.time_step / 2 * pull * step.sums.momentum[d];
  }
  work += step.sums.link_input + step.sums.support_input + step.sums.contact_support_input;
}

/// The rows, in the order of energy.csv. A new one is a line here about a number in StepSums.
inline constexpr auto ledger_rows = std::to_array<LedgerRow>({
    {"damping_loss", "damping", 1, damping_work},
    {"contact_work", "contact", -1, plain<&StepSums::contact_work>, plain<&StepSums::contact_work>},
    {"friction_loss", "friction", 1, plain<&StepSums::friction_loss>,
     plain<&StepSums::friction_loss>, nullptr, "", "  friction of contacts took {friction:.4g}\n"},
    {"input_work", "input", -1, input_work, plain<&StepSums::contact_support_input>},
    {"gravity_work", "gravity", 0, gravity_work, nullptr, nullptr, "",
     "  of the input work that of gravity {gravity:.4g}\n"},
    {"load_work", "loads", 0, mean_power<&StepSums::load>, nullptr, nullptr, "",
     "  of the input work that of loads {loads:.4g}\n"},
    {"device_work", "devices", 1, mean_power<&StepSums::device>, nullptr, nullptr, "",
     "  device work {devices:.4g}: of dashpots, one-way bars and springs, bearings that slide, and "
     "of regions with damping\n  of their own beside that of their structure\n"},
    {"link_loss", "", 0, plain<&StepSums::link_loss>, nullptr, &StepSums::link_loss_before,
     "links"},  // a part of the device work
    {"plastic_loss", "plastic", 1, plain<&StepSums::plastic_loss>, nullptr,
     &StepSums::plastic_loss_before, "yielding elements",
     "  yielding, damage and crushing took {plastic:.4g}\n"},
    {"switch_loss", "switch", 1, nullptr, nullptr, nullptr, "",
     "  left out between full order and modes {switch:.4g}\n"},  // see change_order
});

/// Number of a row; another name is no constant, and does not compile.
consteval std::size_t ledger_row(std::string_view name) {
  std::size_t row = 0;
  while (ledger_rows.at(row).name != name) ++row;
  return row;
}

/// One line of the ledger, all structures together [J].
struct EnergyLine {
  double time = 0;      ///< t_n; the energies are half a step later
  double kinetic = 0;   ///< 1/2 v^T (M + S - dt/2 C) v
  double strain = 0;    ///< 1/2 u_{n+1}^T K u_n, and the energy of links
  double residual = 0;  ///< energy - initial energy + rows taken - rows given
  std::array<double, ledger_rows.size()> rows{};  ///< as in ledger_rows
  double slow_relief = 0;                         ///< see StructureEnergy

  double energy() const { return kinetic + strain; }
};

/// Energies of one structure on a line of the ledger [J].
struct StructureEnergy {
  double kinetic = 0;
  double strain = 0;
  /// 1/2 v^T (M + S - dt/2 C - dt^2/4 K) v: positive for every motion if and only if the step is
  /// stable; the first to turn negative when it is not.
  double positive_part = 0;
  /// u^T M u [kg m2]; omega_max^2 times this bounds the parts of u^T K u, and so its round-off.
  double displacement_mass = 0;
  /// Bound of the energy that the structure holds, the branches of uniform damping included: its
  /// energy, and all that the filters took since the start. About a rest u_0 that uniform damping
  /// leaves alone: 1/2 v^T A v + s/2 d^T K d and the branches, d = ubar - u_0, which is no more
  /// than E + energy that the filters took - (K u_0)^T (ubar - u_0 / 2), since loads do work
  /// against K u_0.
  double held = 0;
  /// Part of the strain energy that uniform damping gives to a motion so slow that its branches
  /// have let go: (1 - s) / 2 u_{n+1}^T K u_n, or (1 - s) / 2 d^T K d about a rest.
  double slow_relief = 0;

  double energy() const { return kinetic + strain; }
};

/// Exact energy identity of the scheme, with vbar = (v_{n+1/2} + v_{n-1/2}) / 2:
///
///     E_{n+1/2} - E_{n-1/2} = -dt vbar^T C vbar + dt vbar^T (f_n - x_n) + 1/2 lambda^T L v_{n-1/2}
///     E_{n+1/2}             = 1/2 v^T (M + S - dt/2 C) v + 1/2 u_{n+1}^T K u_n
///
/// with S the mass that scaled elements are given, x the force of links, whose energy W_{n+1/2} is
/// beside the strain energy (see LinkLaw), and C all damping, alpha M + beta K + D. The forces of D
/// lag like the others: they come as D v_{n-1/2}, and
///
///     vbar^T D vbar = vbar^T D v- + (v+^T D v+ - v-^T D v-) / 4
///
/// The steps leave all terms as sums over dofs; the energies of E_{n+1/2} come with the step after,
/// and so does the balance of step n. The work of q = K (u_n + beta v-) goes into strain energy and
/// damping, so that the energy that beta took up to a line follows from it and from the energies
/// there,
///
///     dt beta sum vbar^T K vbar = dt sum vbar^T q - [ 1/2 u_n^T K u_{n+1} - dt/4 beta v+^T K v+ ]
///
/// the strain energy here from the other side of K than in E_{n+1/2}. No step needs K u or K v by
/// themselves for that; without beta nothing is taken from the work of q.
///
/// A contact's work is that of its normal impulses; its friction loses -1/2 lambda_t L_t (v- + v+).
/// Uniform damping replaces K u_n by a filtered force f_n; then C = D and the damping loss is dt
/// vbar^T (f_n - K u_n): energy that branches keep for a while counts as lost until they give it
/// back.
///
/// Sums are kept per rank and added up only when a line is asked for. The balance starts at E_{1/2}
/// without the contact work of the first half step, which is the first that it counts.
class EnergyBalance {
 public:
  EnergyBalance(MPI_Comm comm, std::span<const LinearSystem> systems, double time_step);

  /// Called at the end of every step: closes the one before, and opens this one with its sums per
  /// structure and its ground acceleration; `with_energies`: these are among the sums.
  void add_step(std::span<const StepSums> sums, const std::array<double, 3>& ground_acceleration,
                bool with_energies = true);
  /// A structure's state before the next step, which is not the first, was put in place of another
  /// one of its motion: the energies of both, as the sums of a step from there would have them. Of
  /// this rank.
  void change_order(std::size_t structure, const StepSums& before, const StepSums& after);
  /// Energies of a structure before a step by its sums. Of this rank.
  StructureEnergy energy(std::size_t structure, const StepSums& sums) const;
  /// The energies are read from the sums of the next step.
  bool needs_energies() const { return steps_ == 1; }

  /// The ledger after the last closed step; the step after it was made with energies. `structures`
  /// receives the energy of each one. Collective.
  EnergyLine line(std::span<StructureEnergy> structures) const;

  /// Largest |residual| over the largest term (energies, losses, works) of all lines so far.
  double relative_residual() const {
    return largest_term_ > 0 ? largest_residual_ / largest_term_ : 0;
  }
  /// Largest energy, loss or work of all lines so far [J].
  double largest_term() const { return largest_term_; }
  std::int64_t closed_steps() const { return steps_ - 1; }
  void note(const EnergyLine& line);

  void keep(const StateKeeper& state);

 private:
  /// Sum that does not lose small parts over millions of steps (Neumaier).
  struct Sum {
    double value = 0;
    double correction = 0;
    void add(double term);
    double total() const { return value + correction; }
  };

  /// Energies before the step at hand.
  void take_energies(std::span<const StepSums> sums);
  /// Opens the rows of the step just made; of the first one, those that count from it on.
  void open_rows(std::span<const StepSums> sums, const std::array<double, 3>& ground_acceleration);
  /// Stored part of the work of q at a line, of a structure with beta: above, in brackets [J].
  double stored_work(std::size_t structure, const StepSums& sums) const;

  MPI_Comm comm_;
  std::span<const LinearSystem> systems_;
  double time_step_;
  std::vector<StructureEnergy> energies_;
  /// alpha of each structure as the step has it [1/s]: it multiplies by 1 - dt alpha, a number so
  /// close to 1 that rounding it changes alpha by up to 1e-16 / (dt alpha) of itself.
  std::vector<double> mass_damping_;
  double initial_ = 0;
  double lagged_damping_ = 0;  ///< dt/4 v^T D v now and at the start [J]
  double initial_lagged_damping_ = 0;
  double stored_work_ = 0;  ///< of q, where energies are asked for, and at the start [J]
  double initial_stored_work_ = 0;
  std::array<double, ledger_rows.size()> open_{};  ///< of the step that is not closed yet
  std::array<Sum, ledger_rows.size()> closed_{};
  /// Work of the uniform damping of each structure, closed and of the open step; a part of the
  /// damping loss.
  std::vector<Sum> filtered_;
  std::vector<double> open_filtered_;
  std::int64_t steps_ = 0;
  double largest_term_ = 0;
  double largest_residual_ = 0;
};

}  // namespace pounding
