#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/types.h"
#include "elements/rigid_tank.h"
#include "scene/option_row.h"

namespace pounding {

/// Pool as its mesh shows it.
struct PoolOutline {
  Vector3 corner{0, 0, 0};        ///< of the floor, the one with the lowest x and y [m]
  std::array<double, 2> sides{};  ///< along x and y [m]
  double depth = 0;               ///< of the water [m]
  double freeboard = 0;           ///< from the water to the lowest top of a wall [m]
  double volume = 0;              ///< of the water [m3]
  GlobalIndex wetted = 0;         ///< nodes of cells of water that press on the structure
  GlobalIndex pressures = 0;      ///< nodes of such cells in all but for the surface
};

/// Water in a rectangular tank of a structure, its walls along x and y, its floor level. The walls
/// carry the impulsive mass along their normals, the floor all of it along z; convective masses
/// hang on springs from the walls, see elements/rigid_tank.h. Or water of any shape that has cells
/// in the mesh, without waves, see system/added_mass.h.
struct Pool {
  std::string name;
  std::string structure;
  std::string water;                ///< physical group of its cells; empty: a rectangular tank
  std::vector<std::string> faces;   ///< physical groups of the wetted faces
  double level = 0;                 ///< z of the water's surface [m]
  double density = 0;               ///< [kg/m3]
  int modes = 0;                    ///< convective ones along each side
  double damping = 0;               ///< ratio of these [-]
  double gravity = 0;               ///< [m/s2]
  std::optional<double> freeboard;  ///< nothing: as the mesh has it [m]
  PoolOutline outline;              ///< once the mesh is read

  bool is_tank() const { return water.empty(); }
  /// Masses of the water against a motion along x (0) or y (1).
  TankWater water_along(std::size_t direction) const {
    return water_in_tank(outline.depth, outline.sides[direction], gravity, modes);
  }

  static void describe(auto& option) {
    using namespace option_words;
    constexpr auto of_tank =
        needs(&Pool::is_tank, "not with -<pool>_water, whose cells have a shape and no waves");
    // clang-format off
    option(&Pool::structure, "<pool>_structure", text("name", required, "the name of a structure"), "the structure that holds it");
    option(&Pool::water, "<pool>_water", text("name", absent("left out: a rectangular tank with <pool>_faces"), "a group of volume cells"), "physical group of the cells of water of any shape, which no element has: tetrahedra, hexahedra, wedges; their faces that have nodes of the structure are wetted, level ones at the highest nodes are the free surface, without waves");
    option(&Pool::faces, "<pool>_faces", names(required), "physical groups of the faces of its floor and its four walls: shells, or surfaces of solids; a rectangle with its walls along x and y", of_tank);
    option(&Pool::level, "<pool>_level", real("m", required), "height z of the water's surface", of_tank);
    option(&Pool::density, "<pool>_density", real("kg/m3", "1000", positive), "density of the water");
    option(&Pool::modes, "<pool>_modes", integer("-", "2", closed(1, 9)), "sloshing modes along x and along y, the lowest antisymmetric ones; the last has the mass of all that are left out", of_tank);
    option(&Pool::damping, "<pool>_damping", real("-", "0.005", damping_ratio), "damping ratio of its waves", of_tank);
    option(&Pool::gravity, "<pool>_gravity", real("m/s2", "9.80665", positive), "acceleration of gravity by which the water sloshes, whether or not the run has weight", of_tank);
    option(&Pool::freeboard, "<pool>_freeboard", real("m", absent("left out: up to the lowest top of its walls"), not_negative), "height over the surface that waves may reach", of_tank);
    // clang-format on
  }
};

}  // namespace pounding
