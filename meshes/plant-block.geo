// Reinforced-concrete block of a plant: shear walls on a grid of 6.1 m, a basement, two storeys, and a
// tower over the four central rooms. Shells in the middle of walls and slabs. Modules of half a room;
// m: elements along a module, so that an element is about 3.05 / m wide. opening_* = 1 leaves a module
// out of the slabs over the basement and the first storey, for stairs. post: height of a cabinet. pipe: radius
// of a penetration through a module of the slab over the first storey, 0: none; elements along its rim are
// `finer` times smaller than the others. pool = 1: group "pool", floor and walls of the room on the slab over the
// basement whose outer wall faces the neighbour. The walls that face neighbours are east_face (large x) and west_face.
DefineConstant[ m = 6, opening = 1, post = 1.8, pipe = 0, finer = 8, pool = 0 ];

module = 3.048;
count = 8;               // modules along x and along y
first = 2; last = 6;     // the tower stands from module line 2 to 6
levels = 6;
z() = {-7.925, 0, 4.877, 9.754, 14.630, 19.507, 19.507};  // middle of mat and slabs, the last twice
tower_from = 3;          // levels above this one belong to the tower alone

// Points, by level; -1 where there is none.
p() = {};
For k In {0:levels-1}
  For j In {0:count}
    For i In {0:count}
      inside = k <= tower_from || (i >= first && i <= last && j >= first && j <= last);
      If (inside)
        q = newp; Point(q) = {i * module, j * module, z(k)};
        p() += q;
      Else
        p() += -1;
      EndIf
    EndFor
  EndFor
EndFor
row = count + 1;
level = row * row;

// Lines along x, y and z, each from the point with its number.
lx() = {}; ly() = {}; lz() = {};
For k In {0:levels-1}
  above = Round((z(k+1) - z(k)) * m / module);
  For j In {0:count}
    For i In {0:count}
      n = k * level + j * row + i;
      a = -1; b = -1; c = -1;
      If (p(n) >= 0)
        If (i < count && p(n + 1 - (i == count)) >= 0)
          a = newl; Line(a) = {p(n), p(n+1)}; Transfinite Line{a} = m + 1;
        EndIf
        If (j < count && p(n + row * (j < count)) >= 0)
          b = newl; Line(b) = {p(n), p(n+row)}; Transfinite Line{b} = m + 1;
        EndIf
        // Walls stand on every other module line only.
        on_wall = (i % 2 == 0) || (j % 2 == 0);
        If (k < levels - 1 && on_wall && p(n + level * (k < levels - 1)) >= 0)
          c = newl; Line(c) = {p(n), p(n+level)}; Transfinite Line{c} = above + 1;
        EndIf
      EndIf
      lx() += a; ly() += b; lz() += c;
    EndFor
  EndFor
EndFor

mat() = {}; slabs() = {}; roofs() = {}; room() = {};
basement() = {}; sides_x() = {}; sides_y() = {}; inner() = {}; outer() = {}; tower() = {}; east() = {}; west() = {};
For k In {0:levels-1}
  For j In {0:count-1}
    For i In {0:count-1}
      n = k * level + j * row + i;
      exists = k <= tower_from || (i >= first && i < last && j >= first && j < last);
      stairs = opening == 1 && (k == 1 || k == 2) && i == 6 && j == 1;
      If (exists && !stairs)
        l = newll; Line Loop(l) = {lx(n), ly(n+1), -lx(n+row), -ly(n)};
        s = news;
        If (pipe > 0 && k == 2 && i == 3 && j == 5)
          x = (i + .5) * module; y = (j + .5) * module; size = module / m / finer;
          c = newp; Point(c) = {x, y, z(k)};
          For quarter In {0:3}
            Point(c + 1 + quarter) = {x + pipe * Cos(quarter * Pi / 2), y + pipe * Sin(quarter * Pi / 2), z(k), size};
          EndFor
          a = newl;
          For quarter In {0:3}
            Circle(a + quarter) = {c + 1 + quarter, c, c + 1 + (quarter + 1) % 4};
          EndFor
          rim = newll; Line Loop(rim) = {a : a + 3};
          Plane Surface(s) = {l, rim};
        Else
          Plane Surface(s) = {l};
          Transfinite Surface{s};
        EndIf
        Recombine Surface{s};
        roof = k == levels - 1 ||
               (k == tower_from && (i < first || i >= last || j < first || j >= last));
        If (k == 1 && i >= 6 && j >= 4 && j < 6) room() += s; EndIf
        If (k == 0) mat() += s; ElseIf (roof) roofs() += s; Else slabs() += s; EndIf
      EndIf
    EndFor
  EndFor
