% Von Mises stress and vertical displacement below the pressed ball
s = loadstrs('subsurface', 1);
opt = plotstrs;
opt.yslc    = 0;
opt.addplot = 1;
subplot(1, 2, 1);
plotstrs(s, opt);
subplot(1, 2, 2);
opt.field   = 'uz';
opt.typplot = 'surf';
plotstrs(s, opt);
