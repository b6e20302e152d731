#include "model/separation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "common/parallel.h"
#include "motion/modal_combination.h"
#include "motion/response_spectrum.h"
#include "stability/stable_time_step.h"

namespace pounding {
namespace {

constexpr std::size_t most_pairs = 500;  // of a contact: of more, every n-th
constexpr double below_critical = 0.99;  // of damping ratios, for the spectra

/// Frequency [Hz] and damping ratio at which a mode of a structure swings.
struct Swing {
  double frequency, ratio;
};

Swing swing_of(const Building& building, std::size_t mode) {
  const double frequency = building.modal.modes[mode].frequency;
  const double weight = building.modal.modes[mode].damping_weight;
  if (building.system->uniform_damping) {
    const UniformDamping& uniform = *building.system->uniform_damping;
    const double moved = uniform.moved(frequency);
    return {moved, uniform.ratio_at(2 * std::numbers::pi * moved)};
  }
  const Structure& structure = *building.structure;
  if (structure.modal && !structure.modal->damping_ratios.empty()) {
    const std::vector<double>& ratios = structure.modal->damping_ratios;
    return {frequency, weight * ratios[std::min(mode, ratios.size() - 1)]};
  }
  return {frequency, weight * damping_ratio(structure.damping, 2 * std::numbers::pi * frequency)};
}

/// Peaks of the generalised coordinate of each mode [m kg^1/2], per direction of the ground, with
/// the sign of the participation; zero for a mode that does not swing.
struct ModalPeaks {
  std::vector<double> frequency, ratio;
  std::vector<std::array<double, 3>> peak;
};

ModalPeaks modal_peaks(const Building& building, const GroundMotion& motion) {
  ModalPeaks result;
  for (std::size_t i = 0; i < building.modal.modes.size(); ++i) {
    const Mode& mode = building.modal.modes[i];
    const Swing swing = swing_of(building, i);
    result.frequency.push_back(swing.frequency);
    result.ratio.push_back(std::min(swing.ratio, below_critical));
    std::array<double, 3>& peak = result.peak.emplace_back();
    if (!mode.location.empty() || swing.frequency <= 0) continue;
    for (int d = 0; d < 3; ++d) {
      const Accelerogram& ground = motion.component(d);
      if (ground.acceleration.empty()) continue;
      peak[d] = mode.participation[d] * response_spectrum(ground.acceleration, ground.time_step,
                                                          std::span(&result.frequency.back(), 1),
                                                          result.ratio.back())
                                            .front()
                                            .displacement;
    }
  }
  return result;
}

/// The modes of both sides of a joint one after the other.
class JointPeaks {
 public:
  JointPeaks(const Building* secondary, const Building* primary, const std::vector<ModalPeaks>& all,
             std::span<const Building> buildings)
      : sides_{secondary, primary} {
    for (const Building* side : sides_) {
      if (side == nullptr) continue;
      const ModalPeaks& peaks = all[static_cast<std::size_t>(side - buildings.data())];
      modes_.frequency.insert(modes_.frequency.end(), peaks.frequency.begin(),
                              peaks.frequency.end());
      modes_.ratio.insert(modes_.ratio.end(), peaks.ratio.begin(), peaks.ratio.end());
      modes_.peak.insert(modes_.peak.end(), peaks.peak.begin(), peaks.peak.end());
    }
    border_ = secondary->modal.modes.size();
    correlations_.emplace(modes_.frequency, modes_.ratio);
    largest_.assign(modes_.frequency.size(), 0);
  }

  /// Takes a row of the contact operator into the largest values.
  void take(std::size_t row, std::size_t rows, Separation& found) {
    const std::size_t count = modes_.frequency.size();
    std::array<double, 3> square{};  // of the secondary, of the primary, of both
    for (int d = 0; d < 3; ++d) {
      std::vector<double> peaks(count);
      for (std::size_t i = 0; i < count; ++i) {
        const Building& side = i < border_ ? *sides_[0] : *sides_[1];
        const std::size_t mode = i < border_ ? i : i - border_;
        peaks[i] = side.mode_gaps[mode * rows + row] * modes_.peak[i][d];
        largest_[i] = std::max(largest_[i], std::abs(peaks[i]));
      }
      square[0] += std::pow(correlations_->combined(peaks, 0, border_), 2);
      square[1] += std::pow(correlations_->combined(peaks, border_, count), 2);
      square[2] += std::pow(correlations_->combined(peaks, 0, count), 2);
    }
    const double u1 = std::sqrt(square[0]);
    const double u2 = std::sqrt(square[1]);
    pairs_.push_back({u1, u2});
    found.secondary.peak = std::max(found.secondary.peak, u1);
    found.primary.peak = std::max(found.primary.peak, u2);
    found.sum = std::max(found.sum, u1 + u2);
    found.srss = std::max(found.srss, std::hypot(u1, u2));
    found.modal = std::max(found.modal, std::sqrt(square[2]));
  }

