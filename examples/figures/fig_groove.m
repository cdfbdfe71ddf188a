% Conformal contact: tractions with coefficients that turn with the surface, and what they change
s1 = loadcase('groove', 1);
s2 = loadcase('groove', 2);
opt = plot3d;
opt.field   = 'pn';
opt.view    = [0 90];
opt.addplot = 1;
subplot(1, 2, 1);
plot3d(s2, opt);
subplot(1, 2, 2);
opt.field    = 'ptabs+vec';
opt.veccolor = 'm';
plot3d(diffcase(s2, s1), opt);
title('Change of tangential tractions [N/mm^2]');
