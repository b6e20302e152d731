#pragma once

#include <span>
#include <vector>

#include "dynamics/energy_balance.h"
#include "dynamics/state.h"
#include "interactions/contact_problem.h"
#include "model/model.h"

/// Stops runs whose numbers cannot be trusted, at every line of the energy ledger.
namespace pounding {

/// Throws DivergenceError if an energy of a structure is not a number, or if its positive part is
/// negative beyond round-off: the first sign of a step that is too long. The message names the
/// structure, the node that moves most and an element there. Collective.
void watch_divergence(const Model& model, const State& state, const EnergyLine& line,
                      std::span<const StructureEnergy> structures);

/// Round-off of a structure's energy [J]: that of the products K u, whose parts may be far larger
/// than their sum, up to omega_max^2 u^T M u.
double energy_round_off(const Model& model, std::size_t structure, const StructureEnergy& energy);

/// Throws DivergenceError if the energy identity, exact but for round-off, does not close: the
/// state or the matrices are damaged. Round-off is that of the largest term [J] so far, of the work
/// that a step of the load could do, and of the structures' energies.
void watch_identity(const Model& model, const EnergyLine& line,
                    std::span<const StructureEnergy> structures, double largest_term);

/// Throws DivergenceError if parts that can only take energy have given some: damping and devices
/// together, or tension-only bars, by more than a millionth of the largest term [J] so far.
/// `leaning`: beta acts beside P-Delta of columns that yield, which no time step mends.
void watch_passivity(const EnergyLine& line, double largest_term, bool leaning = false);

/// A line of the ledger with the energies of the structures and their round-off [J].
struct ClosedLine {
  EnergyLine line;
  std::vector<StructureEnergy> energies;
  std::vector<double> round_off;
};

/// Closes a line of the ledger and looks at it with all that is here. `state`: after the step;
/// `contact` may be null. Collective.
ClosedLine close_line(MPI_Comm comm, const Model& model, const State& state,
                      const interactions::ContactProblem* contact, EnergyBalance& energy);

/// Throws DivergenceError if some rank's contact problem had no finite answer and so was left out.
/// `contact` may be null. Collective.
void watch_contact(MPI_Comm comm, const interactions::ContactProblem* contact, double time);

}  // namespace pounding
