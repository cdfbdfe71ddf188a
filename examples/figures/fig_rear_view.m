% Rear view of rail and wheel near flange contact, with pressures
prr = read_profile('profiles/60E1.prr');
prw = read_profile('profiles/S1002.prw');
s = loadcase('wheel_on_rail', 4);
opt = plot3d;
opt.typplot  = 'rw_rear';
opt.rw_surf  = 'both';
opt.field    = 'pn';
opt.vecscale = 10/2000;                 % 10 mm for 2000 N/mm2
plot3d(s, opt, prr, prw);
axis([-45 15 -6 28]);
