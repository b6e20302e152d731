#include "stiffness/bricks/brick_kernel.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "elements/gauss_rule.h"

namespace pounding::stiffness {
namespace {

ElementProperties concrete() {
  return {.young = 30e9, .poisson = 0.2, .density = 2400};
}

/// Stiffness of a box with edges along the global axes, nodes in Gmsh's order.
std::array<double, 576> dense_stiffness(ElementType type, const Vector3& lengths) {
  std::array<double, 24> x{};
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t d = 0; d < 3; ++d) x[3 * a + d] = lengths[d] * (1 + hex_corners[a][d]) / 2;
  std::array<double, 576> stiffness{};
  std::array<double, 24> mass{};
  element_matrices(type, x, concrete(), stiffness, mass);
  return stiffness;
}

/// A layer of bricks, `count` along its run by `rows`, one through the thickness, whose axes are
/// the global axes[0], axes[1], axes[2].
class Layer {
 public:
  Layer(ElementType type, const Vector3& lengths, std::array<std::size_t, 3> axes, int count,
        int rows)
      : axes_(axes),
        count_(count),
        rows_(rows),
        stride_((count + 2 * most_lanes) / most_lanes * most_lanes),
        stiffness_(dense_stiffness(type, lengths)) {
    const auto split =
        split_brick(type, concrete(), {lengths[axes[0]], lengths[axes[1]], lengths[axes[2]]});
    EXPECT_TRUE(split);
    if (split) stencil_ = brick_stencil(*split);
    displacement_.resize(static_cast<std::size_t>(6 * (count + 1) * (rows + 1)));
    for (std::size_t i = 0; i < displacement_.size(); ++i) {
      displacement_[i] = std::sin(3.0 + 7.0 * static_cast<double>(i * i));
    }
  }

  /// Largest difference between the kernel's forces and those of the dense matrices, over the
  /// largest stiffness.
  double error() {
    const std::vector<double> expected = dense_forces();
    const std::vector<double> found = kernel_forces();
    double largest = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const double difference = std::abs(found[i] - expected[i]);
      largest = std::isfinite(difference) ? std::max(largest, difference) : INFINITY;
    }
    return largest / stiffness_[0];
  }

 private:
  /// Of global component c at node i of row j, on the near or the far side.
  std::size_t dof(int i, int j, int far, std::size_t c) const {
    return static_cast<std::size_t>(3 * ((j * 2 + far) * (count_ + 1) + i)) + c;
  }

  std::vector<double> dense_forces() const {
    std::vector<double> forces(displacement_.size(), 0.0);
    for (int row = 0; row < rows_; ++row) {
      for (int brick = 0; brick < count_; ++brick) {
        std::array<std::size_t, 24> dofs{};
        for (std::size_t a = 0; a < 8; ++a) {
          const auto far = [&](std::size_t d) { return hex_corners[a][axes_[d]] > 0 ? 1 : 0; };
          for (std::size_t c = 0; c < 3; ++c) {
            dofs[3 * a + c] = dof(brick + far(0), row + far(1), far(2), c);
          }
        }
        for (std::size_t i = 0; i < 24; ++i)
          for (std::size_t j = 0; j < 24; ++j)
            forces[dofs[i]] += stiffness_[24 * i + j] * displacement_[dofs[j]];
      }
    }
    return forces;
  }

