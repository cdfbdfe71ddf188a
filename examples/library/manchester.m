% The Manchester benchmark with a wheel S1002 on a rail 60E1: a wheelset is moved sideways
%
% The results for the right wheel stay in y_ws [mm], forces (Fx, Fy on the rail [N]), ycp [mm] and angle [rad]
% of the first contact in track coordinates, and sol (last position, for plot3d).

folder = fullfile(fileparts(mfilename('fullpath')), '..', 'profiles');
CNTC = cntc_initlibrary();
cntc_initialize(1, 1);
cntc_setflags(1, -1, [CNTC.if_units, CNTC.ic_config, CNTC.ic_tang, CNTC.own_order], [CNTC.un_cntc, 1, 3, 2]);
cntc_setsolverflags(1, -1, 0, [999 100 30 1], 1e-5);
cntc_setmaterialparameters(1, -1, 0, [0.28 0.28 82000 82000]);
cntc_setfrictionmethod(1, -1, 0, [0.3 0.3]);
cntc_setpotcontact(1, -1, -1, [0.2 0.2 pi/2 8 4]);
cntc_setrollingstepsize(1, -1, 0, 1);
cntc_setprofileinputfname(1, fullfile(folder,'60E1.prr'), [0 0 0], [1 0]);
cntc_setprofileinputfname(1, fullfile(folder,'S1002.prw'), [1 0 0], [1 0]);
cntc_settrackdimensions(1, 3, [14 0 1435 0.025 0, 0 0 0 0 0 0]);
cntc_setwheelsetdimensions(1, 3, [1360 -70 460]);
cntc_setverticalforce(1, 10000);

y_ws   = (0:6)';
forces = zeros(numel(y_ws), 2);
ycp    = zeros(size(y_ws));
angle  = zeros(size(y_ws));
for i = 1 : numel(y_ws)
   cntc_setwheelsetposition(1, 2, [0 y_ws(i) 0 0 0.0024*y_ws(i) 0]);
   cntc_setwheelsetvelocity(1, 2, [2000 0 0 0 0 -2000/460]);
   cntc_calculate(1);
   all_forces  = cntc_getglobalforces(1);
   forces(i,:) = all_forces(1:2);
   location    = cntc_getcontactlocation(1, 1);
   ycp(i)      = location(2);
   angle(i)    = location(4);
end
sol = cntc_getcpresults(1, 1);
cntc_closelibrary();

opt = plot3d;
opt.typplot  = 'rw_rear';
opt.rw_surf  = 'both';
opt.field    = 'pn';
opt.vecscale = 10/1000;                 % 10 mm for 1000 N/mm2
plot3d(sol, opt);
axis([-45 5 -4 22]);