  /// The difference rule, which needs the modes that move the sides most.
  void close(Separation& found) const {
    const std::size_t count = largest_.size();
    const auto most = [&](std::size_t first, std::size_t last) {
      return static_cast<std::size_t>(
          std::max_element(largest_.begin() + static_cast<std::ptrdiff_t>(first),
                           largest_.begin() + static_cast<std::ptrdiff_t>(last)) -
          largest_.begin());
    };
    const std::size_t first = most(0, border_);
    found.secondary.modes = static_cast<int>(border_);
    found.secondary.frequency = modes_.frequency[first];
    found.secondary.ratio = modes_.ratio[first];
    if (border_ < count) {
      const std::size_t second = most(border_, count);
      found.primary.modes = static_cast<int>(count - border_);
      found.primary.frequency = modes_.frequency[second];
      found.primary.ratio = modes_.ratio[second];
      found.correlation = correlations_->at(first, second);
    }
    for (const auto& [u1, u2] : pairs_) {
      const double square = u1 * u1 + u2 * u2 - 2 * found.correlation * u1 * u2;
      found.ddc = std::max(found.ddc, std::sqrt(std::max(0.0, square)));
    }
  }

 private:
  std::array<const Building*, 2> sides_;
  ModalPeaks modes_;
  std::size_t border_ = 0;
  std::optional<ModalCorrelations> correlations_;
  std::vector<double> largest_;                   ///< contribution of each mode to a gap [m]
  std::vector<std::pair<double, double>> pairs_;  ///< u1, u2 of the rows taken [m]
};

const Building* building_of(const Model& model, const ContactSide& side) {
  const auto found = std::ranges::find(model.buildings, side.structure, &Building::name);
  return found == model.buildings.end() ? nullptr : &*found;
}

}  // namespace

std::vector<double> modes_at_contacts(MPI_Comm comm, const Model& model, std::size_t structure) {
  const Building& building = model.buildings[structure];
  const Mesh& mesh = model.meshes[structure];
  const std::vector<interactions::Constraint>& rows = model.interface.constraints;
  const std::size_t modes = building.modal.modes.size();
  std::vector<double> gaps(modes * rows.size(), 0);
  std::vector<std::size_t> vectors;  // of the basis that are modes
  std::map<TracePoint, std::size_t> places;
  if (building.basis && !building.basis->rows.empty()) {
    const ModalBasis& basis = *building.basis;
    for (std::size_t i = 0; i < basis.size() && vectors.size() < modes; ++i) {
      if (basis.mode_numbers[i] != 0) vectors.push_back(i);
    }
    for (std::size_t p = 0; p < basis.points.size(); ++p) places[basis.points[p]] = p;
  }
  int having = building.basis && vectors.empty() ? 0 : 1;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (const interactions::ConstraintTerm& term : rows[r].terms) {
      if (term.structure != static_cast<int>(structure)) continue;
      if (building.basis) {
        const auto place = places.find({term.node, term.component});
        if (place == places.end()) continue;
        for (std::size_t i = 0; i < vectors.size(); ++i) {
          gaps[i * rows.size() + r] +=
              term.coefficient *
              building.basis->rows[place->second * building.basis->size() + vectors[i]];
        }
        continue;
      }
      const LocalIndex dof = mesh.owned_dof(term.node, term.component);
      for (std::size_t i = 0; dof >= 0 && i < modes; ++i) {
        gaps[i * rows.size() + r] += term.coefficient * building.modal.modes[i].shape[dof];
      }
    }
  }
  reduce_over_ranks(comm, MPI_SUM, gaps);
  if (building.basis) {
    reduce_over_ranks(comm, MPI_SUM, having);
    for (double& gap : gaps) gap /= std::max(1, having);
  }
  return gaps;
}

std::vector<Separation> find_separations(const Scene& scene, const Model& model) {
  std::vector<Separation> found;
  if (model.supports || model.load_histories || model.motion->from_below() ||
      model.motion->peak_acceleration() == 0) {
    return found;
  }
  std::vector<ModalPeaks> peaks;
  for (const Building& building : model.buildings) {
    peaks.push_back(modal_peaks(building, *model.motion));
  }
  const std::vector<interactions::Constraint>& rows = model.interface.constraints;
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    const Contact& contact = scene.contacts[c];
    const Building* secondary = building_of(model, contact.secondary);
    const Building* primary = building_of(model, contact.primary);
    const bool apart = secondary != primary && !secondary->modal.modes.empty() &&
                       (primary == nullptr || !primary->modal.modes.empty());
    std::vector<std::size_t> own;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (rows[r].contact == static_cast<int>(c)) own.push_back(r);
    }
    if (!apart || own.empty()) continue;
    Separation separation;
    separation.contact = c;
    separation.secondary.structure = contact.secondary.structure;
    separation.primary.structure = contact.primary.structure;
    separation.gap = model.joint_gaps[c].at_rest[0];
    JointPeaks joint(secondary, primary, peaks, model.buildings);
    const std::size_t stride = 1 + (own.size() - 1) / most_pairs;
    for (std::size_t i = 0; i < own.size(); i += stride) {
      joint.take(own[i], rows.size(), separation);
    }
    joint.close(separation);
    found.push_back(separation);
  }
  return found;
}

}  // namespace pounding