  /// Lines surrounded by values that must not be used. Line by line; the first force on every line
  /// is set.
  std::vector<double> kernel_forces() {
    const double poison = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> memory(static_cast<std::size_t>(12 * stride_ * (rows_ + 1)), poison);
    std::vector<PairLine> lines;
    for (int j = 0; j <= rows_; ++j) {
      double* const line = memory.data() + 12 * stride_ * j;
      lines.push_back({line, line + 6 * stride_});
      for (std::size_t d = 0; d < 3; ++d) {
        double* const sum = lines.back().sum + static_cast<std::ptrdiff_t>(d) * stride_;
        double* const difference = sum + 6 * stride_;
        for (int i = 0; i <= count_; ++i) {
          const double near = displacement_[dof(i, j, 0, axes_[d])];
          const double far = displacement_[dof(i, j, 1, axes_[d])];
          sum[i] = far + near;
          difference[i] = far - near;
        }
        if (j == 0) {
          std::fill(sum + 3 * stride_, sum + 4 * stride_, 0.0);
          std::fill(difference + 3 * stride_, difference + 4 * stride_, 0.0);
        }
      }
    }
    for (int j = 0; j <= rows_; ++j) {
      const auto line = static_cast<std::size_t>(j);
      const PairLine before = j > 0 ? lines[line - 1] : PairLine{};
      const PairLine behind = j < rows_ ? lines[line + 1] : PairLine{};
      const Sides sides = j == 0 ? Sides::behind : j == rows_ ? Sides::before : Sides::both;
      add_line_forces(stencil_, sides, j < rows_, lines[line], before, behind, stride_, count_);
    }
    std::vector<double> forces(displacement_.size());
    for (int j = 0; j <= rows_; ++j) {
      for (std::size_t d = 0; d < 3; ++d) {
        const std::ptrdiff_t array = static_cast<std::ptrdiff_t>(3 + d) * stride_;
        const double* const sum = lines[static_cast<std::size_t>(j)].sum + array;
        const double* const difference = lines[static_cast<std::size_t>(j)].difference + array;
        for (int i = 0; i <= count_; ++i) {
          forces[dof(i, j, 0, axes_[d])] = sum[i] - difference[i];
          forces[dof(i, j, 1, axes_[d])] = sum[i] + difference[i];
        }
      }
    }
    return forces;
  }

  std::array<std::size_t, 3> axes_;
  int count_;
  int rows_;
  std::ptrdiff_t stride_;
  std::array<double, 576> stiffness_;
  BrickStencil stencil_;
  std::vector<double> displacement_;
};

constexpr std::array<std::array<std::size_t, 3>, 6> all_axes{
    {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};

constexpr double tolerance = 1e-13;

TEST(BrickKernel, LayersAgreeWithDenseMatrices) {
  for (const ElementType type : {ElementType::hex8, ElementType::hex8_full}) {
    for (const auto& axes : all_axes) {
      for (int count = 1; count <= 13; ++count) {
        for (int rows = 1; rows <= 3; ++rows) {
          EXPECT_LT(Layer(type, {0.31, 0.27, 0.22}, axes, count, rows).error(), tolerance)
              << count << " bricks in " << rows << " rows, axes " << axes[0] << axes[1] << axes[2];
        }
      }
    }
  }
}

TEST(BrickKernel, CubesAndSlenderBricks) {
  for (const ElementType type : {ElementType::hex8, ElementType::hex8_full}) {
    for (const auto& axes : all_axes) {
      EXPECT_LT(Layer(type, {1, 1, 1}, axes, 9, 2).error(), tolerance);
      EXPECT_LT(Layer(type, {2, 1, 0.1}, axes, 9, 2).error(), tolerance);
    }
  }
}

/// Forces on lines that hold some already, beyond the run too.
TEST(BrickKernel, AddsToForcesThatAreThere) {
  constexpr int count = 6;
  constexpr int stride = 16;
  const auto split = split_brick(ElementType::hex8, concrete(), {0.3, 0.2, 0.25});
  ASSERT_TRUE(split);
  const BrickStencil stencil = brick_stencil(*split);
  const auto forces = [&](double already, Sides sides) {
    std::vector<double> memory(36 * stride, already);
    std::array<PairLine, 3> lines;
    for (std::size_t l = 0; l < 3; ++l) {
      lines[l] = {&memory[l * 12 * stride], &memory[(l * 12 + 6) * stride]};
      for (int i = 0; i < 3 * stride; ++i) {
        lines[l].sum[i] = std::sin(i);
        lines[l].difference[i] = std::cos(i);
      }
    }
    add_line_forces(stencil, sides, false, lines[0], lines[1], lines[2], stride, count);
    return memory;
  };
  for (const Sides sides : {Sides::before, Sides::behind, Sides::both}) {
    const auto from_zero = forces(0, sides);
    const auto from_some = forces(1e6, sides);
    for (std::size_t i = 0; i < from_zero.size(); ++i) {
      const bool is_force = i / stride % 6 >= 3;
      EXPECT_NEAR(from_some[i] - from_zero[i], is_force ? 1e6 : 0, 1e-3);
      if (i % stride > count && is_force) {
        EXPECT_EQ(from_some[i], 1e6);
      }
    }
  }
}

}  // namespace
}  // namespace pounding::stiffness
