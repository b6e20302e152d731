#include "stiffness/strains/shell_strains.h"

#include "stiffness/strains/batch_product.h"
#include "stiffness/strains/shell_fields.h"

namespace pounding::stiffness {
namespace {

using Quadrangle = QuadrangleStrains;

/// A field of the plane: its part in f_p, f_r and f_h.
struct Differences {
  ElementLanes p, r, h;
};

template <typename Numbers>
inline __attribute__((always_inline)) Differences differences(Numbers skew, const ElementLanes& f1,
                                                              const ElementLanes& f2,
                                                              const ElementLanes& f3,
                                                              const ElementLanes& f4) {
  const ElementLanes p = f3 - f1;
  const ElementLanes r = f4 - f2;
  return {p, r, less(less((f1 + f3) - (f2 + f4), skew[0], p), skew[1], r)};
}

/// Forces at the four nodes of what works on the differences.
template <typename Numbers>
inline __attribute__((always_inline)) void nodal_forces(Numbers skew, Differences work,
                                                        ElementLanes* force) {
  work.p = less(work.p, skew[0], work.h);
  work.r = less(work.r, skew[1], work.h);
  force[0] = work.h - work.p;
  force[1] = -work.r - work.h;
  force[2] = work.h + work.p;
  force[3] = work.r - work.h;
}

/// u_x, u_y, r_z of the nodes become forces.
template <typename Numbers>
inline __attribute__((always_inline)) void quadrangle_membrane(Numbers n, const PlaneFrame& frame,
                                                               ElementLanes* values) {
  const auto skew = n + Quadrangle::skew;
  Differences u = differences(skew, values[0], values[6], values[12], values[18]);
  Differences v = differences(skew, values[1], values[7], values[13], values[19]);
  PlaneGradient of_u = frame.gradient(u.p, u.r);
  PlaneGradient of_v = frame.gradient(v.p, v.r);
  const ElementLanes spin = n[Quadrangle::spin] * (of_v.x - of_u.y);
  const ElementLanes strain[6] = {
      u.h, v.h, values[5] - spin, values[11] - spin, values[17] - spin, values[23] - spin};
  ElementLanes work[6];
  packed_product<6>(n + Quadrangle::membrane, strain, work);
  plane_stress(n + Quadrangle::stretch, of_u, of_v);
  const ElementLanes moment = (work[2] + work[3]) + (work[4] + work[5]);
  of_u.y = plus(of_u.y, n[Quadrangle::spin], moment);
  of_v.x = less(of_v.x, n[Quadrangle::spin], moment);
  ElementLanes force[4];
  nodal_forces(skew, {frame.along_p(of_u), frame.along_r(of_u), work[0]}, force);
  for (std::size_t a = 0; a < 4; ++a) values[6 * a] = force[a];
  nodal_forces(skew, {frame.along_p(of_v), frame.along_r(of_v), work[1]}, force);
  for (std::size_t a = 0; a < 4; ++a) values[6 * a + 1] = force[a];
  for (std::size_t a = 0; a < 4; ++a) values[6 * a + 5] = work[2 + a];
}

/// u_z, r_x, r_y of the nodes become forces.
template <typename Numbers>
inline __attribute__((always_inline)) void quadrangle_plate(Numbers n, const PlaneFrame& frame,
                                                            ElementLanes* values) {
  const auto skew = n + Quadrangle::skew;
  const auto edge = n + Quadrangle::edges;
  const ElementLanes x41 = -(edge[0] + edge[2] + edge[4]);
  const ElementLanes y41 = -(edge[1] + edge[3] + edge[5]);
  const auto shear = [&](std::size_t a, std::size_t b, const ElementLanes& x,
                         const ElementLanes& y) {
    const ElementLanes w = values[6 * b + 2] - values[6 * a + 2];
    return less(plus(w + w, values[6 * a + 4] + values[6 * b + 4], x),
                values[6 * a + 3] + values[6 * b + 3], y);
  };
  const ElementLanes shears[4] = {shear(0, 1, edge[0], edge[1]), shear(1, 2, edge[2], edge[3]),
                                  shear(2, 3, edge[4], edge[5]), shear(3, 0, x41, y41)};
  ElementLanes along[4];
  packed_product<4>(n + Quadrangle::shear, shears, along);
  const Differences bx = differences(skew, values[4], values[10], values[16], values[22]);
  const Differences by = differences(skew, -values[3], -values[9], -values[15], -values[21]);
  PlaneGradient of_x = frame.gradient(bx.p, bx.r);
  PlaneGradient of_y = frame.gradient(by.p, by.r);
  plane_stress(n + Quadrangle::bend, of_x, of_y);
  const ElementLanes strain[2] = {bx.h, by.h};
  ElementLanes work[2];
  packed_product<2>(n + Quadrangle::twist, strain, work);
  ElementLanes moment_x[4];
  ElementLanes moment_y[4];
  nodal_forces(skew, {frame.along_p(of_x), frame.along_r(of_x), work[0]}, moment_x);
  nodal_forces(skew, {frame.along_p(of_y), frame.along_r(of_y), work[1]}, moment_y);
  const ElementLanes x[4] = {edge[0] * along[0], edge[2] * along[1], edge[4] * along[2],
                             x41 * along[3]};
  const ElementLanes y[4] = {edge[1] * along[0], edge[3] * along[1], edge[5] * along[2],
                             y41 * along[3]};
  for (std::size_t a = 0; a < 4; ++a) {
    const std::size_t last = (a + 3) % 4;
    const ElementLanes w = along[last] - along[a];
    values[6 * a + 2] = w + w;
    values[6 * a + 3] = -(moment_y[a] + (y[a] + y[last]));
    values[6 * a + 4] = moment_x[a] + (x[a] + x[last]);
  }
}

using Triangle = TriangleStrains;

/// u_x, u_y, r_z of the nodes become forces.
template <typename Numbers>
inline __attribute__((always_inline)) void triangle_membrane(Numbers n, const PlaneFrame& frame,
                                                             ElementLanes* values) {
  PlaneGradient of_u = frame.gradient(values[6] - values[0], values[12] - values[0]);
  PlaneGradient of_v = frame.gradient(values[7] - values[1], values[13] - values[1]);
  const ElementLanes spin = n[Triangle::spin];
  const ElementLanes angle = spin * (of_v.x - of_u.y);
  const ElementLanes strain[3] = {values[5] - angle, values[11] - angle, values[17] - angle};
  const ElementLanes sum = strain[0] + strain[1] + strain[2];
  const ElementLanes drilling = n[Triangle::drilling];
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
template <typename Numbers>
inline __attribute__((always_inline)) void triangle_plate(Numbers n, const PlaneFrame& frame,
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

template <typename Numbers>
void QuadrangleStrains::product(Numbers n, ElementLanes* values) {
  turn_into<8>(n + axes, values);
  const ElementLanes heights[4] = {-n[height], n[height], -n[height], n[height]};
  for (std::size_t a = 0; a < 4; ++a) {
    ElementLanes* const node = values + 6 * a;
    node[0] = less(node[0], heights[a], node[4]);
    node[1] = plus(node[1], heights[a], node[3]);
  }
  const auto edge = n + edges;
  const PlaneFrame frame{edge[0] + edge[2], edge[1] + edge[3], edge[2] + edge[4],
                         edge[3] + edge[5]};
  quadrangle_membrane(n, frame, values);
  quadrangle_plate(n, frame, values);
  for (std::size_t a = 0; a < 4; ++a) {
    ElementLanes* const node = values + 6 * a;
    node[4] = less(node[4], heights[a], node[0]);
    node[3] = plus(node[3], heights[a], node[1]);
  }
  turn_back<8>(n + axes, values);
}

std::array<double, QuadrangleStrains::number_count> QuadrangleStrains::numbers(
    std::span<const double> coordinates, std::span<const double> stiffness) {
  const auto node = [&](std::size_t a) {
    return Vector3{coordinates[3 * a], coordinates[3 * a + 1], coordinates[3 * a + 2]};
  };
  const Vector3 first = minus(node(2), node(0));
  const Vector3 second = minus(node(3), node(1));
  ShellFields<node_count> fields;
  fields.frame[2] = normalised(cross(first, second));
  fields.frame[0] = normalised(first);
  fields.frame[1] = cross(fields.frame[2], fields.frame[0]);
  const double above = dot(fields.frame[2], minus(node(1), node(0))) / 2;
  fields.heights = {-above, above, -above, above};
  for (std::size_t a = 0; a < node_count; ++a) {
    const Vector3 x = minus(node(a), node(0));
    fields.x[a] = dot(fields.frame[0], x);
    fields.y[a] = dot(fields.frame[1], x);
  }
  const auto& x = fields.x;
  const auto& y = fields.y;
  const double x_p = x[2] - x[0], y_p = y[2] - y[0], x_r = x[3] - x[1], y_r = y[3] - y[1];
  const double jacobian = x_p * y_r - x_r * y_p;
  const double x_h = x[0] - x[1] + x[2] - x[3], y_h = y[0] - y[1] + y[2] - y[3];

  std::array<double, number_count> n{};
  for (std::size_t i = 0; i < 9; ++i) n[axes + i] = fields.frame[i / 3][i % 3];
  n[height] = above;
  for (std::size_t e = 0; e < 3; ++e) {
    n[edges + 2 * e] = x[e + 1] - x[e];
    n[edges + 2 * e + 1] = y[e + 1] - y[e];
  }
  n[spin] = 1 / (2 * jacobian);
  n[skew] = (x_h * y_r - y_h * x_r) / jacobian;
  n[skew + 1] = (y_h * x_p - x_h * y_p) / jacobian;

  // Fields of one strain each, all others zero.
  constexpr std::array<double, node_count> alternating{0.25, -0.25, 0.25, -0.25};
  using Field = ShellFields<node_count>::Field;
  std::array<Field, 6> of_membrane{};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t a = 0; a < node_count; ++a) of_membrane[i][6 * a + i] = alternating[a];
  }
  for (std::size_t a = 0; a < node_count; ++a) of_membrane[2 + a][6 * a + 5] = 1;
  fields.put_energies(of_membrane, stiffness, &n[membrane]);
  std::array<Field, 2> of_twist{};
  for (std::size_t a = 0; a < node_count; ++a) {
    of_twist[0][6 * a + 4] = alternating[a];
    of_twist[1][6 * a + 3] = -alternating[a];
  }
  fields.put_energies(of_twist, stiffness, &n[twist]);
  std::array<Field, 4> of_shear{};
  for (std::size_t e = 0; e < node_count; ++e) of_shear[e] = fields.edge_shear(e, jacobian);
  fields.put_energies(of_shear, stiffness, &n[shear]);
  fields.put_moduli(jacobian, stiffness, &n[stretch], &n[bend]);
  return n;
}

template <typename Numbers>
void TriangleStrains::product(Numbers n, ElementLanes* values) {
  turn_into<6>(n + axes, values);
  const PlaneFrame frame{n[edges], ElementLanes{}, n[edges + 1], n[edges + 2]};
  triangle_membrane(n, frame, values);
  triangle_plate(n, frame, values);
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

template void QuadrangleStrains::product(NumbersOfBatch<double>, ElementLanes*);
template void TriangleStrains::product(NumbersOfBatch<double>, ElementLanes*);
template void BatchElements<QuadrangleStrains>::apply(std::size_t, const BatchValue*, BatchValue*,
                                                      StateAhead&) const;
template void BatchElements<TriangleStrains>::apply(std::size_t, const BatchValue*, BatchValue*,
                                                    StateAhead&) const;

}  // namespace pounding::stiffness
