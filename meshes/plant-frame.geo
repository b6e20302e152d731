// Steel frame of a plant: bays of 6.1 m, three along x and two along y, three floors on girders, braces in
// the outer bays, on a mat that is wider than the frame. Shells in the middle of mat and slabs, beams
// between their nodes. m: elements along half a bay. x0: where the frame's first column line stands. moat: 1
// names the two edges of the mat across x as groups, moat_low and moat_high.
DefineConstant[ m = 6, x0 = 0, y0 = 6.096, moat = 0 ];

module = 3.048;
nx = 6; ny = 4;          // half bays
rim = 1.524;             // of the mat around the frame
levels = 4;
z() = {0, 4.877, 9.449, 14.021, 14.021};  // the last twice
row = nx + 1;
level = row * (ny + 1);

p() = {};
For k In {0:levels-1}
  For j In {0:ny}
    For i In {0:nx}
      q = newp; Point(q) = {x0 + i * module, y0 + j * module, z(k)};
      p() += q;
    EndFor
  EndFor
EndFor

lx() = {}; ly() = {}; lz() = {};
girders() = {}; beams() = {}; corner_columns() = {}; columns() = {};
For k In {0:levels-1}
  For j In {0:ny}
    For i In {0:nx}
      n = k * level + j * row + i;
      a = -1; b = -1; c = -1;
      If (i < nx)
        a = newl; Line(a) = {p(n), p(n+1)}; Transfinite Line{a} = m + 1;
        If (k > 0 && j % 2 == 0) girders() += a; EndIf
      EndIf
      If (j < ny)
        b = newl; Line(b) = {p(n), p(n+row)}; Transfinite Line{b} = m + 1;
        If (k > 0) beams() += b; EndIf
      EndIf
      If (k < levels - 1 && i % 2 == 0 && j % 2 == 0)
        c = newl; Line(c) = {p(n), p(n+level)};
        Transfinite Line{c} = Round((z(k+1) - z(k)) * m / module) + 1;
        corner = (i == 0 || i == nx) && (j == 0 || j == ny);
        If (corner) corner_columns() += c; Else columns() += c; EndIf
      EndIf
      lx() += a; ly() += b; lz() += c;
    EndFor
  EndFor
EndFor

mat() = {}; floors() = {}; roof() = {};
For k In {0:levels-1}
  For j In {0:ny-1}
    For i In {0:nx-1}
      n = k * level + j * row + i;
      l = newll; Line Loop(l) = {lx(n), ly(n+1), -lx(n+row), -ly(n)};
      s = news; Plane Surface(s) = {l};
      Transfinite Surface{s}; Recombine Surface{s};
      If (k == 0) mat() += s; ElseIf (k == levels - 1) roof() += s; Else floors() += s; EndIf
    EndFor
  EndFor
EndFor

// The rim of the mat, by extrusion of its edges.
half = Ceil(m / 2);
rims() = {};
For side In {0:1}
  edges() = {};
  For i In {0:nx-1}
    edges() += lx(side * ny * row + i);
  EndFor
  out() = Extrude {0, (2 * side - 1) * rim, 0} { Line{edges()}; Layers{half}; Recombine; };
  For e In {0:nx-1}
    mat() += out(4 * e + 1);
  EndFor
EndFor
For side In {0:1}
  edges() = {};
  For j In {0:ny-1}
    edges() += ly(j * row + side * nx);
  EndFor
  out() = Extrude {(2 * side - 1) * rim, 0, 0} { Line{edges()}; Layers{half}; Recombine; };
  For e In {0:ny-1}
    mat() += out(4 * e + 1);
    rims() += out(4 * e);
  EndFor
EndFor

// Braces cross the middle bay along x and both bays along y, in every storey.
diagonals_x() = {}; diagonals_y() = {};
For k In {0:levels-2}
  For side In {0:1}
    n = k * level + side * ny * row + 2;
    l = newl; Line(l) = {p(n), p(n+2+level)}; Transfinite Line{l} = 2; diagonals_x() += l;
    l = newl; Line(l) = {p(n+2), p(n+level)}; Transfinite Line{l} = 2; diagonals_x() += l;
    For bay In {0:1}
      n = k * level + 2 * bay * row + side * nx;
      l = newl; Line(l) = {p(n), p(n+2*row+level)}; Transfinite Line{l} = 2; diagonals_y() += l;
      l = newl; Line(l) = {p(n+2*row), p(n+level)}; Transfinite Line{l} = 2; diagonals_y() += l;
    EndFor
  EndFor
EndFor

edge_1() = {}; edge_2() = {};
For j In {0:ny-1}
  edge_1() += ly(level + j * row);
  edge_2() += ly(2 * level + j * row);
EndFor

Physical Surface("mat") = mat();
Physical Surface("floors") = floors();
Physical Surface("roof") = roof();
Physical Line("girders") = girders();
Physical Line("beams") = beams();
Physical Line("corner_columns") = corner_columns();
Physical Line("columns") = columns();
Physical Line("braces_x") = diagonals_x();
Physical Line("braces_y") = diagonals_y();
Physical Line("edge_1") = edge_1();
Physical Line("edge_2") = edge_2();
If (moat)
  Physical Line("moat_low") = rims({0:ny-1});
  Physical Line("moat_high") = rims({ny:2*ny-1});
EndIf
soil() = {};
For n In {0:level-1}
  soil() += p(n);
EndFor
Physical Point("soil") = soil();
