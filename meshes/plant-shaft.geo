// A slender shaft of bricks, 2 x 2 m and h high, from x = 0: 4 x 4 cells of 0.5 m. [m]
// Physical groups: shaft, base (surface), east (the face at x = 2).
DefineConstant[ h = 8 ];
Point(1) = {0, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {2, 2, 0}; Point(4) = {0, 2, 0};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
EndFor
Transfinite Curve {1:4} = 5;
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Surface {1};
Recombine Surface {1};
made[] = Extrude {0, 0, h} { Surface{1}; Layers{2 * h}; Recombine; };
Physical Volume("shaft") = {made[1]};
Physical Surface("base") = {1};
Physical Surface("east") = {made[3]};
