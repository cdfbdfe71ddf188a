% Contact patches near the flange on the left and on the right rail
prr = read_profile('profiles/60E1.prr');
opt = plot3d;
opt.rw_surf = 'prr';
opt.field   = 'ptabs+vec';
opt.numvecx = 7;
opt.numvecy = 7;
opt.addplot = 1;
icase = [9 4];
names = {'left', 'right'};
for i = 1 : 2
   subplot(1, 2, i);
   s = loadcase('wheel_on_rail', icase(i));
   plot3d(s, opt, prr);
   ylim(sort(sign(s(1).meta.ycp_r)*[0 38]));
   title(sprintf('%s rail, |p_t| [N/mm^2]', names{i}));
end
