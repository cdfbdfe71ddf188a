% Surface temperatures of wheel and rail in sliding, and along the centre line
s = loadcase('sliding_temperature', 1);
subplot(1, 2, 1);
opt = plot3d;
opt.field   = 'temp2';
opt.addplot = 1;
opt.view    = [0 90];
plot3d(s, opt);
subplot(1, 2, 2);
[~, iy] = min(abs(s.y));
in = (s.eldiv(iy,:)>0);
plot(s.x(in), s.temp1(iy,in), '-o', s.x(in), s.temp2(iy,in), '-*', 'markersize',4);
legend('wheel', 'rail');
xlabel('x [mm]');
ylabel('temperature [^oC]');
title(sprintf('y = %.2f mm', s.y(iy)));
grid on
