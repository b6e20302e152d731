// A line from the origin up to z = height [m], n elements. Groups: base, top (points), stem (line).
DefineConstant[ height = 2, n = 1 ];
Point(1) = {0, 0, 0};
Point(2) = {0, 0, height};
Line(1) = {1, 2};
Transfinite Curve {1} = n + 1;
Physical Point("base") = {1};
Physical Point("top") = {2};
Physical Curve("stem") = {1};
