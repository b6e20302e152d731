// A small frame building: slabs of shells, columns of beams. Its parameters are those between the brackets; a scene
// gives others with <structure>_mesh_set, "x0=6.02,storeys=3". Lengths in m.
//
// Nodes decide what holds together. A slab and a column that meet in a Point share its node and so move and turn
// together; two Points at one place are two nodes that know nothing of each other (the program warns). Build lines
// from the same Points, and surfaces from the same lines.
DefineConstant[
  x0 = 0,          // where the west side stands
  length = 6,      // along x
  width = 4,       // along y
  bays_x = 2,      // bays along x
  bays_y = 2,      // bays along y
  storeys = 2,
  height = 3,      // of a storey
  cells = 2,       // slab elements along a bay: more of them for floor spectra at high frequencies
  pieces = 2       // beam elements along a column
];

// A point at every crossing of the column lines, on every level; level 0 is the ground.
row = bays_x + 1;
level = row * (bays_y + 1);
For k In {0:storeys}
  For j In {0:bays_y}
    For i In {0:bays_x}
      Point(1 + k * level + j * row + i) = {x0 + i * length / bays_x, j * width / bays_y, k * height};
    EndFor
  EndFor
EndFor

columns() = {};
slabs() = {};
For k In {1:storeys}
  // Lines of this level: a column down to the level below, an edge along x, an edge along y.
  west() = {}; east() = {}; along_x() = {}; along_y() = {};
  For j In {0:bays_y}
    For i In {0:bays_x}
      n = 1 + k * level + j * row + i;
      c = newl; Line(c) = {n - level, n};
      Transfinite Curve {c} = pieces + 1;
      columns() += c;
      a = -1; b = -1;
      If (i < bays_x)
        a = newl; Line(a) = {n, n + 1};
        Transfinite Curve {a} = cells + 1;
      EndIf
      If (j < bays_y)
        b = newl; Line(b) = {n, n + row};
        Transfinite Curve {b} = cells + 1;
        If (i == 0) west() += b; EndIf
        If (i == bays_x) east() += b; EndIf
      EndIf
      along_x() += a; along_y() += b;
    EndFor
  EndFor
  // One rectangle of slab per bay.
  For j In {0:bays_y - 1}
    For i In {0:bays_x - 1}
      q = j * row + i;
      l = newll; Curve Loop(l) = {along_x(q), along_y(q + 1), -along_x(q + row), -along_y(q)};
      s = news; Plane Surface(s) = {l};
      Transfinite Surface {s};
      Recombine Surface {s};
      slabs() += s;
    EndFor
  EndFor
  // The edges that may hit a neighbour, one group per level: west_1, east_1, west_2, ...
  Physical Curve(Sprintf("west_%g", k)) = west();
  Physical Curve(Sprintf("east_%g", k)) = east();
EndFor

// The scene speaks of these names.
Physical Surface("slabs") = slabs();
Physical Curve("columns") = columns();
Physical Point("base") = {1:level};
