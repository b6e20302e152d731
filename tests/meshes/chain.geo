// Points on the x axis joined by lines, for masses and springs: ground - first - second, 1 m apart.
// Groups: ground, first, second (points), support (first again), link1, link2 (lines).
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {2, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Transfinite Curve {1, 2} = 2;
Physical Point("ground") = {1};
Physical Point("first") = {2};
Physical Point("support") = {2};
Physical Point("second") = {3};
Physical Curve("link1") = {1};
Physical Curve("link2") = {2};
