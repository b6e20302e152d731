#include "solvers/law_solver.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "common/array_reductions.h"
#include "common/dense_matrix.h"
#include "common/integer_sets.h"
#include "common/row_products.h"

namespace pounding::interactions {
namespace {

constexpr int most_law_sweeps = 1000;
constexpr double settled = 1e-15;  ///< change of a force over the largest

/// Rows with a rate on one body from which on they are solved for by its motions, and how strong
/// they may be all together, dt^2 B^T M^-1 B rate, for that to keep ten digits.
constexpr std::size_t many = 2 * std::tuple_size_v<OnBody::Motion>;
constexpr double strongest = 1e6;

double motion_product(const OnBody::Motion& a, const OnBody::Motion& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

LawMemory::LawMemory(std::span<const std::unique_ptr<LinkLaw>> laws) {
  for (const auto& law : laws) begin_.push_back(begin_.back() + law->memory_size());
  values_.assign(begin_.back(), 0.0);
}

LawSolver::LawSolver(Laws laws, std::vector<std::vector<Coupling>> couplings,
                     std::vector<OnBody> on_body, double time_step)
    : laws_(laws),
      time_step_(time_step),
      coupled_(std::move(couplings)),
      on_body_(std::move(on_body)) {
  for (std::vector<Coupling>& coupled : coupled_) {
    for (Coupling& coupling : coupled) coupling.compliance *= time_step * time_step;
  }
  int bodies = 0;
  for (const OnBody& row : on_body_) bodies = std::max(bodies, row.body + 1);
  pull_.assign(static_cast<std::size_t>(bodies), {});
  block_pull_ = pull_;
  rate_.assign(laws_.size(), 0.0);
  find_blocks();
  explicit_ = std::ranges::all_of(others_, [&](std::size_t b) { return laws_[b]->is_explicit(); });
  const bool holds = bodies == 0 && blocks_.empty() && std::ranges::all_of(laws_, [](auto& law) {
                       return law->holds_a_known_force();
                     });
  if (!holds) return;
  for (const std::vector<Coupling>& coupled : coupled_) {
    double& sum = reach_.emplace_back(0);
    for (const Coupling& other : coupled) sum += std::abs(other.compliance);
  }
}

void LawSolver::find_blocks() {
  const auto has_rate = [&](std::size_t row) { return laws_[row]->rate() > 0; };
  DisjointSets sets(laws_.size());
  for (std::size_t b = 0; b < laws_.size(); ++b) {
    if (!has_rate(b)) others_.push_back(b);
    for (const Coupling& coupling : coupled_[b]) {
      if (has_rate(b) && has_rate(coupling.row)) sets.join(b, coupling.row);
    }
  }
  std::map<int, std::size_t> first_on;  // row with a rate, by body
  for (std::size_t b = 0; b < laws_.size(); ++b) {
    if (!has_rate(b) || body_of(b) < 0) continue;
    sets.join(first_on.try_emplace(body_of(b), b).first->second, b);
  }
  std::map<std::size_t, std::size_t> block_of;  // by root
  std::vector<std::size_t> place(laws_.size(), 0);
  for (std::size_t b = 0; b < laws_.size(); ++b) {
    if (!has_rate(b)) continue;
    const auto [found, is_new] = block_of.try_emplace(sets.root(b), blocks_.size());
    if (is_new) blocks_.emplace_back();
    place[b] = blocks_[found->second].rows.size();
    blocks_[found->second].rows.push_back(b);
  }
  for (Block& block : blocks_) fill_block(block, place);
}

void LawSolver::fill_block(Block& block, const std::vector<std::size_t>& place) {
  const std::size_t count = block.rows.size();
  const double square = time_step_ * time_step_;
  block.free.assign(count, 0.0);
  block.force.assign(count, 0.0);
  block.body = body_of(block.rows.front());
  double strength = 0;
  for (const std::size_t b : block.rows) {
    if (body_of(b) != block.body) block.body = -1;
    if (body_of(b) < 0) continue;
    const Motion& motion = on_body_[b].motion;
    strength += square * laws_[b]->rate() * motion_product(motion, motion);
  }
  if (count < many || !(strength < strongest)) block.body = -1;
  if (block.body < 0) block.compliance.assign(count * count, 0.0);
  for (const std::size_t b : block.rows) {
    std::vector<Coupling>& coupled = coupled_[b];
    const auto has_rate = [&](const Coupling& c) { return laws_[c.row]->rate() > 0; };
    for (const Coupling& coupling : coupled) {
      if (block.body < 0 && has_rate(coupling)) {
        block.compliance[place[b] * count + place[coupling.row]] = coupling.compliance;
      }
    }
    for (const std::size_t other : block.rows) {
      if (block.body < 0 && body_of(b) >= 0 && body_of(b) == body_of(other)) {
        block.compliance[place[b] * count + place[other]] =
            square * motion_product(on_body_[b].motion, on_body_[other].motion);
      }
    }
    coupled.erase(std::remove_if(coupled.begin() + 1, coupled.end(), has_rate), coupled.end());
  }
}

void LawSolver::form_inverses(double share) {
  share_ = share;
  for (std::size_t b = 0; b < laws_.size(); ++b) rate_[b] = laws_[b]->rate(share);
  for (Block& block : blocks_) {
    if (block.body >= 0) {
      invert_on_body(block);
      continue;
    }
    const std::size_t count = block.rows.size();
    block.inverse.resize(count * count);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        // Round-off of the response must not spoil the symmetry.
        block.inverse[i * count + j] =
            share * (block.compliance[i * count + j] + block.compliance[j * count + i]) / 2;
      }
      block.inverse[i * count + i] += 1 / rate_[block.rows[i]];
    }
    if (!invert_definite(block.inverse)) {
      throw std::logic_error("the compliance of dashpots is not positive");
    }
  }
}

void LawSolver::invert_on_body(Block& block) {
  constexpr std::size_t n = std::tuple_size_v<Motion>;
  block.inverse.assign(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    block.inverse[i * n + i] = 1 / (share_ * time_step_ * time_step_);
    for (const std::size_t b : block.rows) {
      const Motion& motion = on_body_[b].motion;
      for (std::size_t j = 0; j < n; ++j) {
        block.inverse[i * n + j] += motion[i] * rate_[b] * motion[j];
      }
    }
  }
  if (!invert_definite(block.inverse)) {
    throw std::logic_error("the compliance of dashpots on a rigid body is not positive");
  }
}

bool LawSolver::is_idle(std::span<const double> now, const LawMemory& memory) const {
  return blocks_.empty() && std::ranges::all_of(others_, [&](std::size_t b) {
           return laws_[b]->is_idle(now[b], memory[b]);
         });
}

void LawSolver::solve(double share, const Elongations& elongations, std::span<const double> driven,
                      const LawMemory& memory, std::vector<double>& force) {
  std::fill(pull_.begin(), pull_.end(), Motion{});
  std::fill(block_pull_.begin(), block_pull_.end(), Motion{});
  if (share != share_) form_inverses(share);
  const Problem problem{elongations, driven, memory, force};
  if (!reach_.empty() && hold(problem)) return;
  if (explicit_) {
    solve_others(problem);
    for (Block& block : blocks_) solve_block(problem, block);
    return;
  }
  for (int i = 0; i < most_law_sweeps; ++i) {
    for (Block& block : blocks_) solve_block(problem, block);
    const double change = solve_others(problem);
    if (change <= settled * largest_magnitude(force)) break;
  }
}

bool LawSolver::hold(const Problem& problem) {
  const auto& [before, now, free_after] = problem.elongations;
  double largest = 0;
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    problem.force[r] = laws_[r]->full(now[r], problem.memory[r]);
    largest = std::max(largest, problem.force[r]);
  }
  for (std::size_t r = 0; r < laws_.size(); ++r) {
    const double least = free_after[r] - share_ * reach_[r] * largest;
    const double needed = laws_[r]->holds_down_to(before[r], problem.memory[r]);
    if (problem.force[r] > 0 && least < needed) return false;
  }
  return true;
}

