% Case 13 of the Manchester benchmark: shear tractions on the left and on the right rail
prr = read_profile('profiles/60E1.prr');
opt = plot3d;
opt.rw_surf = 'prr';
opt.field   = 'ptabs+vec';
opt.numvecx = 9;
opt.numvecy = 9;
opt.addplot = 1;
names = {'right', 'left'};
for icase = 1 : 2
   subplot(1, 2, 3-icase);
   s = loadcase('manchester', icase);
   plot3d(s, opt, prr);
   xlim(s.meta.xcp_r + [-9 9]);
   ylim(s.meta.ycp_r + [-9 9]);
   zlim(s.meta.zcp_r + [-5 5]);
   title(sprintf('%s rail, |p_t| [N/mm^2]', names{icase}));
end
