// A square of n x n shells at height z, edge `side` [m], from (x0, y0). Groups: plate, edge (the one at
// larger x).
DefineConstant[ z = 0, side = 1, n = 1, x0 = 0, y0 = 0 ];
Point(1) = {x0, y0, z};
Point(2) = {x0 + side, y0, z};
Point(3) = {x0 + side, y0 + side, z};
Point(4) = {x0, y0 + side, z};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve {1 : 4} = n + 1;
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};
Transfinite Surface {1};
Recombine Surface {1};
Physical Surface("plate") = {1};
Physical Curve("edge") = {2};
