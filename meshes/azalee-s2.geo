// Structure 2 of the two-storey pair (Ambiel et al. 2022, section 3.1): stiff, 7.0 t.
// HEA160 columns, HEB200 perimeter beams; drawn touching Structure 1 at x = 3.36 m, the gap is
// given with the contact.
//   gmsh -3 azalee-s2.geo -setnumber slab 1        shell slabs instead of hexahedra
DefineConstant[ cells_x = 18, cells_y = 19, x_offset = 3.36 ];  // 12 cm squares
length_x = 2.16;
joint_column_length = 0.24;  // [m]
face_at_end = 0;             // the face towards the neighbour is the one at the smallest x
Include "azalee-building.geo";
