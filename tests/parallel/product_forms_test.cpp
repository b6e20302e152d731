// The product without one of its forms is the same product, on any number of ranks.

#include <cmath>

#include <gtest/gtest.h>

#include "support/box_mesh.h"
#include "support/built_stiffness.h"
#include "support/frame_mesh.h"
#include "support/named_forms.h"

namespace pounding {
namespace product_forms_test {

using testing_support::build_system;
using testing_support::BuiltStiffness;
using testing_support::difference_to_assembled;
using testing_support::FrameMesh;
using testing_support::named_forms;

constexpr double tolerance = 1e-13;

void expect_same_without_any_form(const GlobalMesh& mesh, const Structure& structure) {
  for (const auto& [name, form] : named_forms) {
    auto [distributed, system] = build_system(mesh, structure);
    BuiltStiffness built{std::move(distributed), std::move(system), nullptr};
    stiffness::ProductForms forms;
    forms.*form = false;
    built.stiffness = std::make_unique<stiffness::ElementStiffness>(
        structure, built.mesh, std::move(built.system.stiffness), forms);
    EXPECT_LT(difference_to_assembled(built), tolerance) << "without " << name;
  }
}

TEST(ProductForms, SlabOfBricksOneOfThemTurned) {
  const Structure concrete = testing_support::solid_structure("box", 30e9, 0.2, 2400);
  for (const bool turned : {false, true}) {
    GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {3.15, 2.34, 0.22}, {21, 13, 1});
    testing_support::clamp(mesh, "x_min");
    for (std::size_t n = 100; n < mesh.free_components.size(); n += 41) mesh.free_components[n] = 2;
    if (turned) {
      testing_support::move_nodes(mesh, [](Vector3 x) {
        return Vector3{0.8 * x[0] - 0.6 * x[1], 0.6 * x[0] + 0.8 * x[1], x[2]};
      });
    }
    expect_same_without_any_form(mesh, concrete);
  }
}

TEST(ProductForms, BlocksWithAndWithoutRightAngles) {
  const Structure concrete = testing_support::solid_structure("box", 30e9, 0.2, 2400);
  for (const double skew : {0.0, 0.3}) {
    GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {2.5, 1.2, 1.5}, {10, 6, 5});
    testing_support::clamp(mesh, "z_min");
    testing_support::move_nodes(mesh, [&](Vector3 x) {
      return Vector3{x[0] + skew * x[1], x[1], x[2]};
    });
    expect_same_without_any_form(mesh, concrete);
  }
}

TEST(ProductForms, FloorOfShellsOnBeams) {
  FrameMesh frame;
  frame.add_plate({0, 0, 2}, {3, 0, 0}, {0, 2.5, 0}, {10, 7}, 0.22);
  frame.add_beams({0, 0, 0}, {0, 0, 2}, 5, {1, 0, 0});
  frame.add_beams({3, 2.5, 0}, {3, 2.5, 2}, 5, {1, 0, 0});
  frame.clamp({0, 0, 0});
  frame.clamp({3, 2.5, 0});
  expect_same_without_any_form(frame.mesh(), frame.structure());
}

}  // namespace product_forms_test
}  // namespace pounding
