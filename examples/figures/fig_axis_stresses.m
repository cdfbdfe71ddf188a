% Stresses on the axis of a pressed ball, in both bodies
[~, axis1] = loadstrs('subsurface', 1);
plot(axis1.z, -squeeze(axis1.sighyd(1,1,:)), '-o', axis1.z, squeeze(axis1.sigvm(1,1,:)), '-*', ...
     axis1.z, squeeze(axis1.sigtr(1,1,:)), '-s');
legend('-\sigma_{hyd}', '\sigma_{vm}', '\sigma_{tresca}');
xlabel('z [mm]');
ylabel('Stress [N/mm^2]');
title('Axis of a pressed ball');
grid on
