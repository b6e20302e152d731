// A deck of quadrangles along x from x0 on, two cells wide, on piers along z that stand a span apart; bearings join
// the piers to the deck, braces run from the foot of a pier to the head of the next. [m]
//   spans, span, height: of piers, with the bearings;  width: of the deck;  n: elements per span;  m: per pier
// Groups: deck (surface), west, east (its ends), piers, bearings, braces (lines), feet, foot0, foot1, ... (points).
DefineConstant[ x0 = 0, spans = 2, span = 6, height = 5, width = 2, n = 3, m = 2 ];
bearing = 0.1;
deck[] = {};
piers[] = {};
bearings[] = {};
braces[] = {};
feet[] = {};
For i In {0:spans}
  x = x0 + i * span;
  Point(10 * i + 1) = {x, -width / 2, height};
  Point(10 * i + 2) = {x, 0, height};
  Point(10 * i + 3) = {x, width / 2, height};
  Point(10 * i + 4) = {x, 0, height - bearing};
  Point(10 * i + 5) = {x, 0, 0};
  Line(20 * i + 1) = {10 * i + 1, 10 * i + 2};
  Line(20 * i + 2) = {10 * i + 2, 10 * i + 3};
  Line(20 * i + 3) = {10 * i + 5, 10 * i + 4};
  Line(20 * i + 4) = {10 * i + 4, 10 * i + 2};
  Transfinite Curve {20 * i + 1, 20 * i + 2, 20 * i + 4} = 2;
  Transfinite Curve {20 * i + 3} = m + 1;
  piers[] += {20 * i + 3};
  bearings[] += {20 * i + 4};
  feet[] += {10 * i + 5};
  Physical Point(Sprintf("foot%g", i)) = {10 * i + 5};
EndFor
For i In {1:spans}
  For k In {1:3}
    Line(20 * i + 10 + k) = {10 * (i - 1) + k, 10 * i + k};
    Transfinite Curve {20 * i + 10 + k} = n + 1;
  EndFor
  Line(20 * i + 5) = {10 * (i - 1) + 5, 10 * i + 4};
  Transfinite Curve {20 * i + 5} = 2;
  braces[] += {20 * i + 5};
  For k In {1:2}
    Curve Loop(10 * i + k) = {20 * (i - 1) + k, 20 * i + 11 + k, -(20 * i + k), -(20 * i + 10 + k)};
    Plane Surface(10 * i + k) = {10 * i + k};
    Transfinite Surface {10 * i + k};
    Recombine Surface {10 * i + k};
    deck[] += {10 * i + k};
  EndFor
EndFor
Physical Surface("deck") = {deck[]};
Physical Curve("west") = {1, 2};
Physical Curve("east") = {20 * spans + 1, 20 * spans + 2};
Physical Curve("piers") = {piers[]};
Physical Curve("bearings") = {bearings[]};
Physical Curve("braces") = {braces[]};
Physical Point("feet") = {feet[]};
