// A line from the origin up to z = height [m], moved by run along y at its top, n elements. Groups: base,
// top (points), stem (line).
DefineConstant[ height = 2, run = 0, x0 = 0, y0 = 0, z0 = 0, n = 1 ];
Point(1) = {x0, y0, z0};
Point(2) = {x0, y0 + run, z0 + height};
Line(1) = {1, 2};
Transfinite Curve {1} = n + 1;
Physical Point("base") = {1};
Physical Point("top") = {2};
Physical Curve("stem") = {1};
