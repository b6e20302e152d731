// Structure 1 of the two-storey pair (Ambiel et al. 2022, section 3.1): flexible, 9.2 t.
// HEB120 columns, IPE200 perimeter beams; its slabs meet those of Structure 2 at x = 3.36 m.
//   gmsh -3 azalee-s1.geo -setnumber slab 1        shell slabs instead of hexahedra
DefineConstant[ cells_x = 28, cells_y = 19, x_offset = 0 ];  // 12 cm squares
length_x = 3.36;
joint_column_length = 0.12;  // [m]
face_at_end = 1;             // the face towards the neighbour is the one at the largest x
Include "azalee-building.geo";