double LawSolver::left_over(const Problem& problem, std::size_t row) const {
  double after = problem.elongations.free_after[row];
  const std::vector<Coupling>& coupled = coupled_[row];
  for (std::size_t k = 1; k < coupled.size(); ++k) {
    after -= share_ * coupled[k].compliance * problem.force[coupled[k].row];
  }
  if (body_of(row) < 0) return after;
  const auto& [body, motion] = on_body_[row];
  const bool has_rate = rate_[row] > 0;
  Motion others = pull_[body];
  for (std::size_t m = 0; !has_rate && m < others.size(); ++m) {
    others[m] += block_pull_[body][m] - problem.force[row] * motion[m];
  }
  return after - share_ * time_step_ * time_step_ * motion_product(motion, others);
}

void LawSolver::solve_block(const Problem& problem, Block& block) {
  const auto& [before, now, free_after] = problem.elongations;
  const std::size_t count = block.rows.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t b = block.rows[i];
    const double offset =
        laws_[b]->offset(before[b], now[b], share_, problem.memory[b]) - problem.driven[b];
    block.free[i] = left_over(problem, b) - before[b] + offset / rate_[b];
  }
  if (block.body >= 0) {
    solve_on_body(block);
  } else {
    multiply_rows(block.inverse.data(), count, count, block.free.data(), block.force.data(), 1);
  }
  for (std::size_t i = 0; i < count; ++i) problem.force[block.rows[i]] = block.force[i];
  renew_pull(problem, block);
}

