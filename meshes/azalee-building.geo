// A two-storey building of the pair: four columns at the slab corners, perimeter beams on the
// bottom edges of the slabs, X-bracing in the two planes x = constant. [m]
// Included by azalee-s1.geo and azalee-s2.geo, which set length_x, cells_x, cells_y, x_offset,
// joint_column_length and face_at_end. Numbers to set from outside (-setnumber):
//   slab             0: hexahedra, z in [floor, floor + 0.22];  1: quadrangles at z = floor
//   cells_x, cells_y slab cells along X and Y
//   layers           hexahedra through the thickness of a slab
//   column_elements  beam elements of a column between its two joints, in each storey
//   x_offset         x of the left face
// Physical groups: slab, beam, joint_beam, column, joint_column, brace1, brace2 (one per storey),
// base (points), face1, face2 (slab faces towards the neighbour; their edges if slab = 1).
// All parts share their nodes: column heads and beams with the bottom corners and edges of the
// slabs, braces with the column lines.
DefineConstant[ slab = 0, layers = 1, column_elements = 10 ];

length_y = 2.28;
storey_height = 2.5;
slab_thickness = 0.22;
joint_beam_length = 0.12;

If (slab != 0 && slab != 1)
  Error("slab is %g: 0 (hexahedra) or 1 (quadrangles)", slab);
  Abort;
EndIf
// The joints of the beams end on a slab node: the first and last cell of the 12 cm mesh.
joint_cells_x = Round(joint_beam_length * cells_x / length_x);
joint_cells_y = Round(joint_beam_length * cells_y / length_y);
joint_cells_x = joint_cells_x < 1 ? 1 : joint_cells_x;
joint_cells_y = joint_cells_y < 1 ? 1 : joint_cells_y;
If (cells_x < 2 * joint_cells_x + 1 || cells_y < 2 * joint_cells_y + 1)
  Error("cells_x = %g, cells_y = %g: a perimeter beam needs 3 cells or more", cells_x, cells_y);
  Abort;
EndIf

corner_x[] = {0, length_x, length_x, 0};
corner_y[] = {0, 0, length_y, length_y};

below[] = {};  // the four column-line points at the floor below
For k In {0:3}
  p = newp;
  Point(p) = {x_offset + corner_x[k], corner_y[k], 0};
  below[] += p;
EndFor
Physical Point("base") = {below[]};

slabs[] = {};
beams[] = {};
joint_beams[] = {};
columns[] = {};
joint_columns[] = {};

For storey In {1:2}
  z = storey * storey_height;
  above[] = {};
  For k In {0:3}
    p = newp;
    Point(p) = {x_offset + corner_x[k], corner_y[k], z};
    above[] += p;
  EndFor

  // Columns: joint, column, joint.
  For k In {0:3}
    p = newp;
    Point(p) = {x_offset + corner_x[k], corner_y[k], z - storey_height + joint_column_length};
    q = newp;
    Point(q) = {x_offset + corner_x[k], corner_y[k], z - joint_column_length};
    c = newl;
    Line(c) = {below[k], p};
    Line(c + 1) = {p, q};
    Line(c + 2) = {q, above[k]};
    Transfinite Curve {c, c + 2} = 2;
    Transfinite Curve {c + 1} = column_elements + 1;
    joint_columns[] += {c, c + 2};
    columns[] += c + 1;
  EndFor

  // Edges of the slab, counter-clockwise from y = 0: joint, beam, joint.
  edges[] = {};
  For k In {0:3}
    n = (k + 1) % 4;
    cells = (k % 2 == 0) ? cells_x : cells_y;
    joint_cells = (k % 2 == 0) ? joint_cells_x : joint_cells_y;
    s = joint_cells / cells;
    p = newp;
    Point(p) = {x_offset + (1 - s) * corner_x[k] + s * corner_x[n],
                (1 - s) * corner_y[k] + s * corner_y[n], z};
    q = newp;
    Point(q) = {x_offset + s * corner_x[k] + (1 - s) * corner_x[n],
                s * corner_y[k] + (1 - s) * corner_y[n], z};
    c = newl;
    Line(c) = {above[k], p};
    Line(c + 1) = {p, q};
    Line(c + 2) = {q, above[n]};
    Transfinite Curve {c, c + 2} = joint_cells + 1;
    Transfinite Curve {c + 1} = cells - 2 * joint_cells + 1;
    joint_beams[] += {c, c + 2};
    beams[] += c + 1;
    edges[] += {c, c + 1, c + 2};
  EndFor

  // Slab, and its face towards the neighbour: the second edge (largest x) or the fourth.
  loop = newll;
  Curve Loop(loop) = {edges[]};
  bottom = news;
  Plane Surface(bottom) = {loop};
  Transfinite Surface {bottom} = {above[]};
  Recombine Surface {bottom};
  first = (face_at_end == 1) ? 3 : 9;
  If (slab == 0)
    // made[]: top, volume, then one lateral surface per edge line
    made[] = Extrude {0, 0, slab_thickness} { Surface{bottom}; Layers{layers}; Recombine; };
    slabs[] += made[1];
    Physical Surface(Sprintf("face%g", storey)) = {made[2 + first], made[3 + first], made[4 + first]};
  Else
    slabs[] += bottom;
    Physical Curve(Sprintf("face%g", storey)) = {edges[first], edges[first + 1], edges[first + 2]};
  EndIf

  // Braces: both diagonals in the planes x = constant, each a single element.
  b = newl;
  Line(b) = {below[0], above[3]};
  Line(b + 1) = {below[3], above[0]};
  Line(b + 2) = {below[1], above[2]};
  Line(b + 3) = {below[2], above[1]};
  Transfinite Curve {b, b + 1, b + 2, b + 3} = 2;
  Physical Curve(Sprintf("brace%g", storey)) = {b, b + 1, b + 2, b + 3};

  below[] = above[];
EndFor

If (slab == 0)
  Physical Volume("slab") = {slabs[]};
Else
  Physical Surface("slab") = {slabs[]};
EndIf
Physical Curve("beam") = {beams[]};
Physical Curve("joint_beam") = {joint_beams[]};
Physical Curve("column") = {columns[]};
Physical Curve("joint_column") = {joint_columns[]};
