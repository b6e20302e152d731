// The brick of box.geo with a short bar along -x at its corner (x0, y0, z0), of the given length [m]. Group: stub.
DefineConstant[ stub = 0.01 ];
Include "box.geo";
end = newp;
Point(end) = {x0 - stub, y0, z0};
bar = newl;
Line(bar) = {1, end};
Transfinite Curve {bar} = 2;
Physical Curve("stub") = {bar};
