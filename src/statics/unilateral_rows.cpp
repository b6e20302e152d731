#include "statics/unilateral_rows.h"

#include <algorithm>

#include "common/parallel.h"
#include "statics/link_terms.h"

namespace pounding {

UnilateralRows::UnilateralRows(MPI_Comm comm, const interactions::ContactProblem* contact,
                               std::span<const double> gaps, std::span<const char> open,
                               std::span<const LinearSystem> systems)
    : comm_(comm) {
  if (contact != nullptr) add_contacts(*contact, gaps, open, systems);
  contacts_ = size();
  for (std::size_t s = 0; s < systems.size(); ++s) add_links(s, systems[s]);
}

void UnilateralRows::add_contacts(const interactions::ContactProblem& contact,
                                  std::span<const double> gaps, std::span<const char> open,
                                  std::span<const LinearSystem> systems) {
  for (int i = 0; i < contact.rows(); ++i) {
    Row& row = rows_.emplace_back();
    row.initial = std::max(0.0, gaps[i]);
    row.open = open[i] != 0;
    for (std::size_t s = 0; s < systems.size(); ++s) {
      const std::vector<double> force = contact.row_force(i, s, systems[s].owned_dofs());
      for (const LocalIndex dof : contact.trace(s).dofs()) {
        if (force[dof] != 0) row.entries.push_back({s, dof, force[dof]});
      }
    }
  }
}

void UnilateralRows::add_links(std::size_t structure, const LinearSystem& system) {
  std::vector<LinkTerms> bars = link_terms(system);
  std::erase_if(bars, [](const LinkTerms& bar) { return !bar.one_way; });
  std::vector<int> counts(size_of(comm_));
  const int mine = static_cast<int>(bars.size());
  MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_);
  for (int rank = 0; rank < size_of(comm_); ++rank) {
    std::vector<double> numbers(2 * static_cast<std::size_t>(counts[rank]));
    const bool own = rank == rank_of(comm_);
    for (std::size_t i = 0; own && i < bars.size(); ++i) {
      numbers[2 * i] = 1 / bars[i].stiffness;
      numbers[2 * i + 1] = bars[i].slack;
    }
    MPI_Bcast(numbers.data(), 2 * counts[rank], MPI_DOUBLE, rank, comm_);
    for (std::size_t i = 0; 2 * i < numbers.size(); ++i) {
      Row& row = rows_.emplace_back();
      row.compliance = numbers[2 * i];
      row.initial = numbers[2 * i + 1];
      for (std::size_t k = 0; own && k < bars[i].dofs.size(); ++k) {
        row.entries.push_back({structure, bars[i].dofs[k], -bars[i].coefficients[k]});
      }
    }
  }
}

std::vector<double> UnilateralRows::responses(
    std::span<const std::vector<double>> displacement) const {
  std::vector<double> sums(rows_.size(), 0.0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (const Entry& entry : rows_[i].entries) {
      sums[i] += entry.coefficient * displacement[entry.structure][entry.dof];
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), size(), MPI_DOUBLE, MPI_SUM, comm_);
  return sums;
}

std::vector<double> UnilateralRows::openings(
    std::span<const std::vector<double>> displacement) const {
  std::vector<double> openings = responses(displacement);
  for (std::size_t i = 0; i < rows_.size(); ++i) openings[i] += rows_[i].initial;
  return openings;
}

void UnilateralRows::add_force(int row, double f, std::span<std::vector<double>> forces) const {
  for (const Entry& entry : rows_[row].entries) {
    forces[entry.structure][entry.dof] += f * entry.coefficient;
  }
}

}  // namespace pounding
