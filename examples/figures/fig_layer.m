% Shear stress of a layer that is pushed forward, back and forward again
sol = parse_out3('layer_element');
path = cumsum(reshape(sol.creep.cksi, 7, 3));
tau  = reshape(sol.force.fx_true, 7, 3);          % one element of 1 mm2
plot([0 0 0; path], [0 0 0; tau], '-o');
legend('hardening', 'softening', 'neither');
xlabel('shift [mm]');
ylabel('shear stress [N/mm^2]');
title('A layer that yields');
grid on
