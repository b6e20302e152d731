// A frame in the plane x-y: `bays` of `bay` m, `storeys` of `storey` m, n elements a member.
// Groups: columns, girders, base (points).
DefineConstant[ bays = 10, storeys = 9, bay = 6.096, storey = 3.048, n = 1 ];
w = bays + 1;
For j In {0 : storeys}
  For i In {0 : bays}
    Point(1 + i + j * w) = {i * bay, j * storey, 0};
  EndFor
EndFor
columns[] = {};
girders[] = {};
For j In {1 : storeys}
  For i In {0 : bays}
    c = newc;
    Line(c) = {1 + i + (j - 1) * w, 1 + i + j * w};
    columns[] += c;
    If (i > 0)
      g = newc;
      Line(g) = {i + j * w, 1 + i + j * w};
      girders[] += g;
    EndIf
  EndFor
EndFor
Transfinite Curve{:} = n + 1;
Physical Curve("columns") = columns[];
Physical Curve("girders") = girders[];
Physical Point("base") = {1 : w};
