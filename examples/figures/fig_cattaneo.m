% Tangential tractions of the Cattaneo problem along the centre line
s = loadcase('cattaneo', 2);
opt = plot2d;
opt.yslc  = 0;
opt.facpt = -1;
plot2d(s, opt);
