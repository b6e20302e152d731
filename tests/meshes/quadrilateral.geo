// A flat quadrilateral for the plates and membranes of the verification problems: corners
// (0, -width_0 / 2), (length, -width_1 / 2), (length, width_1 / 2), (0, width_0 / 2) [m], nx x ny
// cells. Every node of the boundary is a point of its own, so that springs can hold it. Groups:
// plate, x_min (the edge at x = 0); points: corners, x_edges (x = 0 and x = length), y_edges (the
// other two), both without the corners.
DefineConstant[ length = 10, width_0 = 10, width_1 = 10, nx = 16, ny = 16 ];
count = 2 * (nx + ny);
For i In {0 : count - 1}
  // the boundary is walked from corner 0 on: y_min, x_max, y_max, x_min
  If (i < nx)
    u = i / nx; v = 0;
  ElseIf (i < nx + ny)
    u = 1; v = (i - nx) / ny;
  ElseIf (i < 2 * nx + ny)
    u = 1 - (i - nx - ny) / nx; v = 1;
  Else
    u = 0; v = 1 - (i - 2 * nx - ny) / ny;
  EndIf
  Point(i + 1) = {length * u, (v - 0.5) * (width_0 + (width_1 - width_0) * u), 0};
EndFor
For i In {1 : count}
  Line(i) = {i, (i % count) + 1};
EndFor
Transfinite Curve {1 : count} = 2;
Curve Loop(1) = {1 : count};
Plane Surface(1) = {1};
Transfinite Surface {1} = {1, nx + 1, nx + ny + 1, 2 * nx + ny + 1};
Recombine Surface {1};
Physical Surface("plate") = {1};
Physical Curve("x_min") = {2 * nx + ny + 1 : count};
Physical Point("corners") = {1, nx + 1, nx + ny + 1, 2 * nx + ny + 1};
Physical Point("x_edges") = {nx + 2 : nx + ny, 2 * nx + ny + 2 : count};
Physical Point("y_edges") = {2 : nx, nx + ny + 2 : 2 * nx + ny};
