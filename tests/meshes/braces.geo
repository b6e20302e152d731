// A point held by four inclined bars, two from each side: anchors at (-run, +-rise) and
// (run, +-rise) [m]. Groups: mass and support (the point), anchors, left and right (bars).
DefineConstant[ run = 4, rise = 3 ];
Point(1) = {0, 0, 0};
Point(2) = {-run, -rise, 0};
Point(3) = {-run, rise, 0};
Point(4) = {run, -rise, 0};
Point(5) = {run, rise, 0};
For i In {1:4}
  Line(i) = {i + 1, 1};
EndFor
Transfinite Curve {1:4} = 2;
Physical Point("mass") = {1};
Physical Point("support") = {1};
Physical Point("anchors") = {2:5};
Physical Curve("left") = {1, 2};
Physical Curve("right") = {3, 4};
