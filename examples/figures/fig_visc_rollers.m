% Viscoelastic rollers: pressures and tractions for faster and slower relaxation
names = {'at once', 'over 4 mm', 'over 40 mm', 'never'};
lines = {'-', '--', '-.', ':'};
for icase = 1 : 4
   s = loadcase('visc_rollers', icase);
   h(icase) = plot(s.x, s.trcbnd, lines{icase}, 'color','b', 'linewidth',1.5);
   hold on
   plot(s.x, -s.px, lines{icase}, 'color','r', 'linewidth',1.5);
end
legend(h, names);
xlabel('x [mm]');
ylabel('\mu p_n (blue), -p_x (red) [N/mm^2]');
title('Relaxation of viscoelastic rollers');
grid on
