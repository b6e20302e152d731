#include "stability/step_target.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "mesh/location.h"
#include "modal/modal_analysis.h"
#include "stability/stable_time_step.h"
#include "system/finite_element_system.h"
#include "system/rotary_scaling.h"

namespace pounding {
namespace {

constexpr double hertz = 2 * std::numbers::pi;
constexpr int grid = 200;  // parts of the target in which the step of elements is counted
constexpr double surely_reached = 0.98;  // of a step that was reached, whatever the grid

MatHandle shifted_mass(const LinearSystem& system, double omega) {
  std::vector<double> mass = system.lumped_mass;
  const VecHandle diagonal = wrap_vector(system, mass);
  MatHandle matrix;
  POUNDING_PETSC(MatDuplicate(system.stiffest_matrix(), MAT_COPY_VALUES, matrix.out()));
  POUNDING_PETSC(MatScale(matrix.get(), 1 / (omega * omega)));
  POUNDING_PETSC(MatDiagonalSet(matrix.get(), diagonal.get(), ADD_VALUES));
  return matrix;
}

std::string number(double value) {
  return sentence("{:.3g}", {value});
}

std::string three_digits_down(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2);
  return number(std::floor(value / unit * (1 + 1e-12)) * unit);
}

/// Looks for the least scaled mass, from the structure without any.
class Designer {
 public:
  Designer(const Structure& structure, const Mesh& mesh, StiffnessMethod method,
           const EigenvalueEffort& effort)
      : structure_(structure),
        target_(*structure.step_target),
        mesh_(mesh),
        method_(method),
        effort_(effort),
        plain_(build(0, false, true)),
        rotations_(plain_, mesh, hertz * target_.frequency) {
    if (structure_.uniform_damping || structure_.damping.beta > 0) {
      const ModalResult modal = lowest_modes(plain_, mesh, 1);
      first_ = modal.first_frequency();
      if (structure_.uniform_damping && structure_.uniform_damping->reference == 0) {
        structure_.uniform_damping->reference = reference_frequency(structure, modal);
        plain_.uniform_damping->reference = structure_.uniform_damping->reference;
      }
    }
    before_ = stable_step(plain_);
  }

  /// Shells alone, whose mass stays diagonal, then everything that is stiff.
  StepDesign design() {
    if (before_ >= target_.time_step) return {scaled_for(0, false), before_, before_, {}};
    std::optional<Found> found = search(false);
    if (found && affordable(found->change)) return design_of(*found, false);
    if (const auto with_elements = search(true)) {
      found = with_elements;
      if (affordable(found->change)) return design_of(*found, true);
    }
    refuse(found ? costs(*found) : held(build(target_.time_step, true)));
  }

 private:
  /// `elements`: beams, bars and springs as well.
  Structure scaled_for(double step, bool elements) const {
    Structure scaled = structure_;
    scaled.mass_scaling = elements ? step : 0;
    scaled.step_target->shells = step;
    return scaled;
  }

  LinearSystem build(double step, bool elements, bool with_matrix = false) const {
    return build_system(scaled_for(step, elements), mesh_, method_, with_matrix);
  }

  double stable_step(const LinearSystem& system) const {
    return limits_of(structure_, system, mesh_, nullptr, effort_).stable_time_step;
  }

  struct Found {
    double step = 0;   ///< that elements are scaled for [s]
    double after = 0;  ///< stable step [s]
    FrequencyChange change;
    std::string location;  ///< where shells cost most
  };

  bool affordable(const FrequencyChange& change) const {
    return change.largest() <= target_.change;
  }

  StepDesign design_of(const Found& found, bool elements) const {
    return {scaled_for(found.step, elements), before_, found.after, found.change};
  }

  /// The least scaled mass that reaches the target, upwards from the need of single elements;
  /// nothing where the most is not enough.
  std::optional<Found> search(bool elements) const {
    const double closeness = plain_.element_time_step_bound / before_;
    int part = std::clamp(static_cast<int>(std::ceil(grid * closeness)), 1, grid);
    while (true) {
      const double step = target_.time_step * part / grid;
      const LinearSystem system = build(step, elements);
      const double after = stable_step(system);
      if (after >= target_.time_step) {
        const RotationBound::Found part_of_shells = rotations_.bound(system.rotary_scaling.inertia);
        return Found{step, after,
                     change_of(part_of_shells.part, system.mass_scaling.largest_factor),
                     part_of_shells.location};
      }
      if (part == grid) return std::nullopt;
      part = std::min(grid, std::max(part + 1, static_cast<int>(part * target_.time_step / after)));
    }
  }

  FrequencyChange change_of(double rotations, double factor) const {
    return {rotations, factor * std::pow(hertz * target_.frequency, 2)};
  }

  static std::string held(const LinearSystem& system) {
    const std::string& element = system.limiting_element;
    return (element.empty() ? "something beside the elements" : element) +
           " holds it, and no scaled mass helps there";
  }