EndFor
// Walls along x, on lines of constant y, then along y.
For k In {0:levels-2}
  low = k < tower_from ? 0 : first;
  high = k < tower_from ? count : last;
  For line In {low:high:2}
    For run In {low:high-1}
      For way In {0:1}
        If (way == 0)
          n = k * level + line * row + run;
          l = newll; Line Loop(l) = {lx(n), lz(n+1), -lx(n+level), -lz(n)};
        Else
          n = k * level + run * row + line;
          l = newll; Line Loop(l) = {ly(n), lz(n+row), -ly(n+level), -lz(n)};
        EndIf
        s = news; Plane Surface(s) = {l};
        Transfinite Surface{s}; Recombine Surface{s};
        edge = line == 0 || line == count;
        across = way == 0 ? (line == 4 || line == 6) && run >= 6 : line >= 6 && run >= 4 && run < 6;
        If (k == 1 && across) room() += s; EndIf
        If (k >= tower_from) tower() += s;
        ElseIf (k == 0 && edge)
          basement() += s;
          If (way == 0) sides_y() += s; Else sides_x() += s; EndIf
        ElseIf (edge) outer() += s;
        Else inner() += s; EndIf
        If (way == 1 && k > 0 && k < tower_from)
          If (line == count) east() += s; ElseIf (line == 0) west() += s; EndIf
        EndIf
      EndFor
    EndFor
  EndFor
EndFor

Physical Surface("mat") = mat();
Physical Surface("slabs") = slabs();
Physical Surface("roofs") = roofs();
Physical Surface("basement") = basement();
Physical Surface("inner_walls") = inner();
Physical Surface("outer_walls") = outer();
Physical Surface("tower_walls") = tower();
Physical Surface("east_face") = east();
Physical Surface("west_face") = west();
If (pool == 1)
  Physical Surface("pool") = room();
EndIf
// Where the soil meets the basement, by the axis that the walls face.
Physical Surface("embedded_x") = sides_x();
Physical Surface("embedded_y") = sides_y();
// The soil holds the mat at the corners of its modules.
soil() = {};
For n In {0:level-1}
  soil() += p(n);
EndFor
Physical Point("soil") = soil();
// Equipment on the slabs over the basement and the first storey.
Physical Point("equipment") = {p(level + 3*row + 3), p(level + 5*row + 5), p(level + 3*row + 5),
  p(level + 5*row + 1), p(2*level + 3*row + 3), p(2*level + 5*row + 5), p(2*level + 1*row + 1),
  p(2*level + 7*row + 7), p(3*level + 5*row + 3), p(4*level + 4*row + 4)};
// Cabinets: posts that carry a mass, in the middle of rooms: beside the walls that face neighbours and in
// the middle of the first storey's slab, and in the tower.
posts() = {}; cabinets() = {};
For place In {0:4}
  k = place < 3 ? 2 : place + 1;
  i = place == 0 ? 7 : (place == 1 ? 1 : (place == 2 ? 5 : 3));
  j = place < 2 ? 5 : 3;
  q = newp; Point(q) = {i * module, j * module, z(k) + post};
  l = newl; Line(l) = {p(k * level + j * row + i), q}; Transfinite Line{l} = 2;
  posts() += l; cabinets() += q;
EndFor
Physical Line("cabinet_posts") = posts();
Physical Point("cabinets") = cabinets();
