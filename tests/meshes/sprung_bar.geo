// A bar of n bricks in a row along x from x0, length x side x side [m], each of its sections four
// points of their own, so that springs can hold them. Groups: body, x_min, x_max (faces); points:
// ends (of both end sections), inner (of the others; missing if n = 1).
DefineConstant[ x0 = 0, length = 3, side = 0.8, n = 4 ];
Point(1) = {x0, 0, 0};
Point(2) = {x0, side, 0};
Point(3) = {x0, side, side};
Point(4) = {x0, 0, side};
For i In {1 : 4}
  Line(i) = {i, i % 4 + 1};
EndFor
Transfinite Curve {1 : 4} = 2;
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};
Transfinite Surface {1};
Recombine Surface {1};
face = 1;
body[] = {};
For i In {1 : n}
  made[] = Extrude {length / n, 0, 0} { Surface{face}; Layers{1}; Recombine; };
  face = made[0];
  body[] += {made[1]};
EndFor
t = length / n / 100;
first[] = Point In BoundingBox {x0 - t, -t, -t, x0 + t, side + t, side + t};
last[] = Point In BoundingBox {x0 + length - t, -t, -t, x0 + length + t, side + t, side + t};
inner[] = Point In BoundingBox {x0 + t, -t, -t, x0 + length - t, side + t, side + t};
Physical Volume("body") = {body[]};
Physical Surface("x_min") = {1};
Physical Surface("x_max") = {face};
Physical Point("ends") = {first[], last[]};
If (n > 1)
  Physical Point("inner") = {inner[]};
EndIf