  std::string costs(const Found& found) const {
    const FrequencyChange& change = found.change;
    std::string text =
        "frequencies up to " + number(target_.frequency) + " Hz could fall by " +
        number(change.largest()) + " of themselves, above -" + structure_.name + "_target_change " +
        number(target_.change) + ": by " + number(change.by_rotations()) +
        " through the rotations of shells alone, by " + number(change.by_elements()) +
        " through stiff beams, bars and springs alone";
    if (change.rotations > 0) text += ", the shells most at the " + found.location;
    return text;
  }

  /// The stable step of the most scaled mass that elements and frequencies allow, below that for
  /// `high`; short by some per cent.
  double reachable(double high) {
    double low = std::min(plain_.element_time_step_bound, high);
    const auto find = [&](int halvings, const auto& allows) {
      double least = low;
      for (int i = 0; i < halvings && high > least * 1.001; ++i) {
        const double step = std::sqrt(least * high);
        const StepPlan plan = plan_step(scaled_for(step, true), mesh_);
        (plan.feasible && allows(plan) ? least : high) = step;
      }
      return least;
    };
    high = find(20, [](const StepPlan&) { return true; });
    low = find(9, [this](const StepPlan& plan) {
      const double part = rotations_.bound(plan.inertia).part;
      return affordable(change_of(part, plan.largest_factor));
    });
    return std::max(before_, surely_reached * stable_step(build(low, true)));
  }

  /// Whether no element is scaled with it that is not scaled with Rayleigh damping: the ranks share
  /// out the nodes for this one.
  bool scales_no_more(const UniformDamping& uniform) const {
    return std::ranges::all_of(structure_.regions, [&](const Region& region) {
      return 2 * structure_.damping_of(region).beta >= (uniform.at_once() - 1) * target_.time_step;
    });
  }

  [[noreturn]] void refuse(const std::string& why) {
    const double reach = reachable(target_.time_step);
    std::string text =
        sentence("option -{}_time_step_target {} s: {}; {} s is within reach, {} s stable without",
                 {structure_.name, target_.time_step, why, three_digits_down(reach),
                  three_digits_down(before_)});
    const auto uniform = uniform_in_place_of(structure_.damping, first_);
    if (uniform && scales_no_more(*uniform)) {
      structure_.uniform_damping = uniform;
      structure_.damping = {};
      for (Region& region : structure_.regions) region.damping.reset();
      const double reach_then = reachable(target_.time_step);
      if (reach_then > reach) {
        text +=
            sentence(", {} s within reach with -{}_damping_uniform {} in place of Rayleigh damping",
                     {three_digits_down(reach_then), structure_.name, number(uniform->ratio)});
      }
    }
    throw UserError(text);
  }

  Structure structure_;
  const StepTarget target_;
  const Mesh& mesh_;
  const StiffnessMethod method_;
  const EigenvalueEffort& effort_;
  LinearSystem plain_;  ///< without scaled mass
  RotationBound rotations_;
  double first_ = 0;   ///< its lowest frequency [Hz]
  double before_ = 0;  ///< its stable step [s]
};

}  // namespace

RotationBound::RotationBound(const LinearSystem& system, const Mesh& mesh, double omega)
    : system_(system),
      mesh_(mesh),
      matrix_(shifted_mass(system, omega)),
      solver_(matrix_.get(), 0) {}

RotationBound::Found RotationBound::bound(std::span<const double> inertia) const {
  double largest = inertia.empty() ? 0 : *std::ranges::max_element(inertia);
  reduce_over_ranks(system_.comm, MPI_MAX, largest);
  if (largest == 0) return {};
  // D^1/2 (M + K / omega^2)^-1 D^1/2
  std::vector<double> values(inertia.size());
  const auto product = [&](Vec x, Vec y) {
    const VecReader reader(x);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = std::sqrt(inertia[i]) * reader.data()[i];
    }
    solver_.solve(values);
    double* result = nullptr;
    POUNDING_PETSC(VecGetArray(y, &result));
    for (std::size_t i = 0; i < values.size(); ++i) result[i] = std::sqrt(inertia[i]) * values[i];
    POUNDING_PETSC(VecRestoreArray(y, &result));
  };
  Lanczos lanczos(system_, mesh_, product);
  EigenvalueEffort effort;
  effort.work = 0;
  effort.tolerance = 0.05;  // in frequency
  lanczos.run(effort, "the fall of its frequencies");
  std::vector<double> share = lanczos.vector();
  for (double& value : share) value *= value;
  return {lanczos.bound(), locate_largest(mesh_, share)};
}

std::optional<UniformDamping> uniform_in_place_of(const Rayleigh& damping, double first) {
  const double ratio = std::min(0.3, damping_ratio(damping, hertz * first));
  if (!(damping.beta > 0 && first > 0 && ratio > 0)) return std::nullopt;
  UniformDamping uniform = fit_uniform_damping(ratio, std::min(1.0, first / 2), 400, 3);
  uniform.reference = first;
  return uniform;
}

StepDesign design_for_target(const Structure& structure, const Mesh& mesh, StiffnessMethod method,
                             const EigenvalueEffort& effort) {
  return Designer(structure, mesh, method, effort).design();
}

}  // namespace pounding
