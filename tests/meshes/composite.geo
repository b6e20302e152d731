// A strip of slab along x on a beam that lies below it, without common nodes; or two beams end to end with a node each.
//   offset: of the beam's axis below the middle of the slab;  n: elements along x, nb of the beam if not 0;  hinge 1: the
//   two beams alone.
// Groups: slab, spine (its middle line), beam, end (x = 0), tip (x = length); with hinge: beam, middle, end (both ends).
DefineConstant[ length = 4, width = 0.4, offset = 0.3, n = 40, nb = 0, hinge = 0 ];
If (hinge == 0)
  Point(1) = {0, -width / 2, 0};
  Point(2) = {0, 0, 0};
  Point(3) = {0, width / 2, 0};
  Line(1) = {1, 2};
  Line(2) = {2, 3};
  Transfinite Curve {1, 2} = 2;
  right[] = Extrude {length, 0, 0} { Curve{1}; Layers{n}; Recombine; };
  left[] = Extrude {length, 0, 0} { Curve{2}; Layers{n}; Recombine; };
  foot = newp;
  Point(foot) = {0, 0, -offset};
  beam[] = Extrude {length, 0, 0} { Point{foot}; Layers{(nb == 0) ? n : nb}; };
  Physical Surface("slab") = {right[1], left[1]};
  Physical Curve("spine") = {Abs(left[3])};
  Physical Curve("beam") = {beam[1]};
  Physical Curve("end") = {1, 2};
  Physical Point("end") = {foot};
  Physical Point("tip") = {beam[0]};
Else
  Point(1) = {0, 0, 0};
  Point(2) = {length / 2, 0, 0};
  Point(3) = {length / 2, 0, 0};
  Point(4) = {length, 0, 0};
  Line(1) = {1, 2};
  Line(2) = {3, 4};
  Transfinite Curve {1, 2} = n / 2 + 1;
  Physical Curve("beam") = {1, 2};
  Physical Point("end") = {1, 4};
  Physical Point("middle") = {2, 3};
EndIf
