// A plate of 12 x 9 m with three round holes, clamped at x = 0. [m]
//   kind  0: triangles;  1: quadrangles by Blossom;  2: hexahedra extruded from those, in `layers`;
//         3: hexahedra, four to each of the tetrahedra that fill the plate
// Groups: body, x_min.
DefineConstant[ kind = 0, size = 0.5, thickness = 0.22, layers = 1 ];
solid = kind >= 2;
Point(1) = {0, 0, 0};
Point(2) = {12, 0, 0};
Point(3) = {12, 9, 0};
Point(4) = {0, 9, 0};
For k In {1 : 4}
  Line(k) = {k, k % 4 + 1};
EndFor
Curve Loop(1) = {1 : 4};
x[] = {3, 7, 9.5};
y[] = {5, 3, 6.5};
radius[] = {0.8, 1.2, 0.6};
loops[] = {1};
For h In {0 : 2}
  centre = newp;
  Point(centre) = {x[h], y[h], 0};
  first = newp;
  For k In {0 : 3}
    Point(first + k) = {x[h] + radius[h] * Cos(k * Pi / 2), y[h] + radius[h] * Sin(k * Pi / 2), 0};
  EndFor
  arc = newl;
  For k In {0 : 3}
    Circle(arc + k) = {first + k, centre, first + (k + 1) % 4};
  EndFor
  loop = newll;
  Curve Loop(loop) = {arc : arc + 3};
  loops[] += loop;
EndFor
plate = news;
Plane Surface(plate) = {loops[]};
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
If (kind == 1 || kind == 2)
  Mesh.RecombinationAlgorithm = 1;
  Recombine Surface {plate};
EndIf
If (kind == 3)
  Mesh.Algorithm3D = 10;
  Mesh.SubdivisionAlgorithm = 2;
EndIf
If (kind == 2)
  made[] = Extrude {0, 0, thickness} { Surface{plate}; Layers{layers}; Recombine; };
EndIf
If (kind == 3)
  made[] = Extrude {0, 0, thickness} { Surface{plate}; };
EndIf
If (solid)
  Physical Volume("body") = {made[1]};
  Physical Surface("x_min") = {made[5]};
Else
  Physical Surface("body") = {plate};
  Physical Curve("x_min") = {4};
EndIf
