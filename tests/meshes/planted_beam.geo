// A beam of the given length along x, planted in the middle of the face x = 0 of a cube of hexahedra of 1 m, without a
// common node.  n: elements of the beam;  m: cells along an edge of the cube (even or odd).
// Groups: body, back (the face x = -1), beam, joint (the face x = 0 and the foot of the beam), face and foot apart, tip.
DefineConstant[ length = 2, n = 20, m = 3 ];
Point(1) = {-1, -0.5, -0.5};
Point(2) = {-1, 0.5, -0.5};
Point(3) = {-1, 0.5, 0.5};
Point(4) = {-1, -0.5, 0.5};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve {1 : 4} = m + 1;
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};
Transfinite Surface {1};
Recombine Surface {1};
made[] = Extrude {1, 0, 0} { Surface{1}; Layers{m}; Recombine; };
foot = newp;
Point(foot) = {0, 0.01, 0.02};
Point(foot + 1) = {length, 0.01, 0.02};
beam = newl;
Line(beam) = {foot, foot + 1};
Transfinite Curve {beam} = n + 1;
Physical Volume("body") = {made[1]};
Physical Surface("back") = {1};
Physical Surface("joint") = {made[0]};
Physical Point("joint") = {foot};
Physical Surface("face") = {made[0]};
Physical Point("foot") = {foot};
Physical Curve("beam") = {beam};
Physical Point("tip") = {foot + 1};
