// A mast of 4 m on the middle of nine points of a mat of 8 m along x, n lines between two of them.
// Groups: beams (mat and mast), bed (the nine points), load (the top).
DefineConstant[ n = 1 ];
For i In {0:8}
  Point(i + 1) = {i - 4, 0, 0};
EndFor
For i In {1:8}
  Line(i) = {i, i + 1};
EndFor
Point(10) = {0, 0, 4};
Line(9) = {5, 10};
Transfinite Curve {1:9} = n + 1;
Physical Curve("beams") = {1:9};
Physical Point("bed") = {1:9};
Physical Point("load") = {10};
