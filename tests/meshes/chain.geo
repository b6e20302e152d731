// Points on the x axis, 1 m apart, for masses and springs: ground - first - second, joined by lines.
//   links   1: the line ground - first, 2: the line first - second, 3: both, 0: none
// Groups: ground, first, second (points), support (first again), link1, link2 (lines).
DefineConstant[ links = 0 ];
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {2, 0, 0};
If (links == 1 || links == 3)
  Line(1) = {1, 2};
  Transfinite Curve {1} = 2;
  Physical Curve("link1") = {1};
EndIf
If (links >= 2)
  Line(2) = {2, 3};
  Transfinite Curve {2} = 2;
  Physical Curve("link2") = {2};
EndIf
Physical Point("ground") = {1};
Physical Point("first") = {2};
Physical Point("support") = {2};
Physical Point("second") = {3};
