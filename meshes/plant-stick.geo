// A stick along z of one beam between two levels: the internal structure of a reactor building. Lengths in m.
// Groups: base, m1 ... m7 (points, upwards), b1 ... b7 (lines below them).
// Parameter cells: beams between two levels.
DefineConstant[ cells = 1 ];
foot = 0.3048;
levels[] = {0, 8, 13, 22, 33.5, 49, 61, 93};
Point(1) = {0, 0, 0};
For i In {1 : 7}
  Point(i + 1) = {0, 0, foot * levels[i]};
  Line(i) = {i, i + 1};
  Transfinite Curve {i} = cells + 1;
  Physical Curve(Sprintf("b%g", i)) = {i};
  Physical Point(Sprintf("m%g", i)) = {i + 1};
EndFor
Physical Point("base") = {1};
