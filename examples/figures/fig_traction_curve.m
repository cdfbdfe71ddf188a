% Traction curves from .out files: falling friction, and a layer that yields
sol = parse_out3('falling_friction');
lay = parse_out3('layer_traction');
plot(100*sol.creep.cksi, -sol.force.fx_true./sol.force.fn, '-o', ...
     100*lay.creep.cksi, -lay.force.fx_true./lay.force.fn, '-s');
xlabel('longitudinal creepage [%]');
ylabel('-F_x / F_n [-]');
xlim([0 8]);
legend('falling friction', 'layer', 'location','southeast');
title('Traction curves');
grid on
