// A straight line along x for bars and beams: length [m], n elements. Groups: line, x_min, x_max.
DefineConstant[ length = 1, n = 1 ];
Point(1) = {0, 0, 0};
Point(2) = {length, 0, 0};
Line(1) = {1, 2};
Transfinite Curve {1} = n + 1;
Physical Curve("line") = {1};
Physical Point("x_min") = {1};
Physical Point("x_max") = {2};
