// A slab of two hexahedra side by side along y, for a body that is rigid in its plane: length along
// x from x0, width along y about 0, height along z [m]. Groups: body; near_low and near_high (the
// halves y < 0 and y > 0 of the face at x0), far_low and far_high (of the opposite face); points:
// corners, middle and axis (both those at y = 0).
DefineConstant[ x0 = 0, length = 1.4, width = 2.5, height = 1.4 ];
Point(1) = {x0, -width / 2, 0};
Point(2) = {x0 + length, -width / 2, 0};
Line(1) = {1, 2};
Transfinite Curve {1} = 2;
edge = 1;
body[] = {};
For i In {0 : 1}
  strip[] = Extrude {0, width / 2, 0} { Curve{edge}; Layers{1}; Recombine; };
  edge = strip[0];
  made[] = Extrude {0, 0, height} { Surface{strip[1]}; Layers{1}; Recombine; };
  body[] += {made[1]};
EndFor
t = 1e-3;
x1 = x0 + length;
w = width / 2;
near_low[] = Surface In BoundingBox {x0 - t, -w - t, -t, x0 + t, t, height + t};
near_high[] = Surface In BoundingBox {x0 - t, -t, -t, x0 + t, w + t, height + t};
far_low[] = Surface In BoundingBox {x1 - t, -w - t, -t, x1 + t, t, height + t};
far_high[] = Surface In BoundingBox {x1 - t, -t, -t, x1 + t, w + t, height + t};
corners[] = Point In BoundingBox {x0 - t, -w - t, -t, x1 + t, -w + t, height + t};
corners[] += Point In BoundingBox {x0 - t, w - t, -t, x1 + t, w + t, height + t};
middle[] = Point In BoundingBox {x0 - t, -t, -t, x1 + t, t, height + t};
Physical Volume("body") = {body[]};
Physical Surface("near_low") = {near_low[]};
Physical Surface("near_high") = {near_high[]};
Physical Surface("far_low") = {far_low[]};
Physical Surface("far_high") = {far_high[]};
Physical Point("corners") = {corners[]};
Physical Point("middle") = {middle[]};
Physical Point("axis") = {middle[]};
