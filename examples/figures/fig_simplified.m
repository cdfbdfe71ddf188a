% Tangential tractions by half-spaces, Fastsim and FaStrip
names = {'half-spaces', 'Fastsim', 'FaStrip'};
opt = plot3d;
opt.field    = 'ptabs+vec';
opt.numvecx  = 16;
opt.numvecy  = 12;
opt.zrange   = [0 220];
opt.addplot  = 1;
for icase = 1 : 3
   subplot(2, 2, icase);
   plot3d(loadcase('simplified', icase), opt);
   axis equal
   title(names{icase});
end
