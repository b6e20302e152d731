// A rectangular sheet of shells from the edge that is held to its free end, length x width [m], for
// the forces in shells: level along x and centred on y = 0, or upright, along z from z = 0, and
// turned by `turn` [rad] about z. nx cells along it and ny across; triangles = 1 leaves them.
// Groups: sheet, held (the edge), corner (a point of the free end, at positive y).
DefineConstant[ length = 4, width = 1, nx = 8, ny = 4, upright = 0, turn = 0, triangles = 0 ];
along[] = {upright ? 0 : Cos(turn), upright ? 0 : Sin(turn), upright ? 1 : 0};
across[] = {upright ? Cos(turn) : -Sin(turn), upright ? Sin(turn) : Cos(turn)};
u[] = {0, length, length, 0};
v[] = {-width / 2, -width / 2, width / 2, width / 2};
For i In {0 : 3}
  Point(i + 1) = {u[i] * along[0] + v[i] * across[0], u[i] * along[1] + v[i] * across[1],
                  u[i] * along[2]};
EndFor
For i In {1 : 4}
  Line(i) = {i, (i % 4) + 1};
EndFor
Transfinite Curve {1, 3} = nx + 1;
Transfinite Curve {2, 4} = ny + 1;
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};
Transfinite Surface {1};
If (!triangles)
  Recombine Surface {1};
EndIf
Physical Surface("sheet") = {1};
Physical Curve("held") = {4};
Physical Point("corner") = {3};
