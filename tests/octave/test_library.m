% The library called from Octave: each routine, and results against those of the program

here = getenv('CONTACT_SOURCE');
setenv('CONTACT_LIBRARY', fullfile(fileparts(getenv('CONTACT_PROGRAM')), 'contact_addon_linux64.so'));
set(0, 'defaultfigurevisible', 'off');
check_error(@() cntc_setnormalforce(1, 1, 10), 'call cntc_initlibrary first');
if (exist('gateway','dir')~=7)
   mkdir('gateway');
end
cntc_buildmex(fullfile(pwd, 'gateway'));
addpath('gateway');
addpath(fullfile(here, 'examples', 'library'));

% --- every routine of the table has a function with a help text
table = fileread(fullfile(here, 'matlab', 'private', 'cntc_signature.m'));
routines = regexp(table, 'table\.(\w+) =', 'tokens');
inner = {'cntc_setfileunits','cntc_initializefirst','cntc_initializefirst_new','cntc_getmaxnumthreads', ...
         'cntc_finalizelast','cntc_getprofilevalues_new'};
check(numel(routines)>=66, 'routines of the table');
for i = 1 : numel(routines)
   name = routines{i}{1};
   if (~any(strcmp(name, inner)))
      file = fullfile(here, 'matlab', [name '.m']);
      check(exist(file,'file')==2, [name ' has a function']);
      check(~isempty(strfind(fileread(file), ['% ' upper(name) '  '])), [name ' has a help text']);
   end
   check(~isempty(cntc_mex_symbol(name)), ['the library has ' name]);
end

% --- module 3: the same contact by the library and by the program
creep_curve;
text = {'3 MODULE','203100','022020','0000231','999 100 30 1 1e-6','70000 0.001 0 0','0.35 0.35','0 0.624 25000', ...
        '0.28 0.28 82000 82000','-3','25 25 6.5 5 1.2'};
