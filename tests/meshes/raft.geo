// A plate of quadrangles from (0, 0) to (lx, ly) at z = 0.  nx, ny: cells;  free 1: by Blossom, round a hole, with
// triangles where it needs them.  Groups: raft and ground (both the plate), x_min and strip (both its edge at x = 0),
// corners (its four corners).
DefineConstant[ lx = 1, ly = 1, nx = 1, ny = 1, free = 0 ];
Point(1) = {0, 0, 0};
Point(2) = {lx, 0, 0};
Point(3) = {lx, ly, 0};
Point(4) = {0, ly, 0};
For i In {1 : 4}
  Line(i) = {i, i % 4 + 1};
EndFor
Curve Loop(1) = {1, 2, 3, 4};
If (free == 1)
  Mesh.Algorithm = 6;
  Mesh.MeshSizeMax = lx / nx;
  Mesh.MeshSizeMin = lx / nx;
  Point(5) = {0.45 * lx, 0.55 * ly, 0};
  Point(6) = {0.60 * lx, 0.55 * ly, 0};
  Point(7) = {0.30 * lx, 0.55 * ly, 0};
  Circle(5) = {6, 5, 7};
  Circle(6) = {7, 5, 6};
  Curve Loop(2) = {5, 6};
  Plane Surface(1) = {1, 2};
Else
  Transfinite Curve {1, 3} = nx + 1;
  Transfinite Curve {2, 4} = ny + 1;
  Plane Surface(1) = {1};
  Transfinite Surface {1};
EndIf
Recombine Surface {1};
Physical Surface("raft") = {1};
Physical Surface("ground") = {1};
Physical Curve("x_min") = {4};
Physical Curve("strip") = {4};
Physical Point("corners") = {1, 2, 3, 4};
