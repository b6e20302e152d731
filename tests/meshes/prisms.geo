// A brick of wedges, triangles in x and y extruded along z: corner at the origin, edges lx, ly, lz
// [m], nx (even), ny, nz cells. mixed = 1: hexahedra in the half of small x. tetrahedra = 1: three in
// the place of each wedge. Groups: body, x_min, x_max, z_min, z_max.
DefineConstant[ lx = 1, ly = 1, lz = 1, nx = 2, ny = 1, nz = 1, mixed = 0, tetrahedra = 0 ];
Point(1) = {0, 0, 0};
Point(2) = {lx / 2, 0, 0};
Point(3) = {lx, 0, 0};
Point(4) = {lx, ly, 0};
Point(5) = {lx / 2, ly, 0};
Point(6) = {0, ly, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {2, 5};
Transfinite Curve {1, 2, 4, 5} = nx / 2 + 1;
Transfinite Curve {3, 6, 7} = ny + 1;
Curve Loop(1) = {1, 7, 5, 6};
Curve Loop(2) = {2, 3, 4, -7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Surface {1, 2};
If (mixed)
  Recombine Surface {1};
EndIf
If (tetrahedra)
  left[] = Extrude {0, 0, lz} { Surface{1}; Layers{nz}; };
  right[] = Extrude {0, 0, lz} { Surface{2}; Layers{nz}; };
Else
  left[] = Extrude {0, 0, lz} { Surface{1}; Layers{nz}; Recombine; };
  right[] = Extrude {0, 0, lz} { Surface{2}; Layers{nz}; Recombine; };
EndIf
Physical Volume("body") = {left[1], right[1]};
Physical Surface("z_min") = {1, 2};
Physical Surface("z_max") = {left[0], right[0]};
Physical Surface("x_min") = {left[5]};
Physical Surface("x_max") = {right[3]};
