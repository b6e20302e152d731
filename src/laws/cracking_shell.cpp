#include "laws/cracking_shell.h"

#include <algorithm>
#include <cmath>

namespace pounding::interactions {
namespace {

constexpr double of_strains = 4e-16;         ///< where roots stop, over their size
constexpr double of_shell_energies = 1e-14;  ///< round-off over their largest part
constexpr int most_steps = 200;

/// Principal values of a symmetric tensor with components xx, yy and 2 xy, and the direction of the
/// first one.
struct Principal {
  std::array<double, 2> values{};
  double cosine = 1, sine = 0;
  double trace() const { return values[0] + values[1]; }
};

Principal principal_of(double xx, double yy, double twice_xy) {
  const double half = (xx - yy) / 2;
  const double radius = std::hypot(half, twice_xy / 2);
  const double middle = (xx + yy) / 2;
  if (radius == 0) return {{middle, middle}, 1, 0};
  const double angle = std::atan2(twice_xy / 2, half) / 2;
  return {{middle + radius, middle - radius}, std::cos(angle), std::sin(angle)};
}

/// Writes a tensor with these principal values in the directions of another one.
void write_turned(const Principal& axes, const std::array<double, 2>& values, double* components) {
  const double c = axes.cosine, s = axes.sine;
  components[0] = c * c * values[0] + s * s * values[1];
  components[1] = s * s * values[0] + c * c * values[1];
  components[2] = c * s * (values[0] - values[1]);
}

double square(double x) {
  return x * x;
}

/// The positive root of a x^2 + b x = c, a >= 0, c >= 0.
double rising_root(double a, double b, double c) {
  const double root = std::sqrt(b * b + 4 * a * c);
  return b > 0 ? 2 * c / (b + root) : (root - b) / (2 * a);
}

}  // namespace

/// Parts of -d psi / d damage that strains make.
struct CrackingShell::Drive {
  double trace = 0;
  double by_strains = 0;  ///< sum of mu/2 (1 - g_i) e_i^2
  double by_sum = 0;      ///< lambda/4 (1 - g), times (tr e + e3)^2
  double lower = 0;       ///< of d1 by bending
  double upper = 0;
};

CrackingShell::CrackingShell(double young, double poisson, double thickness,
                             const ShellCracking& cracking)
    : tension_(cracking.tension),
      compression_(cracking.compression),
      bending_(cracking.bending),
      poisson_(poisson) {
  const double inertia = thickness * thickness * thickness / 12;
  lambda_ = young * poisson / ((1 + poisson) * (1 - 2 * poisson)) * thickness;
  mu_ = young / (2 * (1 + poisson)) * thickness;
  lambda_f_ = young * poisson / (1 - poisson * poisson) * inertia;
  mu_f_ = young / (2 * (1 + poisson)) * inertia;
  const double stretch = cracking.force / (young * thickness);  // of uniaxial tension
  threshold_ = square(stretch) / 4 *
               (lambda_ * (1 - tension_) * square(1 - 2 * poisson) +
                2 * mu_ * (1 - tension_ + (1 - compression_) * square(poisson)));
  const double curvature = cracking.moment / (lambda_f_ * (1 - poisson) + 2 * mu_f_);
  alpha_ = (1 - bending_) * square(curvature) / threshold_ *
           (lambda_f_ / 2 * square(1 - poisson) + mu_f_);
}

ShellCracking CrackingShell::with_slopes(ShellCracking law, double poisson) {
  if (poisson == 0) return law;
  // Where damages are large xi is g along the strip, c across, and 1 through the thickness; strains
  // across follow from no force there, so s (1 + nu) = g (1 + p / (1 + p g (1 + 1 / c))).
  const double p = poisson / (1 - 2 * poisson), c = law.compression;
  const double pulled = law.tension * (1 + poisson);
  law.tension = rising_root(p * (1 + c), c * (1 + p) - pulled * p * (1 + c), pulled * c);
  // The other face stays sound: s (1 + nu) (1 - nu + nu g) = g (1 + nu g).
  const double bent = law.bending * (1 + poisson);
  law.bending = rising_root(poisson, 1 - bent * poisson, bent * (1 - poisson));
  return law;
}

CrackingShell::Drive CrackingShell::drive_of(const ShellVector& e) const {
  Drive drive;
  const Principal membrane = principal_of(e[0], e[1], e[2]);
  const Principal bending = principal_of(e[3], e[4], e[5]);
  drive.trace = membrane.trace();
  for (const double strain : membrane.values) {
    drive.by_strains += mu_ / 2 * (1 - ratio(strain)) * strain * strain;
  }
  drive.by_sum = lambda_ / 4 * (1 - ratio(drive.trace));
  const auto add = [&](double strain, double stiffness) {
    (strain > 0 ? drive.upper : drive.lower) +=
        alpha_ * (1 - bending_) * stiffness * strain * strain;
  };
  add(bending.trace(), lambda_f_ / 2);
  for (const double curvature : bending.values) add(curvature, mu_f_);
  return drive;
}

/// Root of membrane / (1 + d)^2 + bending / (a + d)^2 = Y0 beyond a damage: Newton's steps on a
/// function that falls and is convex come up to it from below.
double CrackingShell::grown_one(double membrane, double bending, double before) const {
  double d = before;
  for (int step = 0; step < most_steps; ++step) {
    const double of_membrane = membrane / square(1 + d);
    const double of_bending = bending / square(alpha_ + d);
    const double above = of_membrane + of_bending - threshold_;
    if (!(above > 0)) break;
    const double by = above / (2 * (of_membrane / (1 + d) + of_bending / (alpha_ + d)));
    d += by;
    if (by <= of_strains * (1 + d)) break;
  }
  return d;
}

CrackingShell::Damage CrackingShell::grown_at(const Drive& drive, double sum,
                                              const Damage& before) const {
  const double membrane = drive.by_strains + drive.by_sum * sum * sum;
  return {grown_one(membrane, drive.lower, before.lower),
          grown_one(membrane, drive.upper, before.upper)};
}

CrackingShell::Damage CrackingShell::grown(const ShellVector& strains, const Damage& before) const {
  const Drive drive = drive_of(strains);
  const double trace = drive.trace;
  const double least = sum_of_strains(trace, 1);
  if (drive.by_sum == 0) return grown_at(drive, least, before);
  // e3 is at rest at a sum of strains between that of the sound shell and the trace.
  const auto unbalance = [&](double sum) {
    const double kept = retained(trace, grown_at(drive, sum, before));
    return (sum * (2 * mu_ + lambda_ * kept) - 2 * mu_ * trace) * (trace > 0 ? 1 : -1);
  };
  double low = least, high = trace;
  double below = unbalance(low), above = unbalance(high);
  for (int step = 0; step < most_steps && above > 0 && below < 0; ++step) {
    if (std::abs(high - low) <= of_strains * std::abs(trace)) break;
    // The secant, kept off the ends of the bracket; halves wherever that is slow.
    const double part = step % 3 == 2 ? 0.5 : below / (below - above);
    const double middle = low + std::clamp(part, 1e-3, 1 - 1e-3) * (high - low);
    if (middle == low || middle == high) break;
    const double at = unbalance(middle);
    (at < 0 ? low : high) = middle;
    (at < 0 ? below : above) = at;
    if (at == 0) break;
  }
  if (!(below < 0)) return grown_at(drive, low, before);
  return grown_at(drive, above == 0 ? high : low, before);
}

double CrackingShell::retained(double strain, const Damage& d) const {
  const double g = ratio(strain);
  return (1 + g * d.lower) / (1 + d.lower) / 2 + (1 + g * d.upper) / (1 + d.upper) / 2;
}

double CrackingShell::retained_in_bending(double strain, const Damage& damage) const {
  const double d = strain > 0 ? damage.upper : damage.lower;
  return (alpha_ + bending_ * d) / (alpha_ + d);
}

double CrackingShell::energy(const ShellVector& e, const Damage& damage) const {
  const Principal membrane = principal_of(e[0], e[1], e[2]);
  const Principal bending = principal_of(e[3], e[4], e[5]);
  const double trace = membrane.trace();
  const double kept = retained(trace, damage);
  double sum = kept * lambda_ * sum_of_strains(trace, kept) * trace / 2;
  for (const double strain : membrane.values) {
    sum += mu_ * retained(strain, damage) * strain * strain;
  }
  sum += lambda_f_ / 2 * retained_in_bending(bending.trace(), damage) * square(bending.trace());
  for (const double k : bending.values) sum += mu_f_ * retained_in_bending(k, damage) * k * k;
  return sum;
}

ShellVector CrackingShell::forces(const ShellVector& e, const Damage& damage) const {
  const Principal membrane = principal_of(e[0], e[1], e[2]);
  const Principal bending = principal_of(e[3], e[4], e[5]);
  const double kept = retained(membrane.trace(), damage);
  const double all = lambda_ * kept * sum_of_strains(membrane.trace(), kept);
  const double turned = lambda_f_ * retained_in_bending(bending.trace(), damage) * bending.trace();
  std::array<double, 2> normal{}, moment{};
  for (std::size_t i = 0; i < 2; ++i) {
    const double strain = membrane.values[i], curvature = bending.values[i];
    normal[i] = all + 2 * mu_ * retained(strain, damage) * strain;
    moment[i] = turned + 2 * mu_f_ * retained_in_bending(curvature, damage) * curvature;
  }
  ShellVector result{};
  write_turned(membrane, normal, result.data());
  write_turned(bending, moment, &result[3]);
  return result;
}

double CrackingShell::loading(const ShellVector& strains) const {
  const Drive drive = drive_of(strains);
  const double membrane = drive.by_strains + drive.by_sum * square(sum_of_strains(drive.trace, 1));
  const double bending = std::max(drive.lower, drive.upper) / square(alpha_);
  return std::sqrt((membrane + bending) / threshold_);
}

double CrackingShell::loading_bound(const ShellVector& e) const {
  const auto trace = [&](std::size_t i) { return square(e[i] + e[i + 1]); };
  const auto squares = [&](std::size_t i) {
    return square(e[i]) + square(e[i + 1]) + square(e[i + 2]) / 2;
  };
  const double membrane =
      lambda_ / 4 * square(sum_of_strains(1, 1)) * trace(0) + mu_ / 2 * squares(0);
  const double bending = lambda_f_ / 2 * trace(3) + mu_f_ * squares(3);
  return ((1 - std::min(tension_, compression_)) * membrane + (1 - bending_) / alpha_ * bending) /
         threshold_;
}

ShellVector CrackingShell::sound_forces(const ShellVector& e) const {
  const double plane = 2 * mu_ * lambda_ / (2 * mu_ + lambda_);
  const double all = plane * (e[0] + e[1]), turned = lambda_f_ * (e[3] + e[4]);
  return {all + 2 * mu_ * e[0],      all + 2 * mu_ * e[1],      mu_ * e[2],
          turned + 2 * mu_f_ * e[3], turned + 2 * mu_f_ * e[4], mu_f_ * e[5]};
}

double CrackingShell::complementary(const ShellVector& a, const ShellVector& b) const {
  // E t is 2 mu (1 + nu), and that of bending likewise.
  const auto part = [&](std::size_t i, double mu) {
    return (a[i] * b[i] + a[i + 1] * b[i + 1] - poisson_ * (a[i] * b[i + 1] + a[i + 1] * b[i])) /
               (2 * mu * (1 + poisson_)) +
           a[i + 2] * b[i + 2] / mu;
  };
  return part(0, mu_) + part(3, mu_f_);
}

void CrackingLaw::advance(const ShellVector& strains, std::span<double> memory) const {
  if (const double bound = shell_.loading_bound(strains); is_sound(memory) && bound < 1) {
    std::ranges::copy(strains, memory.begin() + strains_now);
    std::ranges::copy(shell_.sound_forces(strains), memory.begin() + forces_now);
    if (bound > square(memory[most])) {
      memory[most] = std::max(memory[most], shell_.loading(strains));
    }
    return;
  }
  const ShellVector forces_before = vector(memory, forces_now);
  const ShellVector strains_before = vector(memory, strains_now);
  const CrackingShell::Damage damage = shell_.grown(strains, this->damage(memory));
  ShellVector way{};
  for (std::size_t i = 0; i < way.size(); ++i) way[i] = strains[i] - strains_before[i];
  ShellVector force = damage.any() ? shell_.forces(strains, damage) : shell_.sound_forces(strains);
  if (damage.any()) {
    const double extra =
        std::max(0.0, shell_.energy(strains, damage) - shell_.complementary(force, force) / 2);
    ShellVector start = forces_before, end = force;  // less and more than the middle
    const ShellVector step = shell_.sound_forces(way);
    for (std::size_t i = 0; i < step.size(); ++i) {
      start[i] += step[i] / 2;
      end[i] -= step[i] / 2;
    }
    const double begins = shell_.complementary(start, start) / 2 + memory[beyond];
    const double ends = shell_.complementary(end, end) / 2;
    const double scale = begins + ends + extra;
    double held = begins - ends;
    if (held < -of_shell_energies * scale) {
      const double kept = std::sqrt(begins / ends);
      for (std::size_t i = 0; i < force.size(); ++i) force[i] = step[i] / 2 + kept * end[i];
      held = 0;
    }
    const double kept = held >= extra - of_shell_energies * scale ? extra : std::max(0.0, held);
    memory[lost_so_far] += held - kept;
    memory[beyond] = kept;
  }
  std::ranges::copy(strains, memory.begin() + strains_now);
  std::ranges::copy(force, memory.begin() + forces_now);
  memory[damage_now] = damage.lower;
  memory[damage_now + 1] = damage.upper;
  memory[most] = std::max(memory[most], shell_.loading(strains));
}

double CrackingLaw::stored(std::span<const double> memory) const {
  const ShellVector force = forces(memory);
  return shell_.complementary(force, force) / 2 + memory[beyond];
}

ShellVector CrackingLaw::vector(std::span<const double> memory, std::size_t first) {
  ShellVector result{};
  std::copy_n(memory.begin() + static_cast<std::ptrdiff_t>(first), result.size(), result.begin());
  return result;
}

}  // namespace pounding::interactions
