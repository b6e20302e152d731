#include "modal/reduced_system.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "stiffness/stiffness.h"
#include "system/inelastic_laws.h"
#include "system/links.h"
#include "system/mass_scaling.h"
#include "system/support_shapes.h"

namespace pounding {
namespace {

/// Ratios go by the number of the mode; the last one is of all modes that follow, and of vectors
/// that are no mode.
double damping_ratio_of(const std::vector<double>& ratios, int mode_number) {
  const std::size_t last = ratios.size() - 1;
  return mode_number > 0 ? ratios[std::min(static_cast<std::size_t>(mode_number) - 1, last)]
                         : ratios[last];
}

/// C of each coordinate of unit mass [1/s].
std::vector<double> damping_rates(const Structure& structure, const ModalBasis& basis) {
  const std::vector<double>& ratios = structure.modal->damping_ratios;
  std::vector<double> rates;
  for (std::size_t i = 0; i < basis.size(); ++i) {
    const double square = basis.squared_frequency[i];
    const double weight = basis.damping_weights.empty() ? 1 : basis.damping_weights[i];
    rates.push_back(
        weight * (ratios.empty()
                      ? structure.damping.alpha + structure.damping.beta * square
                      : 2 * damping_ratio_of(ratios, basis.mode_numbers[i]) * std::sqrt(square)));
  }
  return rates;
}

/// Uniform damping of a reduced structure, its reference known.
std::optional<UniformDamping> uniform_damping_of(const Structure& structure,
                                                 const ModalBasis& basis) {
  std::optional<UniformDamping> damping = structure.uniform_damping;
  if (damping && damping->reference == 0) {
    damping->reference =
        reference_frequency(structure, modes_of_basis(basis, static_cast<int>(basis.size())));
  }
  return damping;
}

double stiffening_of(const Structure& structure, const ModalBasis& basis) {
  const std::optional<UniformDamping> damping = uniform_damping_of(structure, basis);
  return damping ? damping->at_once() : 1;
}

/// Smallest value of a function of the Rayleigh quotients of damping and stiffness over all
/// coordinates.
template <typename Function>
double smallest(const Structure& structure, const ModalBasis& basis, Function&& function) {
  const std::vector<double> rates = damping_rates(structure, basis);
  const std::vector<double> masses = coordinate_masses(structure, basis);
  const double alpha = structure.modal->damping_ratios.empty() ? structure.damping.alpha : 0;
  const double stiffening = stiffening_of(structure, basis);
  double result = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const double damping = alpha + (rates[i] - alpha) / masses[i];
    result =
        std::min(result, function(damping, stiffening * basis.squared_frequency[i] / masses[i]));
  }
  return result;
}

std::unique_ptr<GeneralisedCoordinates> take_coordinates(ModalBasis& basis, bool owner,
                                                         std::span<const double> masses) {
  auto coordinates = std::make_unique<GeneralisedCoordinates>();
  if (owner) {
    for (std::size_t d = 0; d < 3; ++d) {
      const double* const participation = &basis.participation[d * basis.size()];
      for (std::size_t i = 0; i < basis.size(); ++i) {
        coordinates->influence[d].push_back(participation[i] / masses[i]);
      }
    }
    for (std::size_t i = 0; i < basis.points.size(); ++i) coordinates->row_of[basis.points[i]] = i;
    coordinates->rows = std::move(basis.rows);
  }
  basis.rows.clear();
  return coordinates;
}

/// How the coordinates and the places whose displacement is known follow the supports.
std::shared_ptr<SupportShapes> take_supports(const ModalBasis& basis, bool owner,
                                             std::span<const double> masses,
                                             std::span<const SupportColumn> columns) {
  auto supports = std::make_shared<SupportShapes>();
  supports->columns.assign(columns.begin(), columns.end());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::vector<double>& shape = supports->shape.emplace_back();
    for (std::size_t i = 0; owner && i < basis.size(); ++i) {
      shape.push_back(basis.support_participation[c * basis.size() + i] / masses[i]);
    }
  }
  for (std::size_t i = 0; owner && i < basis.points.size(); ++i) {
    const auto row = basis.support_rows.begin() + static_cast<std::ptrdiff_t>(i * columns.size());
    supports->at_points[basis.points[i]].assign(row,
                                                row + static_cast<std::ptrdiff_t>(columns.size()));
  }
  return supports;
}

}  // namespace

