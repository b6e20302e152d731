// A deck on columns with beams around it, whole (-b <= y <= b) or its half y >= 0. [m]
//   slab  0: hexahedra, one layer;  1: quadrangles
// Groups: body, beam, column, base (points), face (towards larger x if face_at_end = 1, else towards
// smaller x), plane (y = 0, of the half).
DefineConstant[ whole = 1, slab = 0, x0 = 0, length = 1.2, cells_x = 4, cells_y = 3, face_at_end = 1 ];
b = 0.75;
height = 1.5;
first_y = whole ? -b : 0;
x[] = {x0, x0 + length, x0 + length, x0};
y[] = {first_y, first_y, b, b};
heads[] = {};
For k In {0:3}
  heads[] += newp;
  Point(heads[k]) = {x[k], y[k], height};
EndFor
sides[] = {};
For k In {0:3}
  sides[] += newl;
  Line(sides[k]) = {heads[k], heads[(k + 1) % 4]};
  Transfinite Curve {sides[k]} = (k % 2 == 0 ? cells_x : (whole ? 2 : 1) * cells_y) + 1;
EndFor
feet[] = {};
columns[] = {};
For k In {(whole ? 0 : 2):3}
  p = newp;
  Point(p) = {x[k], y[k], 0};
  c = newl;
  Line(c) = {p, heads[k]};
  Transfinite Curve {c} = 4;
  feet[] += p;
  columns[] += c;
EndFor
loop = newll;
Curve Loop(loop) = {sides[]};
deck = news;
Plane Surface(deck) = {loop};
Transfinite Surface {deck};
Recombine Surface {deck};
towards = face_at_end ? 1 : 3;
If (slab == 0)
  made[] = Extrude {0, 0, 0.2} { Surface{deck}; Layers{1}; Recombine; };
  Physical Volume("body") = {made[1]};
  Physical Surface("face") = {made[2 + towards]};
  If (!whole)
    Physical Surface("plane") = {made[2]};
  EndIf
Else
  Physical Surface("body") = {deck};
  Physical Curve("face") = {sides[towards]};
  If (!whole)
    Physical Curve("plane") = {sides[0]};
  EndIf
EndIf
Physical Curve("column") = {columns[]};
Physical Curve("beam") = {sides[1], sides[2], sides[3]};
If (whole)
  Physical Curve("beam") += {sides[0]};
EndIf
Physical Point("base") = {feet[]};
