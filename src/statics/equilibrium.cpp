#include "statics/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "common/dense_matrix.h"
#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "interactions/soil_rows.h"
#include "statics/assembled_statics.h"
#include "statics/tried_rows.h"
#include "system/admissible_motions.h"
#include "system/law_forces.h"
#include "system/load_shapes.h"

namespace pounding {
namespace {

constexpr double proximal_shift = 1;  // sigma [1/s2]
constexpr int most_gradient_steps = 500;
/// Residual that round-off may leave, where light nodes hang on stiff elements.
constexpr double largest_residual = 1e-4;
/// Iterations in a row that gain nothing, after which nothing will.
constexpr int most_idle_iterations = 20;
/// Steps in a row without a gain, after which nothing will, where elements yield.
constexpr int most_idle_yielded = 60;
/// Iterations without a gain after which a small residual is round-off, where elements yield.
constexpr int settled = 3;
/// Residual below which the iteration goes on only as long as it gains.
constexpr double small_residual = 1e-8;
/// Steps that the iteration goes on from where elements yield.
constexpr std::size_t most_trials = 12;
/// Added to the diagonal of their products, over the largest.
constexpr double of_products = 1e-14;
class Search {
 public:
  Search(MPI_Comm comm, std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
         const interactions::Interface& interface, std::span<const char> open_rows,
         SolverChoice solver)
      : comm_(comm),
        systems_(systems),
        meshes_(meshes),
        interface_(interface),
        any_open_at_rest_(std::ranges::any_of(open_rows, [](char open) { return open != 0; })),
        rows_(comm, interface.constraints, open_rows, systems, meshes),
        soil_(interactions::make_soil_rows(comm, interface, systems, meshes)),
        tried_(rows_, systems, stiffness_) {
    for (std::size_t s = 0; s < systems.size(); ++s) {
      stiffness_.push_back(make_static_stiffness(systems[s], meshes[s], proximal_shift, solver));
      const std::size_t dofs = systems[s].lumped_mass.size();
      displacement_.emplace_back(dofs, 0.0);
      law_force_.emplace_back(dofs, 0.0);
      links_.emplace_back(systems[s]);
      weight_.emplace_back(dofs, 0.0);
      for (std::size_t d = 0; d < 3; ++d) {
        const std::vector<double> load = systems[s].ground_load(static_cast<int>(d));
        for (std::size_t i = 0; i < dofs; ++i) weight_[s][i] += load[i] * systems[s].gravity[d];
      }
      if (systems[s].loads) systems[s].loads->add_at_rest(weight_[s]);
    }
  }

  Equilibrium find() {
    double best = std::numeric_limits<double>::infinity();
    double last = best;
    int idle = 0;
    residual_ = weight_;
    update_correction();
    weight_size_ = size_of_residual();
    for (iterations_ = 1;; ++iterations_) {
      std::optional<Trial> from_yielded;
      if (yielded_) from_yielded = Trial{residual_, correction_, {}, {}};
      iterate();
      const double left = relative_residual();
      if (left == 0 || (left < small_residual && left > best / 2 && !ever_yielded_)) break;
      idle = left < 0.9 * best ? 0 : idle + 1;
      if (left < small_residual && idle >= settled) break;
      if (left > 2 * last) trials_.clear();  // other elements yield
      last = left;
      if (from_yielded && yielded_) {
        from_yielded->displacement = displacement_;
        from_yielded->force = tried_.forces();
        accelerate(std::move(*from_yielded));
      }
      best = std::min(best, left);
      const double enough = ever_yielded_ ? small_residual : largest_residual;
      const int most_idle = ever_yielded_ ? most_idle_yielded : most_idle_iterations;
      if (idle == most_idle && left < enough) break;  // round-off
      if (iterations_ == most_gradient_steps || idle == most_idle || !std::isfinite(left)) {
        refuse(left);
      }
    }
    refuse_sliders();
    return describe();
  }

 private:
  /// Sliders whose strength follows a pressure, or that yield on a circle, have no law of their own
  /// at rest: beyond their yield force they would jump as soon as the run begins.
  void refuse_sliders() const {
    on_every_rank(comm_, [&] {
      for (std::size_t s = 0; s < systems_.size(); ++s) {
        const std::optional<RestLinks::Slid> slid = links_[s].slid(displacement_[s]);
        if (!slid) continue;
        throw UserError(sentence(
            "option -preload static: element {} of group '{}' of structure {} slides at rest, "
            "where it bears {} N along an axis; give a larger yield force or friction, or leave "
            "-preload out",
            {slid->link->number, slid->link->origin.region->group, systems_[s].name, slid->force}));
      }
    });
  }

  /// u + d of the residual and the forces in force, then the change of forces that the rows want.
  void iterate() {
    Fields trial = correction_;
    for (std::size_t s = 0; s < trial.size(); ++s) add(displacement_[s], trial[s]);
    const std::vector<double> change = tried_.solve(rows_.openings(trial));
    if (std::ranges::any_of(change, [](double value) { return value != 0; })) {
      Fields more = zeros(systems_);
      for (int i = 0; i < rows_.size(); ++i) rows_.add_force(i, change[i], more);
      for (std::size_t s = 0; s < trial.size(); ++s) {
        stiffness_[s]->solve(more[s]);
        add(more[s], trial[s]);
      }
    }
    displacement_ = std::move(trial);
    update_residual();
  }

