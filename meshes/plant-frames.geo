// A plant building: storeys of 4 m on a grid of 6 m, slabs and the walls of a core of shells, columns
// and girders of beams, all sharing their nodes. [m] Numbers to set from outside (-setnumber):
//   size             of the elements; 6 and 4 should be multiples of it
//   bays_x, bays_y   of the grid; the core stands in the second bay of both
//   storeys
//   x_offset         x of the left face
//   face_at_end      1: the contact faces are the slab edges at the largest x; 0: at the smallest
//   regular          1: squares; 0: quadrangles as the mesher finds them
// Physical groups: slab, wall, column, girder, base (points and the foot of the walls), and face1 ...
// (slab edges towards the neighbour, one per storey).
DefineConstant[ size = 1, bays_x = 4, bays_y = 3, storeys = 4, x_offset = 0, face_at_end = 1,
                regular = 1 ];
bay = 6;
height = 4;
cells = Round(bay / size);
up_cells = Round(height / size);

slabs[] = {};
walls[] = {};
columns[] = {};
girders[] = {};
held[] = {};
below[] = {};
core_below[] = {};

For storey In {0:storeys}
  here[] = {};
  For j In {0:bays_y}
    For i In {0:bays_x}
      p = newp;
      Point(p) = {x_offset + i * bay, j * bay, storey * height, size};
      here[] += p;
    EndFor
  EndFor
  along_x[] = {};
  along_y[] = {};
  core[] = {};
  n = bays_x + 1;
  // Lines of the floor; at the foundation those of the core alone.
  For j In {0:bays_y}
    For i In {0:bays_x - 1}
      c = -1;
      of_core = (i == 1 && (j == 1 || j == 2));
      If (storey > 0 || of_core)
        c = newl;
        Line(c) = {here[j * n + i], here[j * n + i + 1]};
        Transfinite Curve {c} = cells + 1;
      EndIf
      If (of_core)
        core[] += c;
      EndIf
      along_x[] += c;
    EndFor
  EndFor
  For j In {0:bays_y - 1}
    For i In {0:bays_x}
      c = -1;
      of_core = (j == 1 && (i == 1 || i == 2));
      If (storey > 0 || of_core)
        c = newl;
        Line(c) = {here[j * n + i], here[(j + 1) * n + i]};
        Transfinite Curve {c} = cells + 1;
      EndIf
      If (of_core)
        core[] += c;
      EndIf
      along_y[] += c;
    EndFor
  EndFor
  // core[]: its sides at y = 6 and 12 m, then those at x = 6 and 12 m.
  corners[] = {here[n + 1], here[n + 2], here[2 * n + 1], here[2 * n + 2]};
  If (storey == 0)
    Physical Point("base") = {here[]};
    held[] = core[];
  Else
    posts[] = {};
    For k In {0:#here[] - 1}
      c = newl;
      Line(c) = {below[k], here[k]};
      Transfinite Curve {c} = up_cells + 1;
      posts[] += c;
      columns[] += c;
    EndFor
    sides[] = {posts[n + 1], posts[n + 2], posts[2 * n + 1], posts[2 * n + 2]};
    For k In {0:3}
      first = (k == 0) ? 0 : ((k == 1) ? 2 : ((k == 2) ? 0 : 1));
      last = (k == 0) ? 1 : ((k == 1) ? 3 : ((k == 2) ? 2 : 3));
      loop = newll;
      Curve Loop(loop) = {core_below[k], sides[last], -core[k], -sides[first]};
      wall = news;
      Plane Surface(wall) = {loop};
      walls[] += wall;
    EndFor
    For j In {0:bays_y - 1}
      For i In {0:bays_x - 1}
        loop = newll;
        Curve Loop(loop) = {along_x[j * bays_x + i], along_y[j * n + i + 1],
                            -along_x[(j + 1) * bays_x + i], -along_y[j * n + i]};
        slab = news;
        Plane Surface(slab) = {loop};
        slabs[] += slab;
      EndFor
    EndFor
    girders[] += {along_x[], along_y[]};
    face[] = {};
    For j In {0:bays_y - 1}
      face[] += along_y[j * n + (face_at_end ? bays_x : 0)];
    EndFor
    Physical Curve(Sprintf("face%g", storey)) = {face[]};
  EndIf
  below[] = here[];
  core_below[] = core[];
EndFor

If (regular)
  Transfinite Surface {slabs[], walls[]};
EndIf
Recombine Surface {slabs[], walls[]};
Physical Surface("slab") = {slabs[]};
Physical Surface("wall") = {walls[]};
Physical Curve("column") = {columns[]};
Physical Curve("girder") = {girders[]};
Physical Curve("foot") = {held[]};
