// An upright wall of shells in the plane y = 0, width x height [m], with nx cells along x (even, or 1)
// and nz along z. Its head is `taper` times as wide as its foot; mixed = 1 leaves triangles in its left
// half. Every node of the head is a point of its own. Groups: wall, foot (the edge at z = 0), head (the
// points of the upper edge), top (the one in its middle, or its right end of one cell).
DefineConstant[ width = 3, height = 3, nx = 4, nz = 4, taper = 1, mixed = 0 ];
For i In {0 : nx}
  u = i / nx - 0.5;
  Point(i + 1) = {width * u, 0, 0};
  Point(nx + i + 2) = {width * taper * u, 0, height};
EndFor
For i In {1 : nx}
  Line(i) = {i, i + 1};
  Line(nx + i) = {nx + i + 1, nx + i + 2};
EndFor
half = (nx == 1) ? 1 : nx / 2;
left = 2 * nx + 1; middle = left + 1; right = left + 2;
Line(left) = {1, nx + 2};
Line(middle) = {half + 1, nx + half + 2};
Transfinite Curve {1 : 2 * nx} = 2;
Transfinite Curve {left, middle} = nz + 1;
Curve Loop(1) = {1 : half, middle, -(nx + half) : -(nx + 1), -left};
Plane Surface(1) = {1};
Transfinite Surface {1} = {1, half + 1, nx + half + 2, nx + 2};
walls[] = {1};
If (nx > 1)
  Line(right) = {nx + 1, 2 * nx + 2};
  Transfinite Curve {right} = nz + 1;
  Curve Loop(2) = {half + 1 : nx, right, -(2 * nx) : -(nx + half + 1), -middle};
  Plane Surface(2) = {2};
  Transfinite Surface {2} = {half + 1, nx + 1, 2 * nx + 2, nx + half + 2};
  Recombine Surface {2};
  walls[] += {2};
EndIf
If (!mixed)
  Recombine Surface {1};
EndIf
Physical Surface("wall") = {walls[]};
Physical Curve("foot") = {1 : nx};
Physical Point("head") = {nx + 2 : 2 * nx + 2};
Physical Point("top") = {nx + half + 2};
