// A line of `height` [m] from the origin up, one element. Groups: foot, load, side (the upper point),
// rod (line).
DefineConstant[ height = 4 ];
Point(1) = {0, 0, 0};
Point(2) = {0, 0, height};
Line(1) = {1, 2};
Transfinite Curve {1} = 2;
Physical Point("foot") = {1};
Physical Point("load") = {2};
Physical Point("side") = {2};
Physical Curve("rod") = {1};
