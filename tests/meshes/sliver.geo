// A column of cubes of side `side` [m], n below and n above a layer of another thickness.
// Groups: body, z_min, z_max.
DefineConstant[ side = 0.1, n = 5, thickness = 0.1 ];
Point(1) = {0, 0, 0};
Point(2) = {side, 0, 0};
Point(3) = {side, side, 0};
Point(4) = {0, side, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve {1:4} = 2;
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Surface {1};
Recombine Surface {1};
below[] = Extrude {0, 0, n * side} { Surface{1}; Layers{n}; Recombine; };
layer[] = Extrude {0, 0, thickness} { Surface{below[0]}; Layers{1}; Recombine; };
above[] = Extrude {0, 0, n * side} { Surface{layer[0]}; Layers{n}; Recombine; };
Physical Volume("body") = {below[1], layer[1], above[1]};
Physical Surface("z_min") = {1};
Physical Surface("z_max") = {above[0]};
