// A portal frame in the plane x-y: two columns of height 3 m, a girder of 4 m, n elements each.
// Groups: columns, girder, base (points).
DefineConstant[ n = 16 ];
Point(1) = {0, 0, 0};
Point(2) = {0, 3, 0};
Point(3) = {4, 0, 0};
Point(4) = {4, 3, 0};
Line(1) = {1, 2};
Line(2) = {3, 4};
Line(3) = {2, 4};
Transfinite Curve {1, 2, 3} = n + 1;
Physical Curve("columns") = {1, 2};
Physical Curve("girder") = {3};
Physical Point("base") = {1, 3};
