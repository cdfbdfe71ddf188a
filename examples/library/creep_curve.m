% A traction curve: tangential force over creepage, of clean rollers and with a soft layer between them
%
% The results stay in creepages [-], ratio (two columns Fx / Fn) and sol (clean, last creepage, for plot3d).

CNTC = cntc_initlibrary();
% contact problems 1, clean, and 2, with a layer of shear modulus 100 N/mm2 and 0.02 mm thickness
materials = {0, [0.28 0.28 82000 82000]; 4, [0.28 0.28 82000 82000, 100 0.02 0 0]};
cntc_initialize(1, 3);
for icp = 1 : 2
   cntc_setflags(1, icp, [CNTC.if_units, CNTC.ic_tang, CNTC.own_order], [CNTC.un_cntc, 3, 2]);
   cntc_setsolverflags(1, icp, 0, [999 100 30 1], 1e-6);
   cntc_setmaterialparameters(1, icp, materials{icp,:});
   cntc_setfrictionmethod(1, icp, 0, [0.35 0.35]);
   cntc_setreferencevelocity(1, icp, 25000);
   cntc_sethertzcontact(1, icp, -3, [25 25 6.5 5 1.2]);
   cntc_setnormalforce(1, icp, 70000);
end

creepages = [0 0.0005 0.001 0.002 0.003 0.005 0.008 0.012 0.02 0.04 0.1]';
ratio = zeros(numel(creepages), 2);
for i = 1 : numel(creepages)
   for icp = 1 : 2
      cntc_setcreepages(1, icp, creepages(i), 0, 0);
      cntc_calculate(1, icp);
      [fn, fx] = cntc_getcontactforces(1, icp);
      ratio(i,icp) = fx / fn;
   end
end
sol = cntc_getcpresults(1, 1);
cntc_closelibrary();

plot(100*creepages, -ratio, 'o-');
xlabel('longitudinal creepage [%]');
ylabel('-F_x / F_n [-]');
legend('clean', 'layer', 'location','southeast');
grid on
