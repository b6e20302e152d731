
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "stiffness/shells/shell_kernel.h"

namespace pounding::stiffness {
namespace shell_class_test {

ElementProperties concrete(double thickness) {
  return {.young = 30e9, .poisson = 0.2, .density = 2400, .thickness = thickness};
}

/// A rectangle of edges a, b pulled along the first one: u = x e gives H u = 2 a e, with plane
/// stress and no lateral strain.
TEST(ShellSplit, ConstantStrainsHaveTheModuliOfElasticity) {
  const double a = 0.5, b = 0.25, t = 0.1;
  const double area = a * b;
  const double plane = 30e9 / (1 - 0.2 * 0.2);
  const double shear = 30e9 / 2.4;
  const auto split = split_rectangle(concrete(t), {a, b}, 0);
  ASSERT_TRUE(split);
  EXPECT_NEAR(split->stretch[0] * 4 * a * a / (plane * t * area), 1, 1e-12);
  EXPECT_NEAR(split->stretch[1] * 4 * a * b / (0.2 * plane * t * area), 1, 1e-12);
  EXPECT_NEAR(split->stretch[2] * 4 * b * b / (plane * t * area), 1, 1e-12);
  // Curvature d(ry)/dx, about the other axis.
  EXPECT_NEAR(split->curvature[2] * 4 * a * a / (plane * t * t * t / 12 * area), 1, 1e-12);
  EXPECT_NEAR(split->curvature[0] * 4 * b * b / (plane * t * t * t / 12 * area), 1, 1e-12);
  // Shear by the slope dw/dx alone, 5/6 of the section; with the rotation it vanishes:
  // w = x s, ry = -s gives H w = 2 a s, H ry = -4 s.
  EXPECT_NEAR(split->slope[0][0] * 4 * a * a / (5.0 / 6 * shear * t * area), 1, 1e-12);
  EXPECT_NEAR(split->slope[0][0] * 2 * a / (4 * split->slope[0][1]), 1, 1e-12);
  EXPECT_NEAR(split->slope[0][1] * 2 * a / (4 * split->slope[0][2]), 1, 1e-12);
}

constexpr std::size_t line_size = 12;  // arrays
constexpr std::size_t stride = 24;

/// Two lines of nodes, along and across a run of rectangles, with values that differ everywhere,
/// and no numbers beyond the last node.
std::vector<double> two_lines(std::size_t nodes) {
  std::vector<double> memory(2 * line_size * stride, 0.0);
  for (std::size_t l = 0; l < 2; ++l)
    for (std::size_t c = 0; c < 6; ++c)
      for (std::size_t i = 0; i < stride; ++i) {
        const std::size_t at = (l * line_size + c) * stride + i;
        memory[at] = i < nodes ? std::sin(3.0 + static_cast<double>(7 * at * at % 1009)) : NAN;
      }
  return memory;
}

/// A row of `count` rectangles along axis `run` against the sum of their dense products.
void expect_row_is_dense(const std::vector<double>& stiffness, const ShellSplit& split,
                         std::size_t run, std::size_t count) {
  constexpr std::array<std::array<std::size_t, 2>, 4> corner{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  constexpr std::array<std::size_t, 6> swapped{1, 0, 2, 4, 3, 5};
  std::vector<double> memory = two_lines(count + 1);
  /// Where component c of node a of rectangle e stands.
  const auto place = [&](std::size_t e, std::size_t a, std::size_t c) {
    const std::size_t array = run == 0 ? c : swapped[c];
    return (corner[a][1 - run] * line_size + array) * stride + e + corner[a][run];
  };
  std::vector<double> expected(memory.size(), 0.0);
  double scale = 0;
  for (const double entry : stiffness) scale = std::max(scale, std::abs(entry));
  for (std::size_t e = 0; e < count; ++e)
    for (std::size_t i = 0; i < 24; ++i)
      for (std::size_t j = 0; j < 24; ++j)
        expected[place(e, i / 6, i % 6)] += stiffness[24 * i + j] * memory[place(e, j / 6, j % 6)];
  double* const far = &memory[line_size * stride];
  add_shell_run(split, {ShellLine{memory.data(), &memory[6 * stride]}, {far, far + 6 * stride}},
                static_cast<int>(stride), static_cast<int>(count));
  for (std::size_t l = 0; l < 2; ++l)
    for (std::size_t at = l * line_size * stride; at < (l * line_size + 6) * stride; ++at) {
      EXPECT_NEAR(memory[at + 6 * stride], expected[at], 3e-13 * scale)
          << count << " rectangles along axis " << run << ", value " << at;
    }
}

/// Rows of every length, along both axes, slender and thin ones too.
TEST(ShellSplit, IsTheElementMatrix) {
  for (const auto& [a, b, t] :
       {Vector3{1, 1, 0.1}, {0.31, 0.27, 0.22}, {2, 0.1, 0.01}, {3, 4, 1e-3}}) {
    std::vector<double> stiffness(576), mass(24);
    element_matrices(ElementType::shell4, std::vector<double>{0, 0, 0, a, 0, 0, a, b, 0, 0, b, 0},
                     concrete(t), stiffness, mass);
    for (const std::size_t axis : {0, 1}) {
      const auto split = split_rectangle(concrete(t), {a, b}, static_cast<int>(axis));
      ASSERT_TRUE(split);
      for (const std::size_t count : {1, 2, 3, 4, 5, 8, 11}) {
        expect_row_is_dense(stiffness, *split, axis, count);
      }
    }
  }
}

}  // namespace shell_class_test
}  // namespace pounding::stiffness
