// The block of plant-block.geo in bricks: shear walls on a grid of 6.1 m, a basement, two storeys, and a tower over
// the four central rooms. All walls and slabs are boxes of one grid of planes, which lie on their faces and in the
// middle of rooms, so that the bricks meet at every junction. h: size of a brick, at most. opening = 1 leaves a
// quarter of a room out of the slabs over the basement and the first storey, for stairs.
DefineConstant[ h = 0.5, opening = 1 ];

room = 6.096;
wall = 0.61; outer = 0.76;
// Planes across x, and as many across y: wall, half a room, half a room, wall, ...
g() = {};
For n In {0:4}
  thick = (n == 0 || n == 4) ? outer : wall;
  g() += n * room - thick / 2; g() += n * room + thick / 2;
  If (n < 4) g() += (n + 0.5) * room; EndIf
EndFor
bays = 13; row = bays + 1; level = row * row;
// Planes across z: mat, storey, slab, storey, ..., roof.
middle() = {-7.925, 0, 4.877, 9.754, 14.630, 19.507};
thickness() = {1.98, 0.61, 0.61, 0.61, 0.46, 0.46};
z() = {};
For k In {0:5}
  z() += middle(k) - thickness(k) / 2; z() += middle(k) + thickness(k) / 2;
EndFor
layers = 11;

// What is there of a box between planes i, i+1 and j, j+1 and k, k+1: 0 nothing, 1 slab, 2 wall. The tower stands on
// the roof of layer 6, between planes 3 and 10.
what() = {};
For k In {0:layers-1}
  For j In {0:bays-1}
    For i In {0:bays-1}
      there = k <= 6 || (i >= 3 && i <= 9 && j >= 3 && j <= 9);
      stairs = opening == 1 && (k == 2 || k == 4) && i == 10 && j == 2;
      is_wall = k % 2 == 1 && (i % 3 == 0 || j % 3 == 0);
      what() += (!there || stairs) ? 0 : (k % 2 == 0 ? 1 : (is_wall ? 2 : 0));
    EndFor
  EndFor
EndFor

// Points, lines and faces are numbered by the plane corner that they start from, and made where a box needs them.
size = level * (layers + 1);
used() = {};
For n In {0:size-1}
  used() += 0;
EndFor
For k In {0:layers-1}
  For j In {0:bays-1}
    For i In {0:bays-1}
      If (what((k * bays + j) * bays + i) > 0)
        For c In {0:7}
          used((k + (c > 3)) * level + (j + (c % 4 > 1)) * row + i + c % 2) = 1;
        EndFor
      EndIf
    EndFor
  EndFor
EndFor
For k In {0:layers}
  For j In {0:bays}
    For i In {0:bays}
      n = k * level + j * row + i;
      If (used(n)) Point(n + 1) = {g(i), g(j), z(k)}; EndIf
    EndFor
  EndFor
EndFor

// Kinds of lines and faces are told apart by multiples of size: along x, y, z; across z, y, x.
has() = {};
For n In {0:6*size-1}
  has() += 0;
EndFor
slabs() = {}; walls() = {}; base() = {}; east() = {}; west() = {};
For k In {0:layers-1}
  For j In {0:bays-1}
    For i In {0:bays-1}
      kind = what((k * bays + j) * bays + i);
      If (kind > 0)
        n = k * level + j * row + i;
        For c In {0:3}
          a = n + (c % 2) * row + (c > 1) * level;      // along x
          If (!has(a))
            has(a) = 1; Line(a + 1) = {a + 1, a + 2};
            Transfinite Line{a + 1} = Ceil((g(i+1) - g(i)) / h - 1e-6) + 1;
          EndIf
          b = n + (c % 2) + (c > 1) * level;            // along y
          If (!has(size + b))
            has(size + b) = 1; Line(size + b + 1) = {b + 1, b + row + 1};
            Transfinite Line{size + b + 1} = Ceil((g(j+1) - g(j)) / h - 1e-6) + 1;
          EndIf
          d = n + (c % 2) + (c > 1) * row;              // along z
          If (!has(2 * size + d))
            has(2 * size + d) = 1; Line(2 * size + d + 1) = {d + 1, d + level + 1};
            Transfinite Line{2 * size + d + 1} = Ceil((z(k+1) - z(k)) / h - 1e-6) + 1;
          EndIf
        EndFor
        For c In {0:1}
          a = n + c * level;                            // across z
          If (!has(3 * size + a))
            has(3 * size + a) = 1;
            Line Loop(a + 1) = {a + 1, size + a + 2, -(a + row + 1), -(size + a + 1)};
            Plane Surface(a + 1) = {a + 1}; Transfinite Surface{a + 1}; Recombine Surface{a + 1};
          EndIf
          b = n + c * row;                              // across y
          If (!has(4 * size + b))
            has(4 * size + b) = 1; f = size + b + 1;
            Line Loop(f) = {b + 1, 2 * size + b + 2, -(b + level + 1), -(2 * size + b + 1)};
            Plane Surface(f) = {f}; Transfinite Surface{f}; Recombine Surface{f};
          EndIf
          d = n + c;                                    // across x
          If (!has(5 * size + d))
            has(5 * size + d) = 1; f = 2 * size + d + 1;
            Line Loop(f) = {size + d + 1, 2 * size + d + row + 1, -(size + d + level + 1), -(2 * size + d + 1)};
            Plane Surface(f) = {f}; Transfinite Surface{f}; Recombine Surface{f};
          EndIf
        EndFor
        Surface Loop(n + 1) = {n + 1, n + level + 1, size + n + 1, size + n + row + 1, 2 * size + n + 1, 2 * size + n + 2};
        Volume(n + 1) = {n + 1}; Transfinite Volume{n + 1};
        If (kind == 1) slabs() += n + 1; Else walls() += n + 1; EndIf
        If (k == 0) base() += n + 1; EndIf
        If (k >= 3 && k <= 6)
          If (i == 0) west() += 2 * size + n + 1; EndIf
          If (i == bays - 1) east() += 2 * size + n + 2; EndIf
        EndIf
      EndIf
    EndFor
  EndFor
EndFor

Physical Volume("slabs") = slabs();
Physical Volume("walls") = walls();
Physical Surface("base") = base();
Physical Surface("east_face") = east();
Physical Surface("west_face") = west();
// The soil holds the mat where planes cross on its underside.
soil() = {};
For n In {1:level}
  soil() += n;
EndFor
Physical Point("soil") = soil();
// Equipment in the middle of rooms, on the slabs.
Physical Point("equipment") = {3*level + 5*row + 5 + 1, 3*level + 8*row + 8 + 1, 3*level + 5*row + 8 + 1,
  3*level + 8*row + 2 + 1, 5*level + 5*row + 5 + 1, 5*level + 8*row + 8 + 1, 5*level + 2*row + 2 + 1,
  5*level + 11*row + 11 + 1, 7*level + 8*row + 5 + 1, 9*level + 5*row + 8 + 1};
