% Traction curve by the library: one contact problem, solved for one creepage after the other
%
% Steel wheel on rail, half-axes 6 and 4.5 mm, 70 kN, friction 0.35. The result stays in the variables
% cksi [-] and fx_list [N].

CNTC = cntc_initlibrary();
ire  = 1;
icp  = 1;
cntc_initialize(ire, 3);
cntc_setflags(ire, icp, [CNTC.if_units, CNTC.ic_tang, CNTC.ic_norm], [CNTC.un_cntc, 3, 1]);
cntc_setsolverflags(ire, icp, 0, [500 50 30 1], 1e-5);
cntc_setmaterialparameters(ire, icp, 0, [0.28 0.28 82000 82000]);
cntc_setfrictionmethod(ire, icp, 0, [0.35 0.35]);
cntc_sethertzcontact(ire, icp, -3, [53 40 6 4.5 1.1]);
cntc_setrollingstepsize(ire, icp, 0, 0.25);
cntc_setreferencevelocity(ire, icp, 25000);
cntc_setnormalforce(ire, icp, 70000);

cksi    = [0.0001 0.0003 0.0006 0.001 0.0015 0.002 0.003 0.005 0.01];
fx_list = zeros(size(cksi));
for i = 1 : numel(cksi)
   cntc_setcreepages(ire, icp, cksi(i), 0, 0);
   cntc_calculate(ire, icp);
   [fn, fx] = cntc_getcontactforces(ire, icp);
   fx_list(i) = fx;
end
sol = cntc_getcpresults(ire, icp);      % of the last creepage, for plot3d
cntc_closelibrary();

plot(100*cksi, -fx_list/fn, 'o-');
xlabel('longitudinal creepage [%]');
ylabel('-F_x / F_n [-]');
grid on
