// A stick of beams along z with a point at every level, on a square mat of shells unless side is 0. Lengths in m.
// Groups: shaft (lines), levels (points), base (its lowest point), mat.
DefineConstant[
  x0 = 0,
  count = 4, height = 4,  // levels, and from one to the next
  cells = 2,              // beams between two levels
  side = 0, mat_cells = 2 // of the mat; cells along half of a side
];

For i In {0:count}
  Point(i + 1) = {x0, 0, i * height};
EndFor
For i In {1:count}
  Line(i) = {i, i + 1};
  Transfinite Curve {i} = cells + 1;
EndFor
Physical Curve("shaft") = {1:count};
Physical Point("levels") = {2:count + 1};
Physical Point("base") = {1};
If (side > 0)
  mat() = {};
  For quarter In {0:3}
    a = quarter * Pi / 2;
    p = newp;
    Point(p) = {x0 + side / 2 * Cos(a), side / 2 * Sin(a), 0};
    Point(p + 1) = {x0 + side / 2 * (Cos(a) - Sin(a)), side / 2 * (Sin(a) + Cos(a)), 0};
    Point(p + 2) = {x0 - side / 2 * Sin(a), side / 2 * Cos(a), 0};
    l = newl;
    Line(l) = {1, p}; Line(l + 1) = {p, p + 1}; Line(l + 2) = {p + 1, p + 2}; Line(l + 3) = {p + 2, 1};
    Transfinite Curve {l:l + 3} = mat_cells + 1;
    c = newll; Curve Loop(c) = {l:l + 3};
    s = news; Plane Surface(s) = {c};
    Transfinite Surface {s};
    Recombine Surface {s};
    mat() += s;
  EndFor
  Coherence;
  Physical Surface("mat") = mat();
EndIf
