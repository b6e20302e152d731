// A plate of one layer of hexahedra, lx x ly x lz [m], centred on y = 0, nx by ny cells (ny even).
// Groups: body, x_max (the whole face x = lx) and x_max_half (its half y >= 0).
DefineConstant[ lx = 3, ly = 2, lz = 0.22, nx = 6, ny = 4 ];
Point(1) = {0, -ly / 2, 0};
Point(2) = {lx, -ly / 2, 0};
Point(3) = {lx, 0, 0};
Point(4) = {lx, ly / 2, 0};
Point(5) = {0, ly / 2, 0};
Point(6) = {0, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {6, 3};
Transfinite Curve {1, 4, 7} = nx + 1;
Transfinite Curve {2, 3, 5, 6} = ny / 2 + 1;
Curve Loop(1) = {1, 2, -7, 6};
Curve Loop(2) = {7, 3, 4, 5};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Surface {1, 2};
Recombine Surface {1, 2};
lower[] = Extrude {0, 0, lz} { Surface{1}; Layers{1}; Recombine; };
upper[] = Extrude {0, 0, lz} { Surface{2}; Layers{1}; Recombine; };
Physical Volume("body") = {lower[1], upper[1]};
Physical Surface("x_max") = {lower[3], upper[3]};
Physical Surface("x_max_half") = {upper[3]};
