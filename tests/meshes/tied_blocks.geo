// Two bricks of hexahedra of 1 x 1 in section, one behind the other along x, with nodes of their own where they meet; or
// two plates of quadrangles likewise.  l1, l2: lengths;  gap: between them;  shift: of the second along y;  n1, n2: cells
// along x;  m1, m2: cells across;  plates 1: of shells, from y = 0 to 1;  plates 2: the second is a plate, at level;
// tets 1: the second brick is of tetrahedra.
// Groups: first, second, x_min, x_max (ends), face, edge (where first and second meet), y_min, z_min (of both),
// corner (of the second, at y = 1); with rims 1: rim (of the face, at y = 1).
DefineConstant[ l1 = 1, l2 = 1, gap = 0, shift = 0, n1 = 2, n2 = 2, m1 = 2, m2 = 3, plates = 0, level = 0.3, rims = 0, tets = 0 ];
For k In {1 : 2}
  x = (k == 1) ? 0 : l1 + gap;
  y = (k == 1) ? 0 : shift;
  l = (k == 1) ? l1 : l2;
  n = (k == 1) ? n1 : n2;
  m = (k == 1) ? m1 : m2;
  p = newp;
  c = newl;
  corner = p + 1;
  If (plates == 1 || (plates == 2 && k == 2))
    z = (plates == 2) ? level : 0;
    Point(p) = {x, y, z};
    Point(p + 1) = {x, y + 1, z};
    Point(p + 2) = {x + l, y + 1, z};
    Point(p + 3) = {x + l, y, z};
    For i In {0 : 3}
      Line(c + i) = {p + i, p + (i + 1) % 4};
      Transfinite Curve {c + i} = ((i % 2 == 0) ? m : n) + 1;
    EndFor
    s = news;
    Curve Loop(s) = {c : c + 3};
    Plane Surface(s) = {s};
    Transfinite Surface {s};
    Recombine Surface {s};
    body~{k} = s;
    low~{k} = c;
    high~{k} = c + 2;
    side~{k} = c + 3;
  Else
    For e In {0 : 1}
      Point(p + 4 * e) = {x + e * l, y, 0};
      Point(p + 4 * e + 1) = {x + e * l, y + 1, 0};
      Point(p + 4 * e + 2) = {x + e * l, y + 1, 1};
      Point(p + 4 * e + 3) = {x + e * l, y, 1};
      For i In {0 : 3}
        Line(c + 4 * e + i) = {p + 4 * e + i, p + 4 * e + (i + 1) % 4};
      EndFor
    EndFor
    For i In {0 : 3}
      Line(c + 8 + i) = {p + i, p + 4 + i};
    EndFor
    Transfinite Curve {c : c + 7} = m + 1;
    Transfinite Curve {c + 8 : c + 11} = n + 1;
    s = news;
    For e In {0 : 1}
      Curve Loop(s + e) = {c + 4 * e : c + 4 * e + 3};
    EndFor
    For i In {0 : 3}
      Curve Loop(s + 2 + i) = {c + i, c + 8 + (i + 1) % 4, -(c + 4 + i), -(c + 8 + i)};
    EndFor
    For i In {0 : 5}
      Plane Surface(s + i) = {s + i};
      Transfinite Surface {s + i};
      If (tets == 0 || k == 1)
        Recombine Surface {s + i};
      EndIf
    EndFor
    v = newv;
    Surface Loop(v) = {s : s + 5};
    Volume(v) = {v};
    If (tets == 0 || k == 1)
      Transfinite Volume {v};
    EndIf
    rim~{k} = c + 5;
    body~{k} = v;
    low~{k} = s;
    high~{k} = s + 1;
    below~{k} = s + 2;
    side~{k} = s + 5;
  EndIf
EndFor
If (plates == 0)
  Physical Volume("second") = {body_2};
  Physical Surface("edge") = {low_2};
  Physical Surface("x_max") = {high_2};
Else
  Physical Surface("second") = {body_2};
  Physical Curve("edge") = {low_2};
  Physical Curve("x_max") = {high_2};
EndIf
If (plates == 1)
  Physical Surface("first") = {body_1};
  Physical Curve("x_min") = {low_1};
  Physical Curve("face") = {high_1};
  Physical Curve("y_min") = {side_1, side_2};
Else
  Physical Volume("first") = {body_1};
  If (rims == 1)
    Physical Curve("rim") = {rim_1};
  EndIf
  Physical Surface("x_min") = {low_1};
  Physical Surface("face") = {high_1};
EndIf
If (plates == 0)
  Physical Surface("y_min") = {side_1, side_2};
  Physical Surface("z_min") = {below_1, below_2};
EndIf
Physical Point("corner") = {corner};
