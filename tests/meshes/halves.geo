// A straight line along x in two parts: lengths [m] and elements of each. Groups: left, right
// (lines), x_min, joint, x_max (points).
DefineConstant[ length_1 = 1, length_2 = 1, n1 = 1, n2 = 1 ];
Point(1) = {0, 0, 0};
Point(2) = {length_1, 0, 0};
Point(3) = {length_1 + length_2, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Transfinite Curve {1} = n1 + 1;
Transfinite Curve {2} = n2 + 1;
Physical Curve("left") = {1};
Physical Curve("right") = {2};
Physical Point("x_min") = {1};
Physical Point("joint") = {2};
Physical Point("x_max") = {3};
