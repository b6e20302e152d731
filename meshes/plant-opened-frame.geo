// Two slabs on six columns, each with a triangular opening off the grid, meshed by Blossom; from x = 2 + gap on. [m]
// Numbers to set from outside: gap, size (of the elements).
// Physical groups: floor, column, base (points), west (the edge of the upper slab at the smallest x).
DefineConstant[ gap = 0.02, size = 0.45 ];
lx = 5;
ly = 4;
Mesh.Algorithm = 6;
Mesh.MeshSizeMax = size;
Mesh.MeshSizeMin = size;
cols[] = {}; base[] = {}; floors[] = {}; edges[] = {};
For s In {1:2}
  z = 3 * s - 0.5;
  p = newp;
  For j In {0:1}
    For i In {0:2}
      Point(p + 3 * j + i) = {2 + gap + i * lx / 2, j * ly, z};
    EndFor
  EndFor
  c = newl;
  Line(c) = {p, p + 1}; Line(c + 1) = {p + 1, p + 2}; Line(c + 2) = {p + 2, p + 5};
  Line(c + 3) = {p + 5, p + 4}; Line(c + 4) = {p + 4, p + 3}; Line(c + 5) = {p + 3, p};
  q = newp;
  Point(q) = {4.2 + gap, 1.2, z}; Point(q + 1) = {5.4 + gap, 1.5, z}; Point(q + 2) = {4.8 + gap, 2.8, z};
  d = newl;
  Line(d) = {q, q + 1}; Line(d + 1) = {q + 1, q + 2}; Line(d + 2) = {q + 2, q};
  l = newll;
  Curve Loop(l) = {c : c + 5};
  Curve Loop(l + 1) = {d : d + 2};
  f = news;
  Plane Surface(f) = {l, l + 1};
  Recombine Surface {f};
  floors[] += f;
  edges[] += c + 5;
  If (s == 1)
    first = p;
    For k In {0:5}
      x[] = Point{p + k};
      b = newp;
      Point(b) = {x[0], x[1], 0};
      base[] += b;
      m = newl;
      Line(m) = {b, p + k};
      Transfinite Curve {m} = 5;
      cols[] += m;
    EndFor
  Else
    For k In {0:5}
      m = newl;
      Line(m) = {first + k, p + k};
      Transfinite Curve {m} = 5;
      cols[] += m;
    EndFor
  EndIf
EndFor
Physical Point("base") = {base[]};
Physical Curve("column") = {cols[]};
Physical Surface("floor") = {floors[]};
Physical Curve("west") = {edges[1]};
