// Block of soil below z = 0 with two squares of side `side` on its surface, `joint` apart along x; `around` them and `depth` of soil.
// Elements of `size`, one across the joint. Groups: soil (volume), one and two (squares), outer (sides and bottom), body (all points).
SetFactory("Built-in");
DefineConstant[ side = 8, joint = 0.6, around = 12, depth = 12, size = 1 ];
xs[] = {-around, 0, side, side + joint, 2 * side + joint, 2 * side + joint + around};
ys[] = {-around, 0, side, side + around};
For j In {0:3}
  For i In {0:5}
    Point(1 + i + 6 * j) = {xs[i], ys[j], 0};
  EndFor
EndFor
For j In {0:3}
  For i In {0:4}
    Line(100 + i + 6 * j) = {1 + i + 6 * j, 2 + i + 6 * j};
    Transfinite Curve {100 + i + 6 * j} = 1 + Ceil((xs[i + 1] - xs[i]) / size - 1e-6);
  EndFor
EndFor
For j In {0:2}
  For i In {0:5}
    Line(200 + i + 6 * j) = {1 + i + 6 * j, 7 + i + 6 * j};
    Transfinite Curve {200 + i + 6 * j} = 1 + Ceil((ys[j + 1] - ys[j]) / size - 1e-6);
  EndFor
EndFor
soil[] = {};
outer[] = {};
For j In {0:2}
  For i In {0:4}
    s = 300 + i + 6 * j;
    Curve Loop(s) = {100 + i + 6 * j, 201 + i + 6 * j, -(106 + i + 6 * j), -(200 + i + 6 * j)};
    Plane Surface(s) = {s};
    Transfinite Surface {s};
    Recombine Surface {s};
  EndFor
EndFor
For j In {0:2}
  For i In {0:4}
    below[] = Extrude {0, 0, -depth} { Surface{300 + i + 6 * j}; Layers{Ceil(depth / size - 1e-6)}; Recombine; };
    soil[] += {below[1]};
    outer[] += {below[0]};
    If (j == 0)
      outer[] += {below[2]};
    EndIf
    If (i == 4)
      outer[] += {below[3]};
    EndIf
    If (j == 2)
      outer[] += {below[4]};
    EndIf
    If (i == 0)
      outer[] += {below[5]};
    EndIf
  EndFor
EndFor
Physical Volume("soil") = {soil[]};
Physical Surface("one") = {307};
Physical Surface("two") = {309};
Physical Surface("outer") = {outer[]};
