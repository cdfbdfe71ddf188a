% Contact positions on rail and wheel for growing lateral displacement
sol = parse_out1('wheel_on_rail');
right = (sol.config==1);
y = sol.ws_pos.y(right);
plot(y, sol.cp_pos.ycp_r(:,right)', 'o-', y, sol.cp_pos.ycp_w(:,right)', 's--');
xlabel('lateral displacement y_{ws} [mm]');
ylabel('contact position y [mm]');
legend('rail', 'wheel', 'location','southwest');
title('Contact reference, right wheel');
grid on
