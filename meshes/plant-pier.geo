// A wall pier of bricks that stands on its base. Lengths in m.
DefineConstant[
  x0 = 0,          // where its west side stands
  thickness = 0.6, // along x
  width = 2,       // along y
  height = 9,
  cells_x = 2, cells_y = 4, cells_z = 18  // bricks along x, y, z
];

Point(1) = {x0, 0, 0};
across() = Extrude {thickness, 0, 0} { Point{1}; Layers{cells_x}; };
foot() = Extrude {0, width, 0} { Curve{across(1)}; Layers{cells_y}; Recombine; };
body() = Extrude {0, 0, height} { Surface{foot(1)}; Layers{cells_z}; Recombine; };

west() = Surface In BoundingBox {x0 - 0.01, -0.01, -0.01, x0 + 0.01, width + 0.01, height + 0.01};
east() = Surface In BoundingBox {x0 + thickness - 0.01, -0.01, -0.01, x0 + thickness + 0.01, width + 0.01, height + 0.01};
Physical Volume("pier") = {body(1)};
Physical Surface("base") = {foot(1)};
Physical Surface("west") = west();
Physical Surface("east") = east();
