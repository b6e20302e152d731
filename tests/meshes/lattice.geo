// A lattice of beams, N cells of 1 m along each axis, one element per bar; its joints stand up to `skew` m off the
// grid, so that no two bars have one length and direction.
DefineConstant[ n = 3, skew = 0 ];
m = n + 1;
For i In {0:n}
  For j In {0:n}
    For k In {0:n}
      p = 1 + (i * m + j) * m + k;
      Point(p) = {i + skew * Sin(12.9 * p), j + skew * Sin(78.2 * p + 1), k + skew * Sin(37.7 * p + 2)};
    EndFor
  EndFor
EndFor
bars[] = {};
held[] = {};
For i In {0:n}
  For j In {0:n}
    For k In {0:n}
      p = 1 + (i * m + j) * m + k;
      If (i < n)
        c = newc; Line(c) = {p, p + m * m}; bars[] += {c};
      Else
        held[] += {p};
      EndIf
      If (j < n)
        c = newc; Line(c) = {p, p + m}; bars[] += {c};
      EndIf
      If (k < n)
        c = newc; Line(c) = {p, p + 1}; bars[] += {c};
      EndIf
    EndFor
  EndFor
EndFor
Transfinite Curve{bars[]} = 2;
Physical Point("x_min") = held[];
Physical Curve("body") = bars[];
Mesh 1;