  /// One step of the iteration: from where the residual and its correction were, to where it came.
  struct Trial {
    Fields residual;
    Fields correction;
    Fields displacement;
    std::vector<double> force;
  };

  /// Where elements yield, K corrects too little. Goes on from the mean of the last steps' ends
  /// whose corrections d cancel best in the norm of K + sigma M (Anderson, J. ACM 12 (1965), 547):
  /// while the same elements yield, that finds the rest of as many of them in as many steps. Where
  /// others do it may lead away; then the last step's end stays, as K is stiffer than any tangent
  /// and such steps alone never go away.
  void accelerate(Trial step) {
    if (trials_.size() == most_trials) trials_.erase(trials_.begin());
    trials_.push_back(std::move(step));
    const std::size_t n = trials_.size();
    std::vector<double> products(n * n);  // d_i^T (K + sigma M) d_j
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t s = 0; s < systems_.size(); ++s) {
          products[i * n + j] +=
              std::inner_product(trials_[i].residual[s].begin(), trials_[i].residual[s].end(),
                                 trials_[j].correction[s].begin(), 0.0);
        }
      }
    }
    reduce_over_ranks(comm_, MPI_SUM, products);
    double size = 0;
    for (std::size_t i = 0; i < n; ++i) size = std::max(size, products[i * n + i]);
    for (std::size_t i = 0; i < n; ++i) products[i * n + i] += of_products * size;
    std::vector<double> weights(n, size);
    if (!solve_dense(products, weights)) weights.assign(n, 0.0);
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(sum > 0)) return;
    const double plain = relative_residual();
    const Fields end = std::exchange(displacement_, zeros(systems_));
    const std::vector<double> forces =
        std::exchange(tried_.forces(), std::vector<double>(tried_.forces().size(), 0.0));
    for (std::size_t k = 0; k < n; ++k) {
      const double part = weights[k] / sum;
      for (std::size_t s = 0; s < systems_.size(); ++s) {
        for (std::size_t i = 0; i < displacement_[s].size(); ++i) {
          displacement_[s][i] += part * trials_[k].displacement[s][i];
        }
      }
      for (std::size_t i = 0; i < forces.size(); ++i) {
        tried_.forces()[i] += part * trials_[k].force[i];
      }
    }
    update_residual();
    if (relative_residual() <= plain) return;
    displacement_ = end;
    tried_.forces() = forces;
    trials_.clear();
    update_residual();
  }

  void update_residual() {
    const Fields forces = tried_.on_dofs(0, rows_.size());
    std::vector<double> product;
    bool yielded = !interface_.soil.empty();  // K alone corrects too little or too much
    for (std::vector<double>& force : law_force_) std::ranges::fill(force, 0.0);
    add_soil_between_mats();
    for (std::size_t s = 0; s < systems_.size(); ++s) {
      for (const bool apart : {false, true}) {
        yielded |= add_law_forces(systems_[s], apart, meshes_[s], displacement_[s], law_force_[s]);
      }
      yielded |= links_[s].add_forces(displacement_[s], law_force_[s]);
      stiffness_[s]->apply(displacement_[s], product);
      for (std::size_t i = 0; i < product.size(); ++i) {
        residual_[s][i] = weight_[s][i] + forces[s][i] - product[i] - law_force_[s][i];
      }
      take_up_by_constraints(systems_[s], residual_[s]);
    }
    yielded_ = on_any_rank(comm_, yielded);
    ever_yielded_ = ever_yielded_ || yielded_;
    update_correction();
  }

  /// Adds forces of the springs between mats to those beside K u.
  void add_soil_between_mats() {
    if (!soil_.rows().member()) return;
    std::vector<double> elongation(interface_.soil.size());
    std::vector<double> rate(elongation.size());
    for (std::size_t s = 0; s < systems_.size(); ++s) {
      soil_.set_displacement(s, displacement_[s].data(), {});
      soil_.set_velocity(s, displacement_[s].data(), {});  // not used
    }
    soil_.gather(elongation, rate);
    for (std::size_t r = 0; r < elongation.size(); ++r) {
      const double force = interface_.soil[r].impedance.stiffness * elongation[r];
      for (std::size_t s = 0; s < systems_.size(); ++s) {
        soil_.rows().add_force(static_cast<int>(r), force, s, law_force_[s]);
      }
    }
  }

  /// (K + sigma M)^-1 of the residual.
  void update_correction() {
    correction_ = residual_;
    for (std::size_t s = 0; s < correction_.size(); ++s) stiffness_[s]->solve(correction_[s]);
  }

  /// r^T (K + sigma M)^-1 r of the residual per structure, the same on all ranks.
  std::vector<double> squares_of_residual() const {
    std::vector<double> squares;
    for (std::size_t s = 0; s < residual_.size(); ++s) {
      squares.push_back(std::inner_product(residual_[s].begin(), residual_[s].end(),
                                           correction_[s].begin(), 0.0));
    }
    reduce_over_ranks(comm_, MPI_SUM, squares);
    return squares;
  }

  /// The root of it over all structures.
  double size_of_residual() const {
    const std::vector<double> squares = squares_of_residual();
    return std::sqrt(std::abs(std::accumulate(squares.begin(), squares.end(), 0.0)));
  }

  double relative_residual() const {
    return weight_size_ > 0 ? size_of_residual() / weight_size_ : 0;
  }

  [[noreturn]] void refuse(double left) const {
    const std::vector<double> squares = squares_of_residual();
    const auto worst = std::max_element(squares.begin(), squares.end()) - squares.begin();
    throw UserError(sentence(
        "option -preload static: structure {} finds no rest under its weight and loads, {} of it "
        "is left after {} iterations: {}nothing holds it, or less than 0.1 Hz; clamp it, give it "
        "springs or a contact below{}, look at the units of mesh and materials, or leave -preload "
        "out",
        {systems_[static_cast<std::size_t>(worst)].name, left, iterations_,
         ever_yielded_ ? "its yielding elements carry less, or " : "",
         any_open_at_rest_ ? " (a contact with a positive gap is open at rest: give -<contact>_gap "
                             "0, or -<contact>_gap_at unloaded)"
                           : ""}));
  }

  Equilibrium describe() {
    Equilibrium result;
    result.iterations = iterations_;
    result.residual = relative_residual();
    result.rows_tried = tried_.count();
    result.displacement = displacement_;
    const std::vector<double> openings = rows_.responses(displacement_);
    result.opening.assign(openings.begin(), openings.begin() + rows_.contacts());
    const std::vector<double>& forces = tried_.forces();
    result.contact_force.assign(forces.begin(), forces.begin() + rows_.contacts());
    for (int i = rows_.contacts(); i < rows_.size(); ++i) {
      ++(forces[i] > 0 ? result.acting_links : result.idle_links);
    }
    const Fields of_contacts = tried_.on_dofs(0, rows_.contacts());
    const Fields of_links = tried_.on_dofs(rows_.contacts(), rows_.size());
    for (std::size_t s = 0; s < systems_.size(); ++s) {
      result.law_force.emplace_back();
      if (yielded_ && systems_[s].has_laws(false)) {
        std::vector<double>& force = result.law_force.back();
        force.assign(displacement_[s].size(), 0.0);
        add_law_forces(systems_[s], false, meshes_[s], displacement_[s], force);
      }
      result.gravity_potential -=
          std::inner_product(weight_[s].begin(), weight_[s].end(), displacement_[s].begin(), 0.0);
      result.structures.push_back(describe_rest(
          comm_, systems_[s], meshes_[s], *stiffness_[s],
          {displacement_[s], weight_[s], law_force_[s], of_contacts[s], of_links[s], pushed(s)}));
    }
    reduce_over_ranks(comm_, MPI_SUM, result.gravity_potential);
    return result;
  }

  /// Sum of the contact forces on a structure [N].
  Vector3 pushed(std::size_t s) const {
    Vector3 sum{0, 0, 0};
    for (std::size_t k = 0; k < interface_.constraints.size(); ++k) {
      for (const interactions::ConstraintTerm& term : interface_.constraints[k].terms) {
        if (term.structure != static_cast<int>(s)) continue;
        sum[term.component] += term.coefficient * tried_.forces()[k];
      }
    }
    return sum;
  }

  static void add(const std::vector<double>& more, std::vector<double>& to) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += more[i];
  }

  MPI_Comm comm_;
  std::span<const LinearSystem> systems_;
  std::span<const Mesh> meshes_;
  const interactions::Interface& interface_;
  bool any_open_at_rest_;  ///< contacts whose gaps are those of the rest
  UnilateralRows rows_;
  interactions::CoupledRows soil_;                           ///< between mats
  std::vector<std::unique_ptr<StaticStiffness>> stiffness_;  ///< per structure
  Fields weight_;                                            ///< and loads as they are at rest
  std::vector<RestLinks> links_;                             ///< per structure
  Fields displacement_;
  Fields law_force_;           ///< g of `displacement_`, of elements that yield
  bool yielded_ = false;       ///< any of them, on any rank
  bool ever_yielded_ = false;  ///< in any iterate
  std::vector<Trial> trials_;  ///< the last ones, where elements yield
  Fields residual_;            ///< M g + p + R^T f - K u - g
  Fields correction_;          ///< (K + sigma M)^-1 of it
  double weight_size_ = 0;     ///< see size_of_residual, of the weight
  TriedRows tried_;            ///< forces of the rows
  int iterations_ = 0;
};

}  // namespace

Equilibrium find_equilibrium(MPI_Comm comm, std::span<const LinearSystem> systems,
                             std::span<const Mesh> meshes, const interactions::Interface& interface,
                             std::span<const char> open_rows, SolverChoice solver) {
  return Search(comm, systems, meshes, interface, open_rows, solver).find();
}

}  // namespace pounding
