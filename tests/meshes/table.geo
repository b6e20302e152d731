// A slab of 2 m x 2 m on four columns of 3 m, sound or with one fault, for the checks of meshes.
//   slab   0: hexahedra, 1: quadrangles;  unit: length of a metre in the file's own unit
//   fault  0: none, 1: the head of the fourth column is a node of its own on the slab's corner,
//          2: it ends inside a cell of the slab, 3: it is in no physical group, 4: it is in the
//          group "fourth", 5: a second slab floats beside the first, 6: two braces in group "brace"
// Groups: slab, column, base (points); fourth, brace where the fault says so.
//   both   1: slab and feet are in the group "floors" as well
DefineConstant[ slab = 1, fault = 0, unit = 1, both = 0 ];
x[] = {0, 2, 2, 0};
y[] = {0, 0, 2, 2};
plates[] = {};
corners[] = {};
For plate In {0 : (fault == 5 ? 1 : 0)}
  first = newp;
  For k In {0 : 3}
    Point(first + k) = {unit * (x[k] + 3 * plate), unit * y[k], unit * 3};
    corners[] += first + k;
  EndFor
  side = newl;
  For k In {0 : 3}
    Line(side + k) = {first + k, first + (k + 1) % 4};
    Transfinite Curve {side + k} = 3;
  EndFor
  loop = newll;
  Curve Loop(loop) = {side : side + 3};
  s = news;
  Plane Surface(s) = {loop};
  Transfinite Surface {s};
  Recombine Surface {s};
  If (slab == 0)
    made[] = Extrude {0, 0, unit * 0.2} { Surface{s}; Layers{1}; Recombine; };
    plates[] += {made[1]};
  Else
    plates[] += {s};
  EndIf
EndFor
feet[] = {};
columns[] = {};
For k In {0 : 3}
  foot = newp;
  inside = (fault == 2 && k == 3) ? 0.4 : 0;
  Point(foot) = {unit * (x[k] + inside), unit * (y[k] - inside), 0};
  head = corners[k];
  If (k == 3 && (fault == 1 || fault == 2))
    head = newp;
    Point(head) = {unit * (x[k] + inside), unit * (y[k] - inside), unit * 3};
  EndIf
  c = newl;
  Line(c) = {foot, head};
  Transfinite Curve {c} = 4;
  feet[] += {foot};
  If (k < 3 || fault < 3 || fault > 4)
    columns[] += {c};
  EndIf
  If (k == 3 && fault == 4)
    Physical Curve("fourth") = {c};
  EndIf
EndFor
If (fault == 6)
  b = newl;
  Line(b) = {feet[0], corners[1]};
  Line(b + 1) = {feet[1], corners[0]};
  Transfinite Curve {b, b + 1} = 2;
  Physical Curve("brace") = {b, b + 1};
EndIf
If (slab == 0)
  Physical Volume("slab") = {plates[]};
Else
  Physical Surface("slab") = {plates[]};
EndIf
Physical Curve("column") = {columns[]};
Physical Point("base") = {feet[]};
If (both == 1)
  Physical Surface("floors") = {plates[]};
  Physical Point("floors") = {feet[]};
EndIf
