% Close to flange contact: pressures in rear view and tractions, flat patch and curved reference surface
prr = read_profile('profiles/60E1.prr');
prw = read_profile('profiles/S1002.prw');
icase = [1 3];
names = {'flat', 'curved'};
for i = 1 : 2
   s = loadcase('conformal_wheel', icase(i));
   opt = plot3d;
   opt.addplot  = 1;
   opt.rw_surf  = 'both';
   opt.typplot  = 'rw_rear';
   opt.field    = 'pn';
   opt.vecscale = 8/2000;               % 8 mm for 2000 N/mm2
   subplot(2, 2, i);
   plot3d(s, opt, prr, prw);
   axis([-40 -12 -1 19]);
   title(sprintf('p_n, %s', names{i}));
   opt = plot3d;
   opt.addplot = 1;
   opt.field   = 'ptabs+vec';
   opt.zrange  = [0 800];
   subplot(2, 2, 2+i);
   plot3d(s, opt);
   title(sprintf('|p_t| [N/mm^2], %s', names{i}));
end
