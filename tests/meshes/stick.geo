// A column of four storeys along z above the origin. Groups: foot, floors, roof (points), column (line).
DefineConstant[ storey = 4 ];
For i In {0:4}
  Point(1 + i) = {0, 0, i * storey};
EndFor
For i In {1:4}
  Line(i) = {i, i + 1};
  Transfinite Curve {i} = 2;
EndFor
Physical Point("foot") = {1};
Physical Point("floors") = {2, 3, 4, 5};
Physical Point("roof") = {5};
Physical Curve("column") = {1, 2, 3, 4};
