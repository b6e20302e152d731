// A basin of shells, open at the top: a floor of lx x ly at z = z0 and four walls, those across y `lower` lower. Its low
// corner is at x = x0, y = 0. `tilt` lifts the side of the floor at its high x. With open = 1 the group "tank" lacks the
// wall at its low y. With water = 1 it is full of cells to the brim, group "water"; with tets = 1 of tetrahedra, and shells of
// triangles; with half = 1 the wall at its low y is left out of "body".
DefineConstant[lx = 6, ly = 4, h = 3, nx = 6, ny = 4, nz = 6, x0 = 0, z0 = 0, tilt = 0, lower = 0, open = 0, water = 0, tets = 0, half = 0];

Point(1) = {x0, 0, z0};
Point(2) = {x0 + lx, 0, z0 + tilt};
Point(3) = {x0 + lx, ly, z0 + tilt};
Point(4) = {x0, ly, z0};
Point(5) = {x0, 0, z0 + h - lower};
Point(6) = {x0 + lx, 0, z0 + h - lower};
Point(7) = {x0 + lx, ly, z0 + h};
Point(8) = {x0, ly, z0 + h};
For i In {1:4}
  next = i % 4 + 1;
  Line(i) = {i, next};
  Line(4 + i) = {4 + i, 4 + next};
  Line(8 + i) = {i, 4 + i};
EndFor
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {1, 10, -5, -9};
Curve Loop(3) = {2, 11, -6, -10};
Curve Loop(4) = {3, 12, -7, -11};
Curve Loop(5) = {4, 9, -8, -12};
For i In {1:5}
  Plane Surface(i) = {i};
EndFor
Transfinite Curve {1, 3, 5, 7} = nx + 1;
Transfinite Curve {2, 4, 6, 8} = ny + 1;
Transfinite Curve {9 : 12} = nz + 1;
Transfinite Surface {1 : 5};
If (tets == 0)
  Recombine Surface {1 : 5};
EndIf
If (water == 1)
  Curve Loop(6) = {5, 6, 7, 8};
  Plane Surface(6) = {6};
  Transfinite Surface {6};
  If (tets == 0)
    Recombine Surface {6};
  EndIf
  Surface Loop(1) = {1 : 6};
  Volume(1) = {1};
  Transfinite Volume {1};
  Physical Volume("water") = {1};
EndIf

If (half == 1)
  Physical Surface("body") = {1, 3, 4, 5};
Else
  Physical Surface("body") = {1 : 5};
EndIf
Physical Surface("floor") = {1};
Physical Surface("walls") = {2 : 5};
Physical Surface("high_x") = {3};
Physical Surface("low_x") = {5};
If (open == 1)
  Physical Surface("tank") = {1, 3, 4, 5};
Else
  Physical Surface("tank") = {1 : 5};
EndIf
