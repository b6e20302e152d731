#include "interactions/dashpot_modes.h"

#include <algorithm>
#include <cmath>

#include "common/dense_matrix.h"
#include "interactions/structure_links.h"
#include "laws/dashpot_law.h"
#include "laws/law_of.h"
#include "system/links.h"
#include "system/trace.h"

namespace pounding::interactions {
namespace {

/// h lambda of motions that nothing is left of in a run: a damping of 1e-8 per second or less.
constexpr double unfelt = 1e-13;

}  // namespace

std::vector<double> link_rows(const LinearSystem& system) {
  const std::vector<Link>& links = system.links->links();
  const Trace& trace = system.links->trace();
  const std::size_t size = system.lumped_mass.size();
  std::vector<double> rows(links.size() * size, 0.0);
  for (std::size_t b = 0; b < links.size(); ++b) {
    for (std::size_t k = 0; k < links[b].point.size(); ++k) {
      if (links[b].point[k] < 0) continue;
      trace.add_force(static_cast<std::size_t>(links[b].point[k]), links[b].weight[k],
                      {&rows[b * size], size});
    }
  }
  return rows;
}

std::optional<DashpotRows> dashpot_rows(const LinearSystem& system) {
  if (!system.links || !system.generalised || !system.laws.empty()) return {};
  const std::vector<Link>& links = system.links->links();
  if (links.empty() || !carried_by_supports(system).empty()) return {};
  DashpotRows dashpots;
  for (const Link& link : links) {
    const auto law = law_of(link.origin, 0.5);  // whose rate c / (2 dt) is c
    if (!link.incident.empty() || dynamic_cast<const DashpotLaw*>(law.get()) == nullptr) {
      return {};
    }
    dashpots.strengths.push_back(law->rate());
  }
  dashpots.rows = link_rows(system);
  return dashpots;
}

DashpotModes::DashpotModes(const LinearSystem& system, const DashpotRows& dashpots, double step)
    : inverse_mass(system.inverse_mass), time_step(step) {
  const std::size_t size = inverse_mass.size();
  const std::vector<double>& strengths = dashpots.strengths;
  DenseMatrix scaled(strengths.size(), size);  // diag(c)^1/2 B M^-1/2
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t b = 0; b < strengths.size(); ++b) {
      scaled.column(i)[b] = std::sqrt(strengths[b] * inverse_mass[i]) * dashpots.rows[b * size + i];
    }
  }
  DenseMatrix vectors = transposed_product(scaled, scaled);
  const std::vector<double> values = symmetric_eigenvalues(vectors);
  for (std::size_t j = size; j > 0 && time_step / 2 * values[j - 1] > unfelt; --j) {
    lambda.push_back(values[j - 1]);
    for (std::size_t i = 0; i < size; ++i) {
      rows.push_back(std::sqrt(system.lumped_mass[i]) * vectors.column(j - 1)[i]);
    }
  }
}

DashpotMatrix::DashpotMatrix(DashpotModes modes)
    : modes_(std::move(modes)), weights_(modes_.lambda.size()) {
  const std::size_t size = modes_.inverse_mass.size();
  if (2 * weights_.size() > size) full_.resize(size * size);
}

void DashpotMatrix::set_share(double share) {
  if (share == share_) return;
  share_ = share;
  for (std::size_t j = 0; j < weights_.size(); ++j) {
    const double braked = share * modes_.time_step / 2 * modes_.lambda[j];
    weights_[j] = braked / (1 + braked);
  }
  if (full_.empty()) return;
  const std::size_t size = modes_.inverse_mass.size();
  std::ranges::fill(full_, 0.0);
  for (std::size_t j = 0; j < weights_.size(); ++j) {
    const double* const row = &modes_.rows[j * size];
    for (std::size_t i = 0; i < size; ++i) {
      const double weighted = weights_[j] * row[i];
      for (std::size_t k = 0; k <= i; ++k) full_[i * size + k] += weighted * row[k];
    }
  }
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t k = 0; k < i; ++k) full_[k * size + i] = full_[i * size + k];
  }
}

}  // namespace pounding::interactions
