#include "stiffness/beam_elements.h"

#include <cstddef>

#include "common/wide_lanes.h"
#include "elements/beam2.h"
#include "elements/local_frame.h"

namespace pounding::stiffness {
namespace {

constexpr std::size_t beams_at_once = sizeof(Lanes) / sizeof(double);

using Vectors = VectorsOf<Lanes>;

inline Vectors gather(const double* w, const std::array<LocalIndex, 4>& start, int first) {
  const auto component = [&](int c) {
    return Lanes{w[start[0] + c], w[start[1] + c], w[start[2] + c], w[start[3] + c]};
  };
  return {component(first), component(first + 1), component(first + 2)};
}

template <typename Value>
VectorsOf<Value> to_local(const auto& axes, const VectorsOf<Value>& v) {
  return {axes(0) * v.x + axes(1) * v.y + axes(2) * v.z,
          axes(3) * v.x + axes(4) * v.y + axes(5) * v.z,
          axes(6) * v.x + axes(7) * v.y + axes(8) * v.z};
}

template <typename Value>
VectorsOf<Value> to_global(const auto& axes, const VectorsOf<Value>& v) {
  return {axes(0) * v.x + axes(3) * v.y + axes(6) * v.z,
          axes(1) * v.x + axes(4) * v.y + axes(7) * v.z,
          axes(2) * v.x + axes(5) * v.y + axes(8) * v.z};
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

template <typename Value>
VectorsOf<Value> minus(const VectorsOf<Value>& v) {
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

/// Displacements and rotations of both nodes become forces and moments, the force on the second
/// node being minus that on the first. `number`: a number of theirs in a value.
template <typename Value>
void BeamElements::product(const Batch& b, const auto& number, VectorsOf<Value> (&ends)[4]) {
  const auto& [u1, r1_global, u2, r2_global] = ends;
  const auto axes = [&](std::size_t k) { return number(b.axes[k]); };
  const auto about_y = [&](std::size_t k) { return number(b.bending_y[k]); };
  const auto about_z = [&](std::size_t k) { return number(b.bending_z[k]); };
  const VectorsOf<Value> d = to_local<Value>(axes, {u1.x - u2.x, u1.y - u2.y, u1.z - u2.z});
  const VectorsOf<Value> r1 = to_local(axes, r1_global);
  const VectorsOf<Value> r2 = to_local(axes, r2_global);
  const Value sum_y = r1.y + r2.y;
  const Value sum_z = r1.z + r2.z;
  const Value twist = number(b.twist) * (r1.x - r2.x);
  const VectorsOf<Value> force{number(b.stretch) * d.x, about_y(0) * d.y + about_y(1) * sum_z,
                               about_z(0) * d.z - about_z(1) * sum_y};
  // (4 + Phi) r_1 + (2 - Phi) r_2 = 2 (1 + Phi) (r_1 + (2 - Phi) / (2 (1 + Phi)) (r_1 + r_2))
  const Value turn_y = about_z(3) * sum_y;
  const Value turn_z = about_y(3) * sum_z;
  const Value shear_y = about_y(1) * d.y;
  const Value shear_z = about_z(1) * d.z;
  const VectorsOf<Value> moment1{twist, about_z(2) * (r1.y + turn_y) - shear_z,
                                 about_y(2) * (r1.z + turn_z) + shear_y};
  const VectorsOf<Value> moment2{-twist, about_z(2) * (r2.y + turn_y) - shear_z,
                                 about_y(2) * (r2.z + turn_z) + shear_y};
  const VectorsOf<Value> global = to_global(axes, force);
  ends[0] = global;
  ends[1] = to_global(axes, moment1);
  ends[2] = minus(global);
  ends[3] = to_global(axes, moment2);
}

void BeamElements::apply(const double* w, double* q) const {
  for (const Batch& b : batches_) {
    Vectors ends[4] = {gather(w, b.start[0], 0), gather(w, b.start[0], 3), gather(w, b.start[1], 0),
                       gather(w, b.start[1], 3)};
    product(
        b, [](const Lanes& of) -> const Lanes& { return of; }, ends);
    scatter(ends[0], ends[1], b.start[0], q);
    scatter(ends[2], ends[3], b.start[1], q);
  }
}

void BeamElements::apply(const BatchValue* w, BatchValue* q) const {
  for (const Batch& b : batches_) {
    for (std::size_t lane = 0; lane < beams_at_once; ++lane) {
      for (std::size_t run = 0; run < batch_size; run += wide_lane_count) {
        VectorsOf<WideLanes> ends[4];
        const auto at_ends = [&](const auto& visit) {
          for (std::size_t e = 0; e < 4; ++e) {
            const std::size_t dof = static_cast<std::size_t>(b.start[e / 2][lane]) + e % 2 * 3;
            visit(dof, ends[e].x);
            visit(dof + 1, ends[e].y);
            visit(dof + 2, ends[e].z);
          }
        };
        at_ends([&](std::size_t dof, WideLanes& value) { load(&w[dof].values[run], value); });
        product(
            b, [lane](const Lanes& of) { return all_wide(of[lane]); }, ends);
        at_ends([&](std::size_t dof, const WideLanes& value) {
          WideLanes sum;
          load(&q[dof].values[run], sum);
          store(&q[dof].values[run], sum + value);
        });
      }
    }
  }
}

}  // namespace pounding::stiffness
