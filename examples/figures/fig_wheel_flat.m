% A wheel flat comes, passes through and leaves the contact: pressures over the same part of the rail
icase = [1 4 5 6 7 8];
pitch = [5 2 1 0 -1 -2];
opt = plot3d;
opt.field    = 'pn';
opt.view     = [0 90];
opt.addeldiv = 1;
opt.zrange   = [0 1000];
opt.addplot  = 1;
for i = 1 : 6
   subplot(2, 3, i);
   s = loadcase('wheel_flat', icase(i));
   s.x_offset = s.meta.xcp_r;           % places along the rail
   plot3d(s, opt);
   axis([-14 14 -11 11]);
   title(sprintf('p_n [N/mm^2], pitch %g deg', pitch(i)));
end
