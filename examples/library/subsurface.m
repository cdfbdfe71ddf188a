% Stresses below a ball that slides over a plane: their largest value moves towards the surface with friction
%
% The results stay in friction [-], mises (largest von Mises stress [N/mm2]), place (x, z of it [mm]) and blk
% (the plane y = 0 for the last friction, for plotstrs).

CNTC = cntc_initlibrary();
cntc_initialize(1, 3);
cntc_setflags(1, 1, [CNTC.if_units, CNTC.ic_tang], [CNTC.un_cntc, 3]);
cntc_setsolverflags(1, 1, 0, [999 100 30 1], 1e-6);
cntc_setmaterialparameters(1, 1, 0, [0.3 0.3 80000 80000]);
cntc_sethertzcontact(1, 1, -3, [40 40 1 1 1.1]);
cntc_setnormalforce(1, 1, 2000);
cntc_setcreepages(1, 1, 1, 0, 0);       % all of the contact slips; the force on the ball points to -x
subs_addblock(1, 1, 1, 9, 0.1*(-12:12), 0, 0.05*(0:30));

friction = [0.0001 0.15 0.3 0.5]';
mises    = zeros(size(friction));
place    = zeros(numel(friction), 2);
for i = 1 : numel(friction)
   cntc_setfrictionmethod(1, 1, 0, friction(i)*[1 1]);
   cntc_calculate(1, 1);
   subs_calculate(1, 1);
   blk = subs_getresults(1, 1, 1, 'all');
   [mises(i), k] = max(blk.sigvm(:));
   [ix, iy, iz]  = ind2sub(size(blk.sigvm), k);
   place(i,:)    = [blk.x(ix), blk.z(iz)];
end
cntc_closelibrary();

opt = plotstrs;
opt.field = 'mises';
plotstrs(blk, opt);
