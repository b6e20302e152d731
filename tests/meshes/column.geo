// A block of two layers on each other, of hexahedra: corner at (x0, 0, 0), edges lx, ly, nx, ny
// cells along them, from below `lower` [m] high in n_lower cells and `upper` [m] in n_upper cells.
// slope: each cross-section is shifted along x by slope times its height. Groups: rock, soil,
// bottom, top, joint (between the layers), x_min, x_max, sides (all four) and all.
DefineConstant[ x0 = 0, lx = 1, ly = 1, nx = 1, ny = 1, lower = 4, upper = 4, n_lower = 4, n_upper = 4, slope = 0 ];
Point(1) = {x0, 0, 0};
Point(2) = {x0 + lx, 0, 0};
Point(3) = {x0 + lx, ly, 0};
Point(4) = {x0, ly, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve {1, 3} = nx + 1;
Transfinite Curve {2, 4} = ny + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface {1};
Recombine Surface {1};
low[] = Extrude {slope * lower, 0, lower} { Surface{1}; Layers{n_lower}; Recombine; };
high[] = Extrude {slope * upper, 0, upper} { Surface{low[0]}; Layers{n_upper}; Recombine; };
Physical Volume("rock") = {low[1]};
Physical Volume("soil") = {high[1]};
Physical Surface("bottom") = {1};
Physical Surface("joint") = {low[0]};
Physical Surface("top") = {high[0]};
Physical Surface("x_min") = {low[5], high[5]};
Physical Surface("x_max") = {low[3], high[3]};
Physical Surface("sides") = {low[2], low[3], low[4], low[5], high[2], high[3], high[4], high[5]};
Physical Volume("all") = {low[1], high[1]};
