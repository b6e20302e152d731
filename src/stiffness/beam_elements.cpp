#include "stiffness/beam_elements.h"

#include <cstddef>

#include "common/matrix3.h"
#include "elements/beam2.h"
#include "elements/local_frame.h"
#include "stiffness/strains/batch_product.h"

namespace pounding::stiffness {
namespace {

constexpr std::size_t beams_at_once = sizeof(Lanes) / sizeof(double);

/// Three components of four beams, or of one beam in several runs.
template <typename Value>
struct VectorsOf {
  Value x, y, z;
};

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
inline void scatter(const Lanes* values, const std::array<LocalIndex, 4>& start, double* q) {
  const VectorsOf<Lanes> force{values[0], values[1], values[2]};
  const VectorsOf<Lanes> moment{values[3], values[4], values[5]};
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

}  // namespace

std::array<double, BeamShape::number_count> BeamShape::numbers(
    std::span<const double> coordinates, const ElementProperties& properties) {
  const auto [direction, length] = segment_between(coordinates);
  const double young = properties.young;
  const double shear = young / (2 * (1 + properties.poisson));
  std::array<double, number_count> result{};
  const auto bend = [&, length = length](std::size_t offset, double inertia, double phi) {
    const double rigidity = young * inertia / length;
    result[offset] = 12 * rigidity / (length * length) / (1 + phi);
    result[offset + 1] = 6 * rigidity / length / (1 + phi);
    result[offset + 2] = 2 * rigidity;
    result[offset + 3] = (2 - phi) / (2 * (1 + phi));
  };
  const ShearFlexibility phi = shear_flexibility(properties, length);
  const Matrix3 frame = local_frame(direction, properties.z_axis);
  for (std::size_t k = 0; k < 9; ++k) result[axes + k] = frame[k / 3][k % 3];
  result[stretch] = young * properties.area / length;
  result[twist] = shear * properties.torsion / length;
  bend(bending_y, properties.inertia_z, phi.y);
  bend(bending_z, properties.inertia_y, phi.z);
  return result;
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
    for (std::size_t k = 0; k < beam.numbers.size(); ++k) batch.numbers[k][lane] = beam.numbers[k];
  }
}

template <typename Numbers, typename Value>
void BeamShape::product(Numbers number, Value* values) {
  using Vectors = VectorsOf<Value>;
  const auto vectors = [&](std::size_t i) {
    return Vectors{values[i], values[i + 1], values[i + 2]};
  };
  const auto put = [&](std::size_t i, const Vectors& v) {
    values[i] = v.x, values[i + 1] = v.y, values[i + 2] = v.z;
  };
  const auto of_axes = [&](std::size_t k) -> Value { return number[axes + k]; };
  const auto about_y = [&](std::size_t k) -> Value { return number[bending_y + k]; };
  const auto about_z = [&](std::size_t k) -> Value { return number[bending_z + k]; };
  const Vectors u1 = vectors(0), u2 = vectors(6);
  const Vectors d = to_local<Value>(of_axes, {u1.x - u2.x, u1.y - u2.y, u1.z - u2.z});
  const Vectors r1 = to_local(of_axes, vectors(3));
  const Vectors r2 = to_local(of_axes, vectors(9));
  const Value sum_y = r1.y + r2.y;
  const Value sum_z = r1.z + r2.z;
  const Value torque = number[twist] * (r1.x - r2.x);
  const Vectors force{number[stretch] * d.x, about_y(0) * d.y + about_y(1) * sum_z,
                      about_z(0) * d.z - about_z(1) * sum_y};
  // (4 + Phi) r_1 + (2 - Phi) r_2 = 2 (1 + Phi) (r_1 + (2 - Phi) / (2 (1 + Phi)) (r_1 + r_2))
  const Value turn_y = about_z(3) * sum_y;
  const Value turn_z = about_y(3) * sum_z;
  const Value shear_y = about_y(1) * d.y;
  const Value shear_z = about_z(1) * d.z;
  const Vectors moment1{torque, about_z(2) * (r1.y + turn_y) - shear_z,
                        about_y(2) * (r1.z + turn_z) + shear_y};
  const Vectors moment2{-torque, about_z(2) * (r2.y + turn_y) - shear_z,
                        about_y(2) * (r2.z + turn_z) + shear_y};
  const Vectors global = to_global(of_axes, force);
  put(0, global);
  put(3, to_global(of_axes, moment1));
  put(6, {-global.x, -global.y, -global.z});
  put(9, to_global(of_axes, moment2));
}

template void BatchElements<BeamShape>::apply(std::size_t, const BatchValue*, BatchValue*,
                                              StateAhead&) const;

void BeamElements::apply(const double* w, double* q) const {
  for (const Batch& b : batches_) {
    Lanes values[12];
    for (std::size_t i = 0; i < 12; ++i) {
      const auto& start = b.start[i / 6];
      const std::size_t c = i % 6;
      values[i] = Lanes{w[start[0] + c], w[start[1] + c], w[start[2] + c], w[start[3] + c]};
    }
    BeamShape::product(&b.numbers[0], values);
    scatter(values, b.start[0], q);
    scatter(values + 6, b.start[1], q);
  }
}

}  // namespace pounding::stiffness
