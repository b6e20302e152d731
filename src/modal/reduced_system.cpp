#include "modal/reduced_system.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "common/parallel.h"
#include "system/critical_time_step.h"
#include "system/diagonal_stiffness.h"

namespace pounding {
namespace {

/// C of each coordinate [1/s].
std::vector<double> damping_rates(const Structure& structure, const ModalBasis& basis) {
  const std::vector<double>& ratios = structure.modal->damping_ratios;
  std::vector<double> rates;
  for (std::size_t i = 0; i < basis.size(); ++i) {
    const double square = basis.squared_frequency[i];
    rates.push_back(ratios.empty()
                        ? structure.damping.alpha + structure.damping.beta * square
                        : 2 * ratios[std::min(i, ratios.size() - 1)] * std::sqrt(square));
  }
  return rates;
}

/// Smallest value of a function of damping rate and squared frequency over all coordinates.
template <typename Function>
double smallest(const Structure& structure, const ModalBasis& basis, Function&& function) {
  const std::vector<double> rates = damping_rates(structure, basis);
  double result = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < rates.size(); ++i) {
    result = std::min(result, function(rates[i], basis.squared_frequency[i]));
  }
  return result;
}

std::unique_ptr<GeneralisedCoordinates> take_coordinates(ModalBasis& basis, bool owner) {
  auto coordinates = std::make_unique<GeneralisedCoordinates>();
  if (owner) {
    for (std::size_t d = 0; d < 3; ++d) {
      const auto begin =
          basis.participation.begin() + static_cast<std::ptrdiff_t>(d * basis.size());
      coordinates->influence[d].assign(begin, begin + static_cast<std::ptrdiff_t>(basis.size()));
    }
    for (std::size_t i = 0; i < basis.points.size(); ++i) {
      coordinates->row_of[basis.points[i]] = i;
    }
    coordinates->rows = std::move(basis.rows);
  }
  basis.rows.clear();
  return coordinates;
}

}  // namespace

LinearSystem build_reduced_system(MPI_Comm comm, int owner, const Structure& structure,
                                  ModalBasis& basis) {
  const bool mine = rank_of(comm) == owner;
  LinearSystem system;
  system.name = structure.name;
  system.comm = comm;
  system.initial_displacement = structure.initial_displacement;
  system.initial_velocity = structure.initial_velocity;
  system.gravity = structure.gravity;
  system.global_dofs = static_cast<GlobalIndex>(basis.size());
  system.total_mass = basis.total_mass;
  const std::size_t owned = mine ? basis.size() : 0;
  system.lumped_mass.assign(owned, 1.0);
  system.inverse_mass.assign(owned, 1.0);
  const auto share = [&](std::vector<double> values) {
    values.resize(owned);
    return std::make_unique<DiagonalStiffness>(comm, std::move(values));
  };
  system.stiffness = share(basis.squared_frequency);
  system.stiffness_method = "modal, K = diag(omega^2)";
  if (structure.modal->damping_ratios.empty()) {
    system.damping = structure.damping;
  } else {
    system.extra_damping = share(damping_rates(structure, basis));
  }
  system.generalised = take_coordinates(basis, mine);
  system.element_frequency_bound = largest_frequency(basis).omega_max;
  system.element_time_step_bound = stable_time_step(structure, basis);
  system.stiffest_element = describe_coordinate(basis, basis.size() - 1);
  return system;
}

ModalResult modes_of_basis(const ModalBasis& basis, int count) {
  ModalResult result;
  result.mass = basis.mass;
  result.centre_of_mass = basis.centre_of_mass;
  for (std::size_t i = 0; i < static_cast<std::size_t>(std::min(count, basis.modes)); ++i) {
    std::array<double, 6> participation{};
    for (std::size_t k = 0; k < 6; ++k) {
      participation[k] = basis.participation[k * basis.size() + i];
    }
    result.modes.push_back(describe_mode(basis.squared_frequency[i], participation, basis.inertia));
  }
  return result;
}

LargestFrequency largest_frequency(const ModalBasis& basis) {
  return {std::sqrt(basis.squared_frequency.back()), describe_coordinate(basis, basis.size() - 1)};
}

double stable_time_step(const Structure& structure, const ModalBasis& basis) {
  return smallest(structure, basis, critical_time_step);
}

double energy_margin(const Structure& structure, const ModalBasis& basis, double time_step) {
  return smallest(structure, basis, [&](double rate, double square) {
    return 1 - time_step / 2 * rate - time_step * time_step / 4 * square;
  });
}

std::string describe_coordinate(const ModalBasis& basis, std::size_t coordinate) {
  char text[100];
  std::snprintf(text, sizeof text, "generalised coordinate %zu (%.4g Hz)", coordinate + 1,
                std::sqrt(basis.squared_frequency[coordinate]) / (2 * std::numbers::pi));
  return text;
}

std::string locate_largest(const LinearSystem& system, const ModalBasis& basis,
                           std::span<const double> values) {
  struct {
    double value;
    int rank;
  } largest{-1, rank_of(system.comm)};
  int place = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double size =
        std::isfinite(values[i]) ? std::abs(values[i]) : std::numeric_limits<double>::infinity();
    if (size > largest.value) {
      largest.value = size;
      place = static_cast<int>(i);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, system.comm);
  MPI_Bcast(&place, 1, MPI_INT, largest.rank, system.comm);
  return describe_coordinate(basis, static_cast<std::size_t>(place));
}

}  // namespace pounding
