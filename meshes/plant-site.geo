// A block of soil, 75 x 75 m and 29.47 m deep, with a mat of 13.8 x 13.8 x 1.4 m in the middle of its surface
// z = 0, flush with it, and a point 10 m above the mat, the roof of a structure: bricks of one grid, alike on all
// four sides of the middle. [m]
// h: size of a brick, about. 2 makes 38 x 38 x 15 bricks, 24,337 nodes; an even number of them lies along the mat,
// so that one node stands in the middle. side: of the block.
// Physical groups: soil, mat (volumes), roof (point), body (mat and roof), base, side_x, side_y (the sides across x
// and across y), sides (all four), surface (of the soil).
DefineConstant[ h = 2, side = 75 ];

depth = 29.47;
mat = 13.8; thick = 1.4;
tall = 10;

// Planes across x, and as many across y: side, edge of the mat, edge, side. In between n() bricks.
g() = {-side / 2, -mat / 2, mat / 2, side / 2};
outer = Ceil((side - mat) / 2 / h - 0.5);
n() = {outer, 2 * Ceil(mat / 2 / h - 1e-6), outer};
For j In {0:3}
  For i In {0:3}
    Point(4 * j + i + 1) = {g(i), g(j), -depth};
  EndFor
EndFor
For j In {0:3}
  For i In {0:2}
    Line(3 * j + i + 1) = {4 * j + i + 1, 4 * j + i + 2};              // along x
    Transfinite Curve {3 * j + i + 1} = n(i) + 1;
    Line(12 + 3 * j + i + 1) = {4 * i + j + 1, 4 * (i + 1) + j + 1};   // along y, at plane j
    Transfinite Curve {12 + 3 * j + i + 1} = n(i) + 1;
  EndFor
EndFor
base() = {};
For j In {0:2}
  For i In {0:2}
    s = 3 * j + i + 1;
    Curve Loop(s) = {s, 12 + 3 * (i + 1) + j + 1, -(s + 3), -(12 + 3 * i + j + 1)};
    Plane Surface(s) = {s};
    Transfinite Surface {s};
    Recombine Surface {s};
    base() += s;
  EndFor
EndFor

// Two layers: below the mat, and beside it. Extruded faces come in the order of the lines of their loop.
soil() = {}; surface() = {}; side_x() = {}; side_y() = {};
For j In {0:2}
  For i In {0:2}
    s = 3 * j + i + 1;
    deep() = Extrude {0, 0, depth - thick} { Surface{s}; Layers{Ceil((depth - thick) / h - 0.5)}; Recombine; };
    flat() = Extrude {0, 0, thick} { Surface{deep(0)}; Layers{Ceil(thick / h - 1e-6)}; Recombine; };
    soil() += deep(1);
    If (i == 1 && j == 1)
      Physical Volume("mat") = flat(1);
      Physical Volume("body") = flat(1);
    Else
      soil() += flat(1);
      surface() += flat(0);
    EndIf
    If (j == 0) side_y() += {deep(2), flat(2)}; EndIf
    If (i == 2) side_x() += {deep(3), flat(3)}; EndIf
    If (j == 2) side_y() += {deep(4), flat(4)}; EndIf
    If (i == 0) side_x() += {deep(5), flat(5)}; EndIf
  EndFor
EndFor
roof = newp; Point(roof) = {0, 0, tall};
Physical Volume("soil") = soil();
Physical Point("roof") = roof;
Physical Point("body") = roof;
Physical Surface("base") = base();
Physical Surface("side_x") = side_x();
Physical Surface("side_y") = side_y();
Physical Surface("sides") = {side_x(), side_y()};
Physical Surface("surface") = surface();
