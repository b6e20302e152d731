// A plate of one layer of hexahedra, lx x ly x lz [m], centred on y = 0, nx by ny cells. Groups:
// body, struck (the face of one cell at x = lx, the cell number `row` from 0 at y = -ly / 2).
DefineConstant[ lx = 2, ly = 2.5, lz = 0.5, nx = 8, ny = 10, row = 0 ];
side = ly / ny;
Point(1) = {0, -ly / 2, 0};
Point(2) = {lx, -ly / 2, 0};
Line(1) = {1, 2};
Transfinite Curve {1} = nx + 1;
edge = 1;
body[] = {};
For i In {0 : ny - 1}
  strip[] = Extrude {0, side, 0} { Curve{edge}; Layers{1}; Recombine; };
  edge = strip[0];
  made[] = Extrude {0, 0, lz} { Surface{strip[1]}; Layers{1}; Recombine; };
  body[] += {made[1]};
EndFor
tiny = side / 100;
low = -ly / 2 + row * side;
struck[] = Surface In BoundingBox {lx - tiny, low - tiny, -tiny,
                                   lx + tiny, low + side + tiny, lz + tiny};
Physical Volume("body") = {body[]};
Physical Surface("struck") = {struck[]};
