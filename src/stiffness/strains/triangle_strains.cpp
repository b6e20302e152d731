#include "stiffness/strains/triangle_strains.h"

#include "stiffness/strains/plane_fields.h"
#include "stiffness/strains/shell_fields.h"

namespace pounding::stiffness {
namespace {

using Triangle = TriangleStrains;

/// u_x, u_y, r_z of the nodes become forces.
inline __attribute__((always_inline)) void apply_membrane(const ElementLanes* n,
                                                          const PlaneFrame& frame,
                                                          ElementLanes* values) {
  PlaneGradient of_u = frame.gradient(values[6] - values[0], values[12] - values[0]);
  PlaneGradient of_v = frame.gradient(values[7] - values[1], values[13] - values[1]);
  const ElementLanes& spin = n[Triangle::spin];
  const ElementLanes angle = spin * (of_v.x - of_u.y);
  const ElementLanes strain[3] = {values[5] - angle, values[11] - angle, values[17] - angle};
  const ElementLanes sum = strain[0] + strain[1] + strain[2];
  const ElementLanes& drilling = n[Triangle::drilling];
  for (std::size_t a = 0; a < 3; ++a) values[6 * a + 5] = drilling * (strain[a] + sum);
  const ElementLanes moment = values[5] + values[11] + values[17];
  plane_stress(n + Triangle::stretch, of_u, of_v);
  of_u.y = plus(of_u.y, spin, moment);
  of_v.x = less(of_v.x, spin, moment);
  values[6] = frame.along_p(of_u);
  values[12] = frame.along_r(of_u);
  values[0] = -(values[6] + values[12]);
  values[7] = frame.along_p(of_v);
  values[13] = frame.along_r(of_v);
  values[1] = -(values[7] + values[13]);
}

/// u_z, r_x, r_y of the nodes become forces.
inline __attribute__((always_inline)) void apply_plate(const ElementLanes* n,
                                                       const PlaneFrame& frame,
                                                       ElementLanes* values) {
  const ElementLanes x[3] = {frame.x_p, frame.x_r - frame.x_p, -frame.x_r};
  const ElementLanes y[3] = {frame.y_p, frame.y_r - frame.y_p, -frame.y_r};
  ElementLanes shear[3];
  for (std::size_t a = 0; a < 3; ++a) {
    const ElementLanes* const here = values + 6 * a;
    const ElementLanes* const next = values + 6 * ((a + 1) % 3);
    const ElementLanes w = next[2] - here[2];
    shear[a] = less(plus(w + w, here[4] + next[4], x[a]), here[3] + next[3], y[a]);
  }
  ElementLanes along[3];
  packed_product<3>(n + Triangle::shear, shear, along);
  PlaneGradient of_x = frame.gradient(values[10] - values[4], values[16] - values[4]);
  PlaneGradient of_y = frame.gradient(values[3] - values[9], values[3] - values[15]);
  plane_stress(n + Triangle::bend, of_x, of_y);
  const ElementLanes x_p = frame.along_p(of_x), x_r = frame.along_r(of_x);
  const ElementLanes y_p = frame.along_p(of_y), y_r = frame.along_r(of_y);
  const ElementLanes moment_x[3] = {-(x_p + x_r), x_p, x_r};
  const ElementLanes moment_y[3] = {-(y_p + y_r), y_p, y_r};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t last = (a + 2) % 3;
    const ElementLanes w = along[last] - along[a];
    values[6 * a + 2] = w + w;
    values[6 * a + 3] = -plus(plus(moment_y[a], y[a], along[a]), y[last], along[last]);
    values[6 * a + 4] = plus(plus(moment_x[a], x[a], along[a]), x[last], along[last]);
  }
}

}  // namespace

void TriangleStrains::product(const ElementLanes* n, ElementLanes* values) {
  turn_into<6>(n + axes, values);
  const PlaneFrame frame{n[edges], ElementLanes{}, n[edges + 1], n[edges + 2]};
  apply_membrane(n, frame, values);
  apply_plate(n, frame, values);
  turn_back<6>(n + axes, values);
}

std::array<double, TriangleStrains::number_count> TriangleStrains::numbers(
    std::span<const double> coordinates, std::span<const double> stiffness) {
  const auto edge = [&](std::size_t a) {
    return Vector3{coordinates[3 * a] - coordinates[0], coordinates[3 * a + 1] - coordinates[1],
                   coordinates[3 * a + 2] - coordinates[2]};
  };
  const Vector3 p = edge(1);
  const Vector3 r = edge(2);
  ShellFields<node_count> fields;
  fields.frame[0] = normalised(p);
  fields.frame[2] = normalised(cross(p, r));
  fields.frame[1] = cross(fields.frame[2], fields.frame[0]);
  fields.x = {0, dot(fields.frame[0], p), dot(fields.frame[0], r)};
  fields.y = {0, 0, dot(fields.frame[1], r)};
  const double jacobian = fields.x[1] * fields.y[2];

  std::array<double, number_count> n{};
  for (std::size_t i = 0; i < 9; ++i) n[axes + i] = fields.frame[i / 3][i % 3];
  n[edges] = fields.x[1];
  n[edges + 1] = fields.x[2];
  n[edges + 2] = fields.y[2];
  n[spin] = 1 / (2 * jacobian);
  using Field = ShellFields<node_count>::Field;
  std::array<Field, 1> of_drilling{};
  of_drilling[0][5] = 1;
  fields.put_energies(of_drilling, stiffness, &n[drilling]);
  n[drilling] /= 2;
  std::array<Field, 3> of_shear{};
  for (std::size_t e = 0; e < node_count; ++e) of_shear[e] = fields.edge_shear(e, jacobian);
  fields.put_energies(of_shear, stiffness, &n[shear]);
  fields.put_moduli(jacobian, stiffness, &n[stretch], &n[bend]);
  return n;
}

}  // namespace pounding::stiffness
