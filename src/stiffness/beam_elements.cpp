#include "stiffness/beam_elements.h"

#include <cstddef>

#include "elements/beam2.h"
#include "elements/local_frame.h"

namespace pounding::stiffness {
namespace {

constexpr std::size_t beams_at_once = sizeof(Lanes) / sizeof(double);

/// Three components of four beams.
struct Vectors {
  Lanes x, y, z;
};

inline Vectors gather(const double* w, const std::array<LocalIndex, 4>& start, int first) {
  const auto component = [&](int c) {
    return Lanes{w[start[0] + c], w[start[1] + c], w[start[2] + c], w[start[3] + c]};
  };
  return {component(first), component(first + 1), component(first + 2)};
}

inline Vectors to_local(const Lanes* axes, const Vectors& v) {
  return {axes[0] * v.x + axes[1] * v.y + axes[2] * v.z,
          axes[3] * v.x + axes[4] * v.y + axes[5] * v.z,
          axes[6] * v.x + axes[7] * v.y + axes[8] * v.z};
}

inline Vectors to_global(const Lanes* axes, const Vectors& v) {
  return {axes[0] * v.x + axes[3] * v.y + axes[6] * v.z,
          axes[1] * v.x + axes[4] * v.y + axes[7] * v.z,
          axes[2] * v.x + axes[5] * v.y + axes[8] * v.z};
}

/// Adds forces and moments to the nodes of four beams, one after the other: they may be the same.
inline void scatter(const Vectors& force, const Vectors& moment,
                    const std::array<LocalIndex, 4>& start, double* q) {
  const Lanes xy_low = __builtin_shufflevector(force.x, force.y, 0, 4, 2, 6);
  const Lanes xy_high = __builtin_shufflevector(force.x, force.y, 1, 5, 3, 7);
  const Lanes zx_low = __builtin_shufflevector(force.z, moment.x, 0, 4, 2, 6);
  const Lanes zx_high = __builtin_shufflevector(force.z, moment.x, 1, 5, 3, 7);
  const Lanes first[beams_at_once] = {__builtin_shufflevector(xy_low, zx_low, 0, 1, 4, 5),
                                      __builtin_shufflevector(xy_high, zx_high, 0, 1, 4, 5),
                                      __builtin_shufflevector(xy_low, zx_low, 2, 3, 6, 7),
                                      __builtin_shufflevector(xy_high, zx_high, 2, 3, 6, 7)};
  for (std::size_t b = 0; b < beams_at_once; ++b) {
    double* const node = q + start[b];
    Lanes sum;
    load(node, sum);
    store(node, sum + first[b]);
    node[4] += moment.y[b];
    node[5] += moment.z[b];
  }
}

inline Vectors minus(const Vectors& v) {
  return {-v.x, -v.y, -v.z};
}

}  // namespace

BeamElements::Beam BeamElements::make(const std::array<LocalIndex, 2>& start,
                                      std::span<const double> coordinates,
                                      const ElementProperties& properties) {
  const auto [direction, length] = segment_between(coordinates);
  const double young = properties.young;
  const double shear = young / (2 * (1 + properties.poisson));
  const auto bending = [young, length = length](double inertia, double phi) {
    const double rigidity = young * inertia / length;
    return std::array<double, 4>{12 * rigidity / (length * length) / (1 + phi),
                                 6 * rigidity / length / (1 + phi), 2 * rigidity,
                                 (2 - phi) / (2 * (1 + phi))};
  };
  const ShearFlexibility phi = shear_flexibility(properties, length);
  Beam beam;
  beam.start = start;
  beam.axes = local_frame(direction, properties.z_axis);
  beam.stretch = young * properties.area / length;
  beam.twist = shear * properties.torsion / length;
  beam.bending_y = bending(properties.inertia_z, phi.y);
  beam.bending_z = bending(properties.inertia_y, phi.z);
  return beam;
}

BeamElements::BeamElements(const std::vector<Beam>& beams, LocalIndex idle) {
  Batch empty;
  for (auto& slots : empty.start) slots.fill(idle);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const std::size_t lane = i % beams_at_once;
    if (lane == 0) batches_.push_back(empty);
    Batch& batch = batches_.back();
    const Beam& beam = beams[i];
    for (std::size_t node = 0; node < 2; ++node) batch.start[node][lane] = beam.start[node];
    for (std::size_t k = 0; k < 9; ++k) batch.axes[k][lane] = beam.axes[k / 3][k % 3];
    batch.stretch[lane] = beam.stretch;
    batch.twist[lane] = beam.twist;
    for (std::size_t k = 0; k < 4; ++k) {
      batch.bending_y[k][lane] = beam.bending_y[k];
      batch.bending_z[k][lane] = beam.bending_z[k];
    }
  }
}

void BeamElements::apply(const double* w, double* q) const {
  for (const Batch& b : batches_) {
    const Vectors u1 = gather(w, b.start[0], 0);
    const Vectors u2 = gather(w, b.start[1], 0);
    const Vectors d = to_local(b.axes, {u1.x - u2.x, u1.y - u2.y, u1.z - u2.z});
    const Vectors r1 = to_local(b.axes, gather(w, b.start[0], 3));
    const Vectors r2 = to_local(b.axes, gather(w, b.start[1], 3));
    const Lanes sum_y = r1.y + r2.y;
    const Lanes sum_z = r1.z + r2.z;
    const Lanes twist = b.twist * (r1.x - r2.x);
    const Vectors force{b.stretch * d.x, b.bending_y[0] * d.y + b.bending_y[1] * sum_z,
                        b.bending_z[0] * d.z - b.bending_z[1] * sum_y};
    // (4 + Phi) r_1 + (2 - Phi) r_2 = 2 (1 + Phi) (r_1 + (2 - Phi) / (2 (1 + Phi)) (r_1 + r_2))
    const Lanes turn_y = b.bending_z[3] * sum_y;
    const Lanes turn_z = b.bending_y[3] * sum_z;
    const Lanes shear_y = b.bending_y[1] * d.y;
    const Lanes shear_z = b.bending_z[1] * d.z;
    const Vectors moment1{twist, b.bending_z[2] * (r1.y + turn_y) - shear_z,
                          b.bending_y[2] * (r1.z + turn_z) + shear_y};
    const Vectors moment2{-twist, b.bending_z[2] * (r2.y + turn_y) - shear_z,
                          b.bending_y[2] * (r2.z + turn_z) + shear_y};
    const Vectors global = to_global(b.axes, force);
    scatter(global, to_global(b.axes, moment1), b.start[0], q);
    scatter(minus(global), to_global(b.axes, moment2), b.start[1], q);
  }
}

}  // namespace pounding::stiffness
