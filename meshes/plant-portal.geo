// A storey on shear walls of shells along its south and north sides, with a frame of beams above it. Lengths in m.
DefineConstant[
  x0 = 0,          // where its west side stands
  length = 5,      // along x
  width = 4,       // along y
  wall_height = 3,
  frame_height = 3,
  cells_x = 6, cells_y = 6, cells_z = 4,  // shells along x, y and up the walls
  pieces = 3       // beams along a column of the frame
];

For k In {0:2}
  z = k == 0 ? 0 : (k == 1 ? wall_height : wall_height + frame_height);
  Point(4 * k + 1) = {x0, 0, z};
  Point(4 * k + 2) = {x0 + length, 0, z};
  Point(4 * k + 3) = {x0 + length, width, z};
  Point(4 * k + 4) = {x0, width, z};
  For i In {1:4:(k == 0 ? 2 : 1)}
    Line(10 * k + i) = {4 * k + i, 4 * k + (i % 4) + 1};
    Transfinite Curve {10 * k + i} = (i % 2 == 1 ? cells_x : cells_y) + 1;
  EndFor
EndFor
For i In {1:4}
  Line(50 + i) = {i, 4 + i};
  Transfinite Curve {50 + i} = cells_z + 1;
  Line(60 + i) = {4 + i, 8 + i};
  Transfinite Curve {60 + i} = pieces + 1;
EndFor
Curve Loop(1) = {11, 12, 13, 14};
Curve Loop(2) = {21, 22, 23, 24};
Curve Loop(3) = {1, 52, -11, -51};
Curve Loop(4) = {3, 54, -13, -53};
For s In {1:4}
  Plane Surface(s) = {s};
  Transfinite Surface {s};
  Recombine Surface {s};
EndFor
Physical Surface("floors") = {1, 2};
Physical Surface("walls") = {3, 4};
Physical Curve("columns") = {61, 62, 63, 64};
Physical Curve("base") = {1, 3};
Physical Curve("west_1") = {14};
Physical Curve("east_1") = {12};
Physical Curve("west_2") = {24};
Physical Curve("east_2") = {22};
