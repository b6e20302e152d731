// A lattice of beams, n cells of 1 m along each axis, one element per bar; its joints stand up to `skew` m off the
// grid, so that no two bars have one length and direction.
DefineConstant[ n = 3, skew = 0 ];
m = n + 1;
For i In {0 : n}
  For j In {0 : n}
    For k In {0 : n}
      p = 1 + (i * m + j) * m + k;
      Point(p) = {i + skew * Sin(12.9 * p), j + skew * Sin(78.2 * p + 1), k + skew * Sin(37.7 * p + 2)};
      If (i > 0)
        Line(newc) = {p - m * m, p};
      EndIf
      If (j > 0)
        Line(newc) = {p - m, p};
      EndIf
      If (k > 0)
        Line(newc) = {p - 1, p};
      EndIf
    EndFor
  EndFor
EndFor
Transfinite Curve{:} = 2;
Physical Point("x_min") = {1 : m * m};
Physical Curve("body") = Curve{:};
