% Von Mises stress and vertical displacement below the pressed ball
blocks = cell(1, 8);
[blocks{:}] = loadstrs('subsurface', 1);
opt = plotstrs;
opt.yslc    = 0;
opt.addplot = 1;
subplot(1, 2, 1);
plotstrs(blocks{8}, opt);
subplot(1, 2, 2);
opt.field   = 'uz';
opt.typplot = 'surf';
plotstrs(blocks{8}, opt);
