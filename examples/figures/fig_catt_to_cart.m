% From Cattaneo to Carter after three units of rolling: three ways to compute it, and the element division
r3 = loadcase('catt_to_cart', 13);      % moving coordinates
s3 = loadcase('catt_to_cart', 70);      % fixed coordinates
v3 = loadcase('catt_to_cart', 127);     % fixed coordinates, moving window
subplot(1, 2, 1);
opt = plot2d;
opt.facpt = -1;
plot2d(r3, opt);
hold on
plot(s3.x-12*s3.dx, -s3.px(17,:), '*');
plot(v3.x-12*v3.dx, -v3.px(17,:), 's');
xlim([-4.5 9]);
legend('bound', 'moving coordinates', 'fixed', 'moving window', 'location','northeast');
subplot(1, 2, 2);
opt = plot3d;
opt.field   = 'eldiv';
opt.addplot = 1;
plot3d(r3, opt);
axis equal
