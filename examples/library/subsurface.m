% Stresses below the surface by the library: a ball on a plane, as the first case of examples/subsurface.inp
%
% The results stay in blk (points in the plane y = 0) and sol (the surface).

CNTC = cntc_initlibrary();
ire  = 1;
icp  = 1;
cntc_initialize(ire, 3);
cntc_setflags(ire, icp, [CNTC.if_units, CNTC.ic_tang, CNTC.ic_norm], [CNTC.un_cntc, 0, 1]);
cntc_setsolverflags(ire, icp, 0, [100 100 30 1], 1e-5);
cntc_setmaterialparameters(ire, icp, 0, [0.28 0.28 82000 82000]);
cntc_setfrictionmethod(ire, icp, 0, [0.3 0.3]);
cntc_sethertzcontact(ire, icp, -3, [41 41 2 2 1.25]);
cntc_setnormalforce(ire, icp, 1e4);
cntc_calculate(ire, icp);
sol = cntc_getcpresults(ire, icp);

subs_addblock(ire, icp, 1, 9, -2.5:0.125:2.5, 0, 0:0.1:3);
subs_calculate(ire, icp);
blk = subs_getresults(ire, icp, 1, 'all');
cntc_closelibrary();

opt = plotstrs;
opt.field = 'mises';
plotstrs(blk, opt);
