// Eight arms of 5 m in the plane x-y that meet in one point (NAFEMS FV2), n elements each. Groups:
// arms, ends (points).
DefineConstant[ n = 16 ];
Point(9) = {0, 0, 0};
For k In {1 : 8}
  Point(k) = {5 * Cos(k * Pi / 4), 5 * Sin(k * Pi / 4), 0};
  Line(k) = {9, k};
  Transfinite Curve {k} = n + 1;
EndFor
Physical Curve("arms") = {1 : 8};
Physical Point("ends") = {1 : 8};