second = {'3 MODULE','203100','000000','0000231','999 100 30 1 1e-6','70000 0.1 0 0','0.35 0.35'};
f = fopen('curve.inp', 'w');
fprintf(f, "%s\n", text{:}, second{:}, '0 MODULE');
fclose(f);
[status, output] = system(sprintf('"%s" --quiet --order 2 2 curve 2>&1', getenv('CONTACT_PROGRAM')));
check(status==0, ['the program ran: ' output]);
out = parse_out3('curve');
check_near(70000*ratio([3 11],1)', out.force.fx_true, 5e-4*max(abs(out.force.fx_true)), 'forces of the traction curve');
check_near(fn, 70000, 1, 'normal force');
check(ratio(3,2)>ratio(3,1) && abs(ratio(11,2)-ratio(11,1))<1e-3, 'a layer lowers the initial slope');
check_near(sum(sol.px(:))*sol.dx*sol.dy, 70000*ratio(11,1), 50, 'tractions of getcpresults');
check_near(max(sol.pn(:)), out.force.pmax(2), 1e-3*out.force.pmax(2), 'pressures of getcpresults');
plot3d(sol);

% --- all kinds of calls in one problem
CNTC = cntc_initlibrary('', '', 'calls');
check(isequal(CNTC, cntc_getmagicnumbers()), 'magic numbers without the library');
check(CNTC.un_cntc==1934 && CNTC.fld_pn==5, 'magic numbers');
[ifcver, ierror] = cntc_initialize(2, 3);
check(ifcver>=2500 && ierror==0, 'version');
cntc_setglobalflags(CNTC.if_idebug, 0);
cntc_setflags(2, 1, [CNTC.if_units CNTC.ic_norm CNTC.ic_tang CNTC.ic_sens], [CNTC.un_cntc 1 3 3]);
check_near(cntc_getflags(2, 1, [CNTC.ic_norm CNTC.ic_tang]), [1; 3], 0, 'flags come back');
cntc_setsolverflags(2, 1, 0, [500 50 30 1], 1e-6);
cntc_setsolverflags(2, 1, 6, 20, 1e-4);
cntc_setmaterialparameters(2, 1, 0, [0.28 0.30 82000 70000]);
cntc_setfrictionmethod(2, 1, 0, [0.3 0.3]);
cntc_setpotcontact(2, 1, 1, [30 20 -6 -5 0.4 0.5]);
cntc_setundeformeddistc(2, 1, 1, [1e-3 0 1.2e-3 0 0 0]);
cntc_setrollingstepsize(2, 1, 0, 0.4);
cntc_setreferencevelocity(2, 1, 10000);
cntc_setcreepages(2, 1, 1e-3, 5e-4, 1e-4);
cntc_setnormalforce(2, 1, 1.5e4);
cntc_setmetadata(2, 1, CNTC.mt_tim, 0.5);
ierror = cntc_calculate(2, 1);
check(ierror==0, sprintf('solved: %d %s', ierror, lastwarn()));
[mx, my] = cntc_getnumelements(2, 1);
[dx, dy] = cntc_getgriddiscretization(2, 1);
[mx2, my2, xc1, yc1, dx2, dy2] = cntc_getpotcontact(2, 1);
check_near([mx2 my2 dx2 dy2], [mx my dx dy], 1e-12, 'grid');
[fn, tx, ty] = cntc_getcontactforces(2, 1);
[pn, px, py] = cntc_gettractions(2, 1);
check(isequal(size(pn), [my mx]), 'rows are y');
area = dx*dy;
check_near(area*[sum(pn(:)) sum(px(:)) sum(py(:))], [fn tx ty], 1e-4*fn, 'forces are sums of tractions');
check(tx<0 && ty<0, 'forces oppose creepages');
eldiv = cntc_getelementdivision(2, 1);
[carea, harea, sarea, parea] = cntc_getcontactpatchareas(2, 1);
check_near(area*[sum(eldiv(:)>0) sum(eldiv(:)==1) sum(eldiv(:)==2)], [carea harea sarea], 1e-9, 'areas');
check(abs(parea)<1e-9, 'no plasticity');
check_near(cntc_getmaximumpressure(2,1), max(pn(:)), 1e-9*max(pn(:)), 'largest pressure');
check_near(cntc_getmaximumtraction(2,1), max(hypot(px(:),py(:))), 1e-9*max(pn(:)), 'largest traction');
check_near(cntc_getfielddata(2, 1, CNTC.fld_py), py, 0, 'field by code');
[un, ux, uy] = cntc_getdisplacements(2, 1);
[sx, sy] = cntc_getmicroslip(2, 1);
check(all(abs(sx(eldiv==1))<1e-10) && max(abs(sx(eldiv==2)))>0, 'slip where it slips');
pen = cntc_getpenetration(2, 1);
h = cntc_getfielddata(2, 1, CNTC.fld_h);
inside = (eldiv>0);
check_near(un(inside)+h(inside), pen*ones(sum(inside(:)),1), 1e-4*pen, 'surfaces touch in the contact');
[vx, vy, phi] = cntc_getcreepages(2, 1);
check_near([vx vy phi], [1e-3 5e-4 1e-4], 1e-12, 'creepages come back');
check_near(cntc_getreferencevelocity(2,1), 10000, 1e-9, 'velocity comes back');
p = cntc_getparameters(2, 1, 2);
check_near([p.gg1 p.gg2 p.poiss1 p.poiss2], [82000 70000 0.28 0.30], 1e-9, 'material comes back');
p = cntc_getparameters(2, 1, 3);
check_near([p.nvf p.fstat p.fkin], [1 0.3 0.3], 1e-12, 'friction comes back');
sens = cntc_getsensitivities(2, 1);
check(isequal(size(sens), [4 4]) && sens(1,1)>0, 'sensitivities');
check_near(sens(1,1), 1.5*fn/pen, 0.03*fn/pen, 'stiffness after Hertz');
[tcpu, twall] = cntc_getcalculationtime(2, 1);
check(twall>=0, 'time');
cntc_resetcalculationtime(2, 1);
subs_addblock(2, 1, 1, 9, 0, [0 1], [0 1 2]);
check(subs_calculate(2, 1)==0, 'stresses');
[nx, ny, nz] = subs_getblocksize(2, 1, 1);
check_near([nx ny nz], [1 2 3], 0, 'size of a block');
cntc_settemperaturedata(2, 1, 3, [20 450 0.05 7.85e-6, 20 450 0.05 7.85e-6, 1]);
check(cntc_calculate(2, 1)==0, 'with temperatures');
[t1max, t2max] = cntc_getmaximumtemperature(2, 1);
check_near([t1max t2max], [max(cntc_getfielddata(2,1,CNTC.fld_temp1)(:)) max(cntc_getfielddata(2,1,CNTC.fld_temp2)(:))], ...
           1e-9, 'largest temperatures');
check(t1max>20, 'friction heats');
cntc_settemperaturedata(2, 1, 0);
% Hertz, units of SI, prescribed forces
cntc_setflags(2, 2, [CNTC.if_units CNTC.ic_norm CNTC.ic_tang CNTC.ic_force], [CNTC.un_si 0 3 2]);
cntc_setmaterialparameters(2, 2, 0, [0.28 0.28 82e9 82e9]);
cntc_setfrictionmethod(2, 2, 0, [0.3 0.3]);
cntc_sethertzcontact(2, 2, -1, [21 21 1 1 1.1]);
cntc_setpenetration(2, 2, 1e-4);
cntc_setrollingstepsize(2, 2, 0, 1e-3);
cntc_setreferencevelocity(2, 2, 10);
cntc_settangentialforces(2, 2, -0.3, 0);
cntc_calculate(2, 2);
[fn, tx] = cntc_getcontactforces(2, 2);
check_near(tx/(0.3*fn), -0.3, 1e-3, 'prescribed force');
hz = cntc_gethertzcontact(2, 2);
check_near([hz(1) hz(2) hz(5)], [1 1 1], 1e-6, 'curvatures in 1/m');
check_near(hz(3), sqrt(0.5e-4), 1e-5, 'half-axis of the approach');
% undeformed distance and extra slip per element
cntc_setpotcontact(2, 3, 3, [7 5 -3 -2 1 1]);
[x, y] = meshgrid(-3:3, -2:2);
cntc_setundeformeddistc(2, 3, 9, 1e-3*x.^2 + 2e-3*y.^2);
cntc_setmaterialproperties(2, 3, 82000, 0.28, 82000, 0.28);
cntc_setflags(2, 3, [CNTC.ic_norm CNTC.ic_tang], [0 3]);
cntc_setfrictionmethod(2, 3, 0, [0.3 0.3]);
cntc_setpenetration(2, 3, 0.01);
cntc_setrollingstepsize(2, 3, 0, 1);
cntc_setreferencevelocity(2, 3, 1000);
cntc_setcreepages(2, 3, 0, 0, 0);
cntc_setextrarigidslip(2, 3, 1e-4*ones(5,7), zeros(5,7));
cntc_calculate(2, 3);
check_near(cntc_getfielddata(2, 3, CNTC.fld_h), 1e-3*x.^2 + 2e-3*y.^2, 1e-12, 'distance per element');
cntc_setextrarigidslip(2, 3, zeros(5,7), zeros(5,7));
cntc_settimestep(2, 3, 0.1);
check(isempty(lastwarn()) || isempty(strfind(lastwarn(),'cntc_')), ['no warning so far: ' lastwarn()]);

% older names
cntc_setmaterialproperties(2, 3, 82000, 0.28, 70000, 0.3);
cntc_setinterfaciallayer(2, 3, 4, [8200 1.25 150 10]);
p = cntc_getparameters(2, 3, 2);
check_near([p.gg1 p.gg2 p.poiss1 p.poiss2 p.gg3 p.laythk p.tau_c0 p.k_tau], [82000 70000 0.28 0.3 8200 1.25 150 10], 1e-9, ...
           'a layer keeps the elastic constants');
cntc_setinterfaciallayer(2, 3, 0, []);
check_error(@() cntc_setinterfaciallayer(2, 3, 3, [1 1]), 'method 3 with 2 values');
cntc_initialize(4, 1);
check_error(@() cntc_setinterfaciallayer(4, [], 4, [8200 1.25 0 0]), 'use cntc_setmaterialparameters');
rail = fullfile(here, 'examples', 'profiles', '60E1.prr');
places = zeros(3, 6);
for form = 1 : 3
   cntc_setprofileinputfname(4, rail, [0 0 0], [1 0]);
   switch (form)
      case 1
         cntc_settrackdimensions(4, 3, [14 0 1435 0.025 0, 1 0.2 0.001 0 0 0]);
      case 2
         cntc_settrackdimensions_new(4, 3, [14 0 1435 0.025 0, 1 0.2 0.001 0 0 0]);
      case 3
         cntc_settrackdimensions_old(4, 3, [1435 14 0.025 0, 1 0.2 0.001 0 0 0]);
   end
   places(form,:) = cntc_getprofilevalues(4, 3, 0)(:)';
end
check_near(places(2:3,:), places([1 1],:), 1e-12, 'one track by three names');
check_error(@() cntc_settrackdimensions_old(4, 1, [14 0 1435 0.025 0]), 'ztrack = 1 with 5 values');
cntc_finalize(4);
check(isempty(lastwarn()) || isempty(strfind(lastwarn(),'cntc_')), ['no warning for older names: ' lastwarn()]);

% --- errors are reported
check_error(@() cntc_getpenetration(2, -1), 'icp must be the number');
check_error(@() cntc_setflags(2, 1, [1 2], 1), '2 params and 1 values');
check_error(@() cntc_setextrarigidslip(2, 3, 1:3, 1), 'wx has 3 values');
check_error(@() cntc_setflags(2, 1, 1.5, 1), 'whole numbers');
check_error(@() cntc_setprofileinputfname(1, 5), 'must be a text');
check_error(@() cntc_getparameters(2, 1, 7), 'itask must be');
cntc_initialize(3, 1);
text = warnings_of(@() cntc_calculate(3));
check(cntc_calculate(3)==CNTC.err_profil, 'no profile');
check(~isempty(strfind(text, 'cntc_calculate: error -32')), 'the reason is reported');
text = warnings_of(@() cntc_setmaterialparameters(2, 1, 0, [0.28 0.28]));
check(~isempty(strfind(text, 'cntc_setmaterialparameters')), 'too few values are reported');
check(isempty(warnings_of(@() cntc_calculate(3, [], 0))), 'silent with idebug = 0');
check(cntc_readinpfile(3, CNTC.inp_modul1, 'nosuch.inp')==CNTC.err_input, 'a missing file');
cntc_finalize(2);
cntc_finalize(3);
check(cntc_managelicense()==0, 'no licence');
cntc_closelibrary();

% --- wheel on rail against the program
manchester;
copyfile(fullfile(here, 'examples', 'profiles'), 'profiles');
text = {'1 MODULE','1203100','0022033','0001201','999 100 30 1 1e-5','0.3 0.3','0.28 0.28 82000 82000', ...
        '0.2 0.2 1 90d 8 4','14 0 1435 0.025','''profiles/60E1.prr'' 0 1 0','0 0 0 0 0 0','1360 -70 460', ...
        '''profiles/S1002.prw'' 0 1 0','0 0 10000 0 0 0','2000 0 0 0 0 -4.347826087'};
second = {'1 MODULE','1203100','0111002','0001201','999 100 30 1 1e-5','0 6 10000 0 0.0144 0','2000 0 0 0 0 -4.347826087'};
f = fopen('bench.inp', 'w');
fprintf(f, "%s\n", text{:}, second{:}, '0 MODULE');
fclose(f);
[status, output] = system(sprintf('"%s" --quiet --order 2 2 bench 2>&1', getenv('CONTACT_PROGRAM')));
check(status==0, ['the program ran: ' output]);
out = parse_out1('bench');
check_near(forces([1 7],2)', out.tot_forc.fy_tr, 5e-4*max(abs(forces(:,2))), 'lateral forces');
check_near(ycp([1 7])', out.cp_pos.ycp_tr(1,:), 1e-3, 'contact positions');
check_near(angle([1 7])', out.cp_pos.delttr(1,:), 1e-4, 'contact angles');
s = loadcase('bench', 2, 1);
check(isequal(size(sol.pn), size(s.pn)), 'grid size as in the .mat file');
check_near(sol.pn, s.pn, 1e-3*max(s.pn(:)), 'pressures as in the .mat file');
check_near(sol.px, s.px, 2e-3*max(s.pn(:)), 'tractions as in the .mat file');
check_near([sol.x sol.y], [s.x s.y], 1e-4, 'grid as in the .mat file');
names = {'xcp_r','ycp_r','zcp_r','deltcp_r','xcp_w','ycp_w','zcp_w','x_w','y_w','z_w','roll_w','yaw_w','y_r','z_r','roll_r','rnom_whl'};
for i = 1 : numel(names)
   check_near(sol.meta.(names{i}), s.meta.(names{i}), 2e-3, ['position ' names{i} ' as in the .mat file']);
end
p = read_profile('profiles/60E1.prr');
check_near(interp1(sol.prr.ProfileY,sol.prr.ProfileZ,-20:5:20), interp1(p.ProfileY,p.ProfileZ,-20:5:20), 2e-3, 'rail profile');
check(sol.config==1, 'right');
opt = plot3d;
opt.rw_surf = 'both';
plot3d(sol, opt);
print('library_patch.png', '-dpng', '-r40');

% the rest of wheel and rail
CNTC = cntc_initlibrary('', '', 'rail');
cntc_initialize(1, 1);
cntc_setflags(1, -1, [CNTC.ic_config CNTC.ic_tang], [0 3]);
cntc_setmaterialparameters(1, -1, 0, [0.28 0.28 82000 82000]);
cntc_setfrictionmethod(1, -1, 0, [0.3 0.3]);
cntc_setpotcontact(1, -1, -1, [0.4 0.4 pi/2 8 4]);
cntc_setrollingstepsize(1, -1, [], 1);
cntc_setprofileinputvalues(1, [p.ProfileY p.ProfileZ], [0 0 0], [1 0]);
cntc_setprofileinputfname(1, 'profiles/S1002.prw');
cntc_settrackdimensions(1, 3, [14 0 1435 0.025 0, 0 0 0 0 0 0]);
cntc_setwheelsetdimensions(1, 3, [1360 -70 460]);
cntc_setwheelsetposition(1, [], [0 -3 0 0 -0.004 0]);
cntc_setwheelsetvelocity(1, [], [20000 0 0 0 0 -43.5]);
cntc_setwheelsetflexibility(1, [], []);
cntc_setverticalforce(1, 60000);
check(cntc_calculate(1)==0, 'left wheel solved');
check(cntc_getnumcontactpatches(1)==1, 'one patch');
forces = cntc_getglobalforces(1);
check_near([forces(3) cntc_getglobalforces(1,1)(3)], [60000 60000], 60, 'vertical force');
check(forces(2)>0, 'lateral force of a left wheel');
ws = cntc_getwheelsetposition(1);
check_near(ws([1 2 5])', [0 -3 -0.004], 1e-9, 'position comes back');
check_near(cntc_getwheelsetvelocity(1)([1 6])', [20000 -43.5], 1e-9, 'velocity comes back');
check(cntc_getcontactlocation(1,1)(6)>0, 'contact on the other side');
sol = cntc_getcpresults(1, 1);
check(isequal([sol.config, sol.d_digit, sol.mater.m_digit, sol.kincns.t_digit, sol.h_digit], ...
              double(cntc_getflags(1, -1, [CNTC.ic_config, CNTC.ic_discns, CNTC.ic_mater, CNTC.ic_tang, CNTC.ic_heat]))(:)') && ...
      sol.d_digit~=sol.mater.m_digit, 'digits of getcpresults');
check(sol.config==0, 'left');
check(isequal([sol.meta.rnom_whl sol.meta.rnom_rol], [460 0]), 'radii of wheel and roller');
cntc_setflags(1, -1, CNTC.if_units, CNTC.un_spck);
other = cntc_getcpresults(1, 1);
check(cntc_getflags(1, -1, CNTC.if_units)==CNTC.un_spck, 'units after getcpresults are as before');
check_near(other.x, sol.x, 1e-12, 'getcpresults in mm');
check_near(other.px, sol.px, 1e-9*max(abs(sol.px(:))), 'tractions on the rail');
cntc_setflags(1, -1, CNTC.if_units, CNTC.un_cntc);
% in a step elements have another origin; surfaces show them where wheel and rail touch
cntc_setflags(1, -1, CNTC.ic_tang, 2);
cntc_calculate(1, -1);
step = cntc_getcpresults(1, 1);
check(hypot(step.meta.spinxo, step.meta.spinyo)>2, 'contact reference in the coordinates of the elements of a step');
for body = 'rw'
   opt = plot3d;   opt.field = 'pn';   opt.rw_surf = ['pr' body];
   plot3d(step, opt);
   drawn = get(findobj(gca, 'type','surface', 'facecolor','flat')(1));
   check(min(drawn.xdata(:))<step.meta.(['xcp_' body]) && max(drawn.xdata(:))>step.meta.(['xcp_' body]), 'x of a step on a surface');
   check(min(drawn.ydata(:))<step.meta.(['ycp_' body]) && max(drawn.ydata(:))>step.meta.(['ycp_' body]), 'y of a step on a surface');
end
cntc_setflags(1, -1, CNTC.ic_tang, 3);
cntc_calculate(1, -1);
opt = plot3d;   opt.rw_surf = 'prr';
plot3d(sol, opt);
check_near(cntc_getprofilevalues(1, -1, [0 0])', [0 0], 0, 'profile is there');
n = cntc_getprofilevalues(1, 0, [1 -1]);
yz = cntc_getprofilevalues(1, 1, [1 -1]);
check(isequal(size(yz), [n 2]), 'points of the wheel');
check(size(cntc_getprofilevalues(1, 2, [0 0]),2)==2, 'points in track coordinates');
check(isequal(size(cntc_getprofilevalues(1, 3, [0 0])), [6 1]), 'gauge');
s = cntc_getprofilevalues(1, 4, [0 1], 5);
check_near(diff(s), 5*ones(numel(s)-1,1), 1e-9, 'equal distances');
check(numel(cntc_getprofilevalues(1, 5, [0 1], 5))==numel(s), 'inclinations');
check_error(@() cntc_getcpresults(1, 2), 'number 2 was requested');
cntc_closelibrary();

% --- below the surface
subsurface;
% without friction, after Hertz: the largest stress is 0.62 p0 in a depth of 0.48 half-axes for nu = 0.3
p0 = 1.5*2000/pi;
check_near([mises(1)/p0, place(1,1), place(1,2)], [0.620 0 0.48], 0.03, 'stresses without friction');
check(place(4,2)==0 && mises(4)>1.2*mises(1), 'with much friction the largest stress is at the surface');
check(isequal([blk.nx blk.ny blk.nz], [25 1 31]), 'size of the block');
check_near(blk.sigtr, blk.sigma1-blk.sigma3, 1e-6*mises(4), 'Tresca');
check_near(blk.sighyd, (blk.sigxx+blk.sigyy+blk.sigzz)/3, 1e-6*mises(4), 'mean stress');
with_tensor = sqrt(((blk.sigma1-blk.sigma2).^2+(blk.sigma2-blk.sigma3).^2+(blk.sigma3-blk.sigma1).^2)/2);
check_near(blk.sigvm, with_tensor, 1e-6*mises(4), 'von Mises');
