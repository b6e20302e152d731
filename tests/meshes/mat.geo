// A body at (0, 0, height) and four light corners of a mat of sides 2 half, moved by offset along y,
// at z = 0; lines join each corner to the body. With legs = 0 the body alone.
// Groups: body, corners (points), legs (lines), mat (all points).
DefineConstant[ legs = 1, height = 8, offset = 0, half = 10 ];
Point(1) = {0, 0, height};
Physical Point("body") = {1};
If (legs == 1)
  Point(2) = {-half, offset - half, 0};
  Point(3) = {half, offset - half, 0};
  Point(4) = {half, offset + half, 0};
  Point(5) = {-half, offset + half, 0};
  For i In {1:4}
    Line(i) = {1, 1 + i};
    Transfinite Curve {i} = 2;
  EndFor
  Physical Point("corners") = {2, 3, 4, 5};
  Physical Point("mat") = {1, 2, 3, 4, 5};
  Physical Curve("legs") = {1, 2, 3, 4};
EndIf
