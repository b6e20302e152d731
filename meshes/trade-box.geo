// A box of bricks. Lengths in m. Groups: body, and its sides bottom, top, west, east.
DefineConstant[
  x0 = 0, y0 = 0, z0 = 0,             // its lowest corner
  dx = 1, dy = 1, dz = 1,             // along x, y, z
  cells_x = 2, cells_y = 2, cells_z = 2
];

Point(1) = {x0, y0, z0};
across() = Extrude {dx, 0, 0} { Point{1}; Layers{cells_x}; };
foot() = Extrude {0, dy, 0} { Curve{across(1)}; Layers{cells_y}; Recombine; };
body() = Extrude {0, 0, dz} { Surface{foot(1)}; Layers{cells_z}; Recombine; };

Physical Volume("body") = {body(1)};
Physical Surface("bottom") = {foot(1)};
Physical Surface("top") = {body(0)};
Physical Surface("west") = Surface In BoundingBox {x0 - .01, y0 - .01, z0 - .01, x0 + .01, y0 + dy + .01, z0 + dz + .01};
Physical Surface("east") = Surface In BoundingBox {x0 + dx - .01, y0 - .01, z0 - .01, x0 + dx + .01, y0 + dy + .01, z0 + dz + .01};
