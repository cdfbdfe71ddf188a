% Wheel on rail by the library: lateral displacements of the wheelset, as in examples/wheel_on_rail.inp
%
% Wheel S1002 on rail 60E1, inclined 1:40, vertical force 60 kN. The results stay in y_ws [mm], fy_list [N]
% (lateral force on the rail), ycp_list [mm] (contact on the rail) and sol (last position, for plot3d).

folder = fullfile(fileparts(mfilename('fullpath')), '..', 'profiles');
CNTC = cntc_initlibrary();
ire  = 1;
cntc_initialize(ire, 1);
cntc_setflags(ire, -1, [CNTC.if_units, CNTC.ic_config, CNTC.ic_tang], [CNTC.un_cntc, 1, 3]);
cntc_setsolverflags(ire, -1, 0, [999 100 30 1], 1e-5);
cntc_setmaterialparameters(ire, -1, 0, [0.28 0.28 82000 82000]);
cntc_setfrictionmethod(ire, -1, 0, [0.35 0.35]);
cntc_setpotcontact(ire, -1, -1, [0.25 0.25 pi/2 8 4]);
cntc_setrollingstepsize(ire, -1, 0, 1);
cntc_setprofileinputfname(ire, fullfile(folder,'60E1.prr'), [0 0 0], [1 0]);
cntc_setprofileinputfname(ire, fullfile(folder,'S1002.prw'), [1 0 0], [1 0]);
cntc_settrackdimensions(ire, 3, [14 0 1435 0.025 0, 0 0 0 0 0 0]);
cntc_setwheelsetdimensions(ire, 3, [1360 -70 460]);
cntc_setverticalforce(ire, 60000);

y_ws = [0 1.5 3];                       % [mm]
yaw  = [0 0.002 0.004];                 % [rad]
for i = 1 : numel(y_ws)
   cntc_setwheelsetposition(ire, 2, [0 y_ws(i) 0 0 yaw(i) 0]);
   cntc_setwheelsetvelocity(ire, 2, [20000 0 0 0 0 -43.5]);
   cntc_calculate(ire);
   forces      = cntc_getglobalforces(ire);
   fy_list(i)  = forces(2);
   location    = cntc_getcontactlocation(ire, 1);
   ycp_list(i) = location(6);
end
sol = cntc_getcpresults(ire, 1);
cntc_closelibrary();

opt = plot3d;
opt.typplot = 'rw_rear';
opt.rw_surf = 'both';
opt.field   = 'pn';
plot3d(sol, opt);
