// A brick of hexahedra for the verification problems: corner (x0, y0, z0), edges lx, ly, lz [m],
// nx, ny, nz cells, turned by tilt [rad] about an axis along y through that corner. Groups: body,
// corners, x_min, x_max, y_min, y_max, z_min, z_max.
DefineConstant[ x0 = 0, y0 = 0, z0 = 0, lx = 1, ly = 1, lz = 1, nx = 1, ny = 1, nz = 1, tilt = 0 ];
Point(1) = {x0, y0, z0};
Point(2) = {x0 + lx * Cos(tilt), y0, z0 - lx * Sin(tilt)};
Point(3) = {x0 + lx * Cos(tilt), y0 + ly, z0 - lx * Sin(tilt)};
Point(4) = {x0, y0 + ly, z0};
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
made[] = Extrude {lz * Sin(tilt), 0, lz * Cos(tilt)} { Surface{1}; Layers{nz}; Recombine; };
Physical Volume("body") = {made[1]};
Physical Point("corners") = {1, 2, 3, 4}; // of z_min
Physical Surface("z_min") = {1};
Physical Surface("z_max") = {made[0]};
Physical Surface("y_min") = {made[2]};
Physical Surface("x_max") = {made[3]};
Physical Surface("y_max") = {made[4]};
Physical Surface("x_min") = {made[5]};
