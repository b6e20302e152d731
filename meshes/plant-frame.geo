// Steel frame of a plant: bays of 6.1 m, three along x and two along y, three floors on girders, braces in
// the outer bays, on a mat that is wider than the frame. Shells in the middle of mat and slabs, beams
// between their nodes. m: elements along half a bay. x0: where the frame's first column line stands. The
// edges of the floors at x0 are edge_1 and edge_2, those across the frame far_edge_1 and far_edge_2. moat: 1
// names the two edges of the mat across x as groups, moat_low and moat_high. post: height of a cabinet.
DefineConstant[ m = 6, x0 = 0, y0 = 6.096, moat = 0, post = 1.8 ];

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

mat() = {}; floor_1() = {}; floor_2() = {}; roof() = {};
For k In {0:levels-1}
  For j In {0:ny-1}
    For i In {0:nx-1}
      n = k * level + j * row + i;
      l = newll; Line Loop(l) = {lx(n), ly(n+1), -lx(n+row), -ly(n)};
      s = news; Plane Surface(s) = {l};
      Transfinite Surface{s}; Recombine Surface{s};
      If (k == 0) mat() += s; ElseIf (k == 1) floor_1() += s;
      ElseIf (k == 2) floor_2() += s; Else roof() += s; EndIf
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

// Braces cross the outer bays along x and both bays along y, in every storey.
braces() = {}; top_braces() = {};
For k In {0:levels-2}
  diagonals() = {};
  For side In {0:1}
    For bay In {0:1}
      n = k * level + side * ny * row + 4 * bay;
      l = newl; Line(l) = {p(n), p(n+2+level)}; Transfinite Line{l} = 2; diagonals() += l;
      l = newl; Line(l) = {p(n+2), p(n+level)}; Transfinite Line{l} = 2; diagonals() += l;
      n = k * level + 2 * bay * row + side * nx;
      l = newl; Line(l) = {p(n), p(n+2*row+level)}; Transfinite Line{l} = 2; diagonals() += l;
      l = newl; Line(l) = {p(n+2*row), p(n+level)}; Transfinite Line{l} = 2; diagonals() += l;
    EndFor
  EndFor
  If (k == levels - 2) top_braces() += diagonals(); Else braces() += diagonals(); EndIf
EndFor

// Cabinets: posts that carry a mass, on both floors and on the roof, half a bay from columns.
posts() = {}; cabinets() = {};
For k In {1:levels-1}
  For place In {0:1}
    i = place == 0 ? 1 : 5; j = place == 0 ? 1 : 3;
    q = newp; Point(q) = {x0 + i * module, y0 + j * module, z(k) + post};
    l = newl; Line(l) = {p(k * level + j * row + i), q}; Transfinite Line{l} = 2;
    posts() += l; cabinets() += q;
  EndFor
EndFor

edge_1() = {}; edge_2() = {}; far_edge_1() = {}; far_edge_2() = {};
For j In {0:ny-1}
  edge_1() += ly(level + j * row);
  edge_2() += ly(2 * level + j * row);
  far_edge_1() += ly(level + j * row + nx);
  far_edge_2() += ly(2 * level + j * row + nx);
EndFor

Physical Surface("mat") = mat();
Physical Surface("floor_1") = floor_1();
Physical Surface("floor_2") = floor_2();
Physical Surface("roof") = roof();
Physical Line("girders") = girders();
Physical Line("beams") = beams();
Physical Line("corner_columns") = corner_columns();
Physical Line("columns") = columns();
Physical Line("braces") = braces();
Physical Line("top_braces") = top_braces();
Physical Line("cabinet_posts") = posts();
Physical Point("cabinets") = cabinets();
Physical Line("edge_1") = edge_1();
Physical Line("edge_2") = edge_2();
Physical Line("far_edge_1") = far_edge_1();
Physical Line("far_edge_2") = far_edge_2();
For k In {1:levels-1}
  Physical Point(Sprintf("equipment_%g", k)) = {p(k * level + 2 * row + 3)};
EndFor
If (moat)
  Physical Line("moat_low") = rims({0:ny-1});
  Physical Line("moat_high") = rims({ny:2*ny-1});
EndIf
soil() = {};
For n In {0:level-1}
  soil() += p(n);
EndFor
Physical Point("soil") = soil();
