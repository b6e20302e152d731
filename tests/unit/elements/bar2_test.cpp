#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dense_model.h"
#include "elements/beam2.h"

namespace pounding {
namespace bar2_test {

using testing_support::dense_element;
using testing_support::DenseModel;

ElementProperties concrete_bar() {
  return {.young = 30e9, .density = 2400, .area = 0.01};
}

/// A straight bar of `count` elements, free to move along itself only.
DenseModel straight_bar(std::size_t count, double length, const ElementProperties& properties) {
  std::vector<Vector3> nodes;
  for (std::size_t i = 0; i <= count; ++i)
    nodes.push_back({0, length * static_cast<double>(i) / static_cast<double>(count), 0});
  DenseModel model(nodes, 3);
  for (std::size_t i = 0; i < count; ++i) model.add(ElementType::bar, {i, i + 1}, properties);
  for (std::size_t i = 0; i <= count; ++i) {
    model.fix(i, 0);
    model.fix(i, 2);
  }
  return model;
}

TEST(Bar2, PullsAlongItsAxisOnly) {
  // 3-4-12-13 bar: unit elongation per unit displacement of node 2 along (3, 4, 12) / 13.
  const auto e = dense_element(ElementType::bar, {1, 1, 1, 4, 5, 13}, concrete_bar());
  const double k = 30e9 * 0.01 / 13;
  const double axis[3] = {3.0 / 13, 4.0 / 13, 12.0 / 13};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR(e.stiffness[6 * i + j], k * axis[i] * axis[j], 1e-14 * k);
      EXPECT_NEAR(e.stiffness[6 * i + 3 + j], -k * axis[i] * axis[j], 1e-14 * k);
      EXPECT_NEAR(e.stiffness[6 * (3 + i) + 3 + j], k * axis[i] * axis[j], 1e-14 * k);
    }
  for (const double m : e.lumped_mass) EXPECT_NEAR(m, 2400 * 0.01 * 13 / 2, 1e-12);
}

TEST(Bar2, WhatItCarriesIsLumpedAtItsEnds) {
  ElementProperties p = concrete_bar();
  p.added_mass = 12;
  const auto e = dense_element(ElementType::bar, {0, 0, 0, 3, 4, 12}, p);
  for (const double m : e.lumped_mass) {
    EXPECT_NEAR(m, (p.density * p.area + 12) * 13 / 2, 1e-12);
  }
}

TEST(Bar2, FixedFreeFrequenciesFollowTheLumpedDispersion) {
  const std::size_t count = 20;
  DenseModel model = straight_bar(count, 5.0, concrete_bar());
  model.fix(0, 1);
  const auto f = model.frequencies();
  ASSERT_EQ(f.size(), count);
  const double c = std::sqrt(30e9 / 2400), h = 5.0 / 20;
  for (std::size_t j = 0; j < count; ++j) {
    const double exact = c / (std::numbers::pi * h) *
                         std::sin((2.0 * static_cast<double>(j) + 1) * std::numbers::pi / 80);
    EXPECT_NEAR(f[j], exact, 1e-11 * exact) << j;
  }
  const double table[] = {176.7313, 529.1042, 878.215};
  for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(f[j], table[j], 1e-4);
}

TEST(Bar2, LargestCircularFrequencyHasItsClosedForm) {
  ElementProperties steel = concrete_bar();
  steel.young = 210e9;
  steel.density = 7800;
  const double pi = std::numbers::pi;
  const double two_c_over_h = 2 * std::sqrt(210e9 / 7800) / 0.25;
  const auto largest = [&](bool fix_first, bool fix_last) {
    DenseModel model = straight_bar(40, 10.0, steel);
    if (fix_first) model.fix(0, 1);
    if (fix_last) model.fix(40, 1);
    return 2 * pi * model.frequencies().back();
  };
  EXPECT_NEAR(largest(false, false), two_c_over_h, 1e-12 * two_c_over_h);
  EXPECT_NEAR(largest(true, false), two_c_over_h * std::sin(79 * pi / 160), 1e-7);
  EXPECT_NEAR(largest(true, true), two_c_over_h * std::sin(39 * pi / 80), 1e-7);
  EXPECT_NEAR(largest(true, false), 41501.96029, 1e-5);
  EXPECT_NEAR(largest(true, true), 41477.95906, 1e-5);
}

TEST(Bar2, ZeroLengthIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& x :
       {std::vector<double>{1, 2, 3, 1, 2, 3}, std::vector<double>{0, 0, 0, 0, 0, 0},
        std::vector<double>{1e6, 0, 0, 1e6, 0, 1e-7}, std::vector<double>{0, nan, 0, 1, 0, 0}}) {
    try {
      dense_element(ElementType::bar, x, concrete_bar());
      ADD_FAILURE() << "accepted";
    } catch (const ElementError& error) {
      EXPECT_NE(std::string(error.what()).find("zero length"), std::string::npos);
    }
  }
  // Short is not zero: a millimetre far from the origin, a nanometre at it.
  EXPECT_NO_THROW(dense_element(ElementType::bar, {1e6, 0, 0, 1e6, 0, 1e-3}, concrete_bar()));
  EXPECT_NO_THROW(dense_element(ElementType::bar, {0, 0, 0, 0, 0, 1e-9}, concrete_bar()));
}

}  // namespace bar2_test
}  // namespace pounding
