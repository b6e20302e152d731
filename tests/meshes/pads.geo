// Nine small blocks under the nodes of a 2 x 2 grid of cells of side `cell` [m]: their tops are
// at z = 0 and do not touch each other. Groups: body, base, corner, edge, centre (tops).
DefineConstant[ cell = 0.2, side = 0.05, height = 0.1 ];
corner[] = {};
edge[] = {};
centre[] = {};
base[] = {};
body[] = {};
For i In {0:2}
  For j In {0:2}
    p = newp;
    x = i * cell - side / 2;
    y = j * cell - side / 2;
    Point(p) = {x, y, -height};
    Point(p + 1) = {x + side, y, -height};
    Point(p + 2) = {x + side, y + side, -height};
    Point(p + 3) = {x, y + side, -height};
    c = newc;
    Line(c) = {p, p + 1};
    Line(c + 1) = {p + 1, p + 2};
    Line(c + 2) = {p + 2, p + 3};
    Line(c + 3) = {p + 3, p};
    Transfinite Curve {c:c + 3} = 2;
    l = newll;
    Curve Loop(l) = {c:c + 3};
    s = news;
    Plane Surface(s) = {l};
    Transfinite Surface {s};
    Recombine Surface {s};
    made[] = Extrude {0, 0, height} { Surface{s}; Layers{1}; Recombine; };
    base[] += {s};
    body[] += {made[1]};
    If (i == 1 && j == 1)
      centre[] += {made[0]};
    ElseIf (i == 1 || j == 1)
      edge[] += {made[0]};
    Else
      corner[] += {made[0]};
    EndIf
  EndFor
EndFor
Physical Volume("body") = {body[]};
Physical Surface("base") = {base[]};
Physical Surface("corner") = {corner[]};
Physical Surface("edge") = {edge[]};
Physical Surface("centre") = {centre[]};