LinearSystem build_reduced_system(MPI_Comm comm, int owner, const Structure& structure,
                                  const Mesh& mesh, ModalBasis& basis,
                                  std::span<const SupportColumn> columns) {
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
  const std::vector<double> masses = coordinate_masses(structure, basis);
  for (std::size_t i = 0; i < owned; ++i) {
    system.lumped_mass.push_back(masses[i]);
    system.inverse_mass.push_back(1 / masses[i]);
  }
  system.mass_scaling.time_step = structure.mass_scaling;
  system.mass_scaling.dofs = std::ranges::count_if(masses, [](double mass) { return mass > 1; });
  const auto share = [&](std::vector<double> values) {
    values.resize(owned);
    return std::make_unique<stiffness::DiagonalStiffness>(comm, std::move(values));
  };
  system.stiffness = share(basis.squared_frequency);
  system.stiffness_method = "modal, K = diag(omega^2)";
  if (structure.modal->damping_ratios.empty() && basis.damping_weights.empty()) {
    system.damping = structure.damping;
    system.uniform_damping = uniform_damping_of(structure, basis);
  } else {
    system.extra_damping = share(damping_rates(structure, basis));
  }
  if (!basis.support_participation.empty()) {
    system.supports = take_supports(basis, mine, masses, columns);
  }
  system.generalised = take_coordinates(basis, mine, masses);
  const LargestFrequency largest = largest_frequency(structure, basis);
  system.element_frequency_bound = largest.omega_max;
  system.element_time_step_bound = stable_time_step(structure, basis);
  system.stiffest_element = largest.location;
  system.links = Links::build(structure, mesh);
  if (system.links) system.links->find_trace(system, mesh);
  system.laws = inelastic_laws(structure, mesh);
  system.has_laws_beside = std::ranges::any_of(structure.regions, follows_law | has_element_law);
  return system;
}

void scale_stiffness(double factor, ModalBasis& basis) {
  for (double& square : basis.squared_frequency) square *= factor;
}

ModalResult modes_of_basis(const ModalBasis& basis, int count) {
  ModalResult result;
  result.mass = basis.mass;
  result.centre_of_mass = basis.centre_of_mass;
  for (std::size_t i = 0; i < basis.size(); ++i) {
    if (basis.mode_numbers[i] == 0 || static_cast<int>(result.modes.size()) == count) continue;
    std::array<double, 6> participation{};
    for (std::size_t k = 0; k < 6; ++k) {
      participation[k] = basis.participation[k * basis.size() + i];
    }
    result.modes.push_back(describe_mode(basis.squared_frequency[i], participation, basis.inertia));
    if (!basis.damping_weights.empty()) {
      result.modes.back().damping_weight = basis.damping_weights[i];
    }
  }
  return result;
}

LargestFrequency largest_frequency(const Structure& structure, const ModalBasis& basis) {
  const std::vector<double> masses = coordinate_masses(structure, basis);
  std::size_t largest = 0;
  const auto square = [&](std::size_t i) { return basis.squared_frequency[i] / masses[i]; };
  for (std::size_t i = 0; i < basis.size(); ++i) {
    largest = square(i) >= square(largest) ? i : largest;
  }
  return {std::sqrt(square(largest)), describe_coordinate(basis, largest)};
}

std::vector<double> coordinate_masses(const Structure& structure, const ModalBasis& basis) {
  std::vector<double> masses(basis.size(), 1.0);
  const double dt = structure.mass_scaling;
  if (dt == 0) return masses;
  const bool rayleigh = structure.modal->damping_ratios.empty();
  const double alpha = rayleigh ? structure.damping.alpha : 0;
  if (dt * alpha >= 2) {
    throw UserError(
        sentence("option -{}_mass_scaling {} s: the damping alpha = {} 1/s allows no step above {} "
                 "s; ask for a smaller one",
                 {structure.name, dt, alpha, 2 / alpha}));
  }
  const std::vector<double> rates = damping_rates(structure, basis);
  const double stiffening = stiffening_of(structure, basis);
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const double needed =
        2 * dt * (rates[i] - alpha) + dt * dt * stiffening * basis.squared_frequency[i];
    masses[i] = std::max(1.0, needed / (4 - 2 * dt * alpha));
  }
  return masses;
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
  return sentence(
      "generalised coordinate {} ({:.4g} Hz)",
      {coordinate + 1, std::sqrt(basis.squared_frequency[coordinate]) / (2 * std::numbers::pi)});
}

std::string locate_largest(const LinearSystem& system, const ModalBasis& basis,
                           std::span<const double> values) {
  double largest = -1;
  std::size_t place = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double size =
        std::isfinite(values[i]) ? std::abs(values[i]) : std::numeric_limits<double>::infinity();
    if (size > largest) {
      largest = size;
      place = i;
    }
  }
  std::string mine = values.empty() ? "" : describe_coordinate(basis, place);
  share_extreme(system.comm, MPI_MAXLOC, largest, mine);
  return mine;
}

}  // namespace pounding