void LawSolver::solve_on_body(Block& block) {
  // (share dt^2 G G^T + 1/r)^-1 = r - r G (1 / (share dt^2) + G^T r G)^-1 G^T r
  const std::size_t count = block.rows.size();
  Motion sum{};
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t b = block.rows[i];
    block.force[i] = rate_[b] * block.free[i];
    for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += block.force[i] * on_body_[b].motion[m];
  }
  Motion common{};
  multiply_rows(block.inverse.data(), sum.size(), sum.size(), sum.data(), common.data(), 1);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t b = block.rows[i];
    block.force[i] -= rate_[b] * motion_product(on_body_[b].motion, common);
  }
}

void LawSolver::renew_pull(const Problem& problem, const Block& block) {
  for (const std::size_t b : block.rows) {
    if (body_of(b) >= 0) block_pull_[body_of(b)] = {};
  }
  for (const std::size_t b : block.rows) {
    if (body_of(b) < 0) continue;
    const auto& [body, motion] = on_body_[b];
    for (std::size_t m = 0; m < motion.size(); ++m) {
      block_pull_[body][m] += problem.force[b] * motion[m];
    }
  }
}

double LawSolver::solve_others(const Problem& problem) {
  const auto& [before, now, free_after] = problem.elongations;
  double change = 0;
  for (const std::size_t b : others_) {
    // A bar that is slack is solved for as fast as it is asked.
    if (!reach_.empty() && laws_[b]->is_idle(now[b], problem.memory[b])) continue;
    double& old = problem.force[b];
    const double force = laws_[b]->solve(before[b], now[b], left_over(problem, b),
                                         share_ * coupled_[b][0].compliance, problem.memory[b]);
    change = std::max(change, std::abs(force - old));
    for (std::size_t m = 0; body_of(b) >= 0 && m < on_body_[b].motion.size(); ++m) {
      pull_[on_body_[b].body][m] += (force - old) * on_body_[b].motion[m];
    }
    old = force;
  }
  return change;
}

}  // namespace pounding::interactions
