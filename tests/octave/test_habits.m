% Calls in the style of scripts for other programs: argument lists, outputs, names of fields and options

folder = fullfile(getenv('CONTACT_SOURCE'), 'examples', 'profiles');

% --- overall results of module 3
run_example('cattaneo');
sol = parse_out3('cattaneo');
[creep, force] = parse_out3('cattaneo.out');
check(isequal(size(creep), [2 8]) && isequal(size(force), [2 9]), 'arrays with one row per case');
check_near(creep(:,1:2), [sol.creep.pen; sol.creep.cksi]', 0, 'approach and creepage');
check(isequaln(creep(:,5:8), [sol.stat.ncon; sol.stat.nadh; sol.stat.nslip; sol.stat.nplast]'), 'numbers of elements');
check_near(force(:,[1 2 7]), [sol.force.fn; sol.force.fx; sol.force.pmax]', 0, 'forces');
[c, f] = parse_out3('cattaneo', 0);
check(isequaln(c, creep) && isequaln(f, force), 'use_struct = 0');
check(isequaln(parse_out3('cattaneo', 0), creep), 'one array');
s = parse_out3('cattaneo', 1);
check(isstruct(s) && isequaln(s.creep.ncon, sol.stat.ncon) && isfield(s.force, 'temp1'), 'use_struct = 1, names');
run_example('subsurface');
[~, ~, subs] = parse_out3('subsurface');
t = parse_out3('subsurface');
check_near(subs(:,:,2), [t.subs.sigvm.val(1,:,1); t.subs.sigvm.x(1,:,1); t.subs.sigvm.y(1,:,1); t.subs.sigvm.z(1,:,1)]', 0, ...
           'largest stresses as an array');
% combined constants, friction at rest, one output for each patch
text = {'3 MODULE', '203100', '0322020', '0001101', '100 100 30 10 1e-5', '0 0.001 0 0', '0.2 0.08 500 0.04 2000', '0.001 1', ...
         '0d 0.2 1000', '0.42 0.28 200 1000', '1', '20 20 -2 -2 0.2 0.2', '1 1', '0.01 0 0.01 0 0 0', '0 END', ''};
run_input('unlike', strjoin(text, "\n"), '--hdf5');
s = loadcase('unlike', 1);
g = s.mater.gg;   nu = s.mater.poiss;
check(isequal(g, [200 1000]), 'the bodies');
check_near([1/s.mater.ga s.mater.si/s.mater.ga], [mean(1./g) mean(nu./g)], 1e-15, 'means of 1/G and nu/G');
check_near(s.mater.ak/s.mater.ga, ((1-2*nu(1))/g(1) - (1-2*nu(2))/g(2))/4, 1e-15, 'difference parameter');
check_near(s.fric.fstat, 0.2 + 0.08 + 0.04, 1e-12, 'friction at rest');
t = loadcase('unlike.h5', 1);
check_near([t.mater.ga t.mater.si t.mater.ak t.fric.fstat], [s.mater.ga s.mater.si s.mater.ak s.fric.fstat], 1e-6, 'the same in HDF5');
[b{1:9}] = loadstrs('subsurface', 1);
check(isstruct(b{1}) && isempty(b{9}), 'more blocks are requested than exist');

% --- one patch by its number
check_same_struct(loadcase('cattaneo', 2, 1), loadcase('cattaneo', 2), 0, 'patch 1 of basic contact');
text = warnings_of(@() loadcase('cattaneo', 2, 2));
check(isempty(loadcase('cattaneo', 2, 2)) && ~isempty(strfind(text, 'has 1 contact patch')), 'a missing patch is []');
check_error(@() loadcase('cattaneo', 99, 2), 'there are no results of case 99');

% --- fields by names with dots
s = mysetfield(struct('a',1), 'b.c', [3 4]);
check(isequal(s, struct('a',1, 'b',struct('c',[3 4]))), 'mysetfield');
check(isequal(mysetfield(s, 'b.c', {2}, 5).b.c, [3 5]), 'with subscripts');
check(isequal(mygetfield(s, 'b.c'), [3 4]) && isequal(mygetfield([s s], 'a'), [1 1]), 'mygetfield');
check(myisfield(s, 'b.c') && myisfield(s, 'b') && myisfield(s, '') && ~myisfield(s, 'b.d') && ~myisfield(s, 'a.c'), 'myisfield');

% --- options completed
o = plot2d([], struct('yslc',1));
check(o.yslc==1 && isfield(o,'pxory'), 'plot2d([], opt)');
o = plot3d([], struct('field','py'));
check(strcmp(o.field,'py') && isfield(o,'view'), 'plot3d([], opt)');
warning('off', 'all');
o = plotstrs([], struct('field','ux', 'other',1));
warning('on', 'all');
check(strcmp(o.field,'ux') && ~isfield(o,'other'), 'plotstrs([], opt), without options that are unknown');

% --- overall results of module 1
run_example('manchester', 'profiles/60E1.prr', 'profiles/S1002.prw');
sol = parse_out1('manchester');
[npatch, ws_pos, tot_forc, cp_pos, cp_creep, cp_force] = parse_out1('manchester.out', [], 0);
check(isequal(npatch, sol.npatch) && isequaln(ws_pos, sol.ws_pos) && isequaln(tot_forc, sol.tot_forc), 'six outputs');
check(isequaln(cp_pos, sol.cp_pos) && isequaln(cp_creep, sol.cp_creep) && isequaln(cp_force, sol.cp_force), 'and the others');
check_near([ws_pos.x; ws_pos.vx], [ws_pos.s; ws_pos.vs], 0, 'x and vx');
check(isequaln(cp_pos.delt_tr, cp_pos.delttr) && isequaln(cp_pos.ncon, sol.cp_stat.ncon), 'angle and numbers in cp_pos');
check(isequal(size(cp_pos.prev_icp), [1 2 2]) && isequaln(cp_force.fric, cp_force.fricw), 'patches before, frictional power');
check(all(isfield(tot_forc, {'mx_tr','my_tr','mz_tr','mx_ws','my_ws','mz_ws'})), 'moments');
check(isequaln(parse_out1('manchester', -1), sol), 'all result elements');
check_error(@() parse_out1('manchester', 2), 'no numbers of result elements');
text = regexprep(fileread('manchester.out'), ' Case +(\d)', ' Case     $1 for w/r contact on result element  $1, t=   0.25');
f = fopen('elements.out', 'w');   fwrite(f, text);   fclose(f);
s = parse_out1('elements');
check_near([s.ire; s.tim], [1 2; 0.25 0.25], 0, 'result elements and times');
s = parse_out1('elements', 2);
check(isequal(s.icase, 2) && isequaln(s.cp_pos.ycp_tr, sol.cp_pos.ycp_tr(:,2)) && isequaln(s.tot_forc.fx_tr, sol.tot_forc.fx_tr(2)), ...
      'one result element');

% --- profiles
y = (-10:10)';
z = y.^2/600;
write_simpack('habit.prr', 'a comment', y, z);
p = read_simpack('habit.prr');
check_near([p.ProfileY p.ProfileZ], [y z], 1e-9, 'write_simpack(fname, comment, y, z)');
check(strcmp(p.comment, 'a comment'), 'its comment');
write_simpack([y z], 'ours.prr', 'a comment');
check(isequal(fileread('ours.prr'), fileread('habit.prr')), 'the same in our order');
q = read_profile('habit.prr', [], -1, -1, 1, 1, 0, 0, 0);
check_near(q.ProfileY, y, 1e-9, 'read_profile with 9 arguments');
% modify_profile with the arguments of established scripts; everything else is unchanged
wheel = read_profile(fullfile(folder,'S1002.prw'));
p = modify_profile(wheel, 1, 0, 0, 1, 20, 0);
check_near(interp1(p.ProfileY, p.ProfileZ, 20), 0, 1e-12, 'y_tape: the height is measured from there');
check_near(diff(p.ProfileZ), diff(wheel.ProfileZ), 1e-12, 'and the shape stays');
q = modify_profile(wheel, 1, 0, 0, 1, 20);
check_near(q.ProfileZ, p.ProfileZ, 0, 'y_tape alone');
p = modify_profile(wheel, 1, 0, 1, 2, [], 1);
check_near(p.ProfileData(:,1:2), 2*[flipud(wheel.ProfileY) -flipud(wheel.ProfileZ)], 1e-12, 'reverse_order, mirror_z = 1');
check_near(p.OrigData(:,1:2), [wheel.ProfileY wheel.ProfileZ], 0, 'OrigData');
check(p.XYPoints==numel(wheel.ProfileY), 'XYPoints');
fold = struct('ProfileY',[-3;-2;-2.5;-1;0;0.1;1;2;2;3], 'ProfileZ',[5;4;3;1;0;0;1;2;3;5], 'ProfileAngle',(1:10)');
p = modify_profile(fold, 0, 0, 0, 1, [], 0, 0.5);
check_near(p.ProfileY, fold.ProfileY([1:5 7:10]), 0, 'point_dist_min');
p = modify_profile(fold, 0, 0, 0, 1, [], 0, [], 1);
check_near(p.Mask, [1 0 1 1 1 1 1 1 0 1]', 0, 'delete_foldback = 1 marks where y turns back or stands');
check(numel(p.ProfileY)==10, 'and all points are kept');
p = modify_profile(fold, 0, 1, 0, 1, [], 1, [], 2);
check_near([p.ProfileY p.ProfileAngle], [-flipud(fold.ProfileY([1 3:8 10])) -flipud([1 3:8 10]')], 0, 'delete_foldback = 2 leaves them out');
check_error(@() modify_profile(wheel, 1, 0, 0, 1, 500, 0), 'no profile at y_tape');
f = fopen('habit.slcs', 'w');
fprintf(f, '0 1 %% offset, scale\n3 %% slices\n0 0 0 %% features\n1 %% interpolation\n');
fprintf(f, '%d ''habit.prr''\n', [0; 100; 200]);
fclose(f);
s = read_slices('habit.slcs', 0, -1, 2, 0);
check_near(s.prof{2}.ProfileY, 2*y, 1e-9, 'read_slices(fname, mirror_y, mirror_z, scale_yz, idebug)');
check(s.u_method==1 && s.nfeat==0 && isequal(s.s, s.u) && strcmp(s.slc_file, 'habit.slcs'), 'its names');
check(isequal(s.slc_ib, [1 2; 1 2; 1 2]), 'the whole of each slice');
check(isequal(size(s.xsurf), size(s.zsurf)) && isequal(s.xsurf(:,[1 end]), s.u*[1 1]), 'xsurf: one row for each slice');
check_near(interp1(s.ysurf(2,:), s.zsurf(2,:), 2*[-7 0 10]), interp1(s.prof{2}.ProfileY, s.prof{2}.ProfileZ, 2*[-7 0 10]), ...
           0.05, 'ysurf, zsurf: its points');
s = read_slices('habit.slcs', 0, 0, -1, 2);
check_near(s.prof{3}.ProfileY, 2*y, 1e-9, 'and with is_wheel in front');
f = fopen('habit.rai', 'w');
fprintf(f, 'RAILPROFILE\na rail\nGAUGEPOINT CUSTOM 10\nGAUGE 1435\n');
% left and right rail, heights upwards: the gauge face is at 717.5
fprintf(f, '%g,%g %g,%g\n', [-717.5 -20 717.5 -20; -717.5 -4 717.5 -4; -720 0 720 0; -750 0 751 0; -780 -3 781 -3]');
fclose(f);
p = read_profile('habit.rai');
check(p.GaugeHeight==10 && p.GaugeWidth==1435 && p.is_wheel==0, 'head of a Vampire file');
check_near([p.ProfileY p.ProfileZ], [0 20; 0 4; 2.5 0; 33.5 0; 63.5 3], 1e-9, 'rail of a Vampire file');
p = read_profile('habit.rai', 0, 0, 0, 1, 0);
check_near(p.ProfileY(4), 32.5, 1e-9, 'the left rail');
f = fopen('habit.whe', 'w');
fprintf(f, 'WHEELPROFILE\na wheel\nTREADDATUM EUROPEAN\nFLANGEBACK 1360\n');
fprintf(f, '%g %g %g %g ! remark\n', [-680 0 680 0; -700 28 700 28; -750 0 750 0; -800 -3 800 -3]');
fclose(f);
p = read_vampire('habit.whe');
check(p.FlangeBackPos==-70 && p.FlangeBackDist==1360, 'flange back');
check_near(p.ProfileY, [-70; -50; 0; 50], 1e-9, 'the tread datum is the origin');
check_error(@() read_vampire('habit.prr'), 'WHEELPROFILE');

% --- smoothing: a parabola is preserved, noise is removed, waves of length l_filt are halved
x = (0:0.5:100)';
spl = make_spline(x, sin(x/10), [], 0);
d = 0.25;
check_near(spl.a0y + d*(spl.a1y + d*(spl.a2y + d*spl.a3y)), sin((x(1:end-1)+d)/10), 5e-4, 'a spline through points');
check_near(spl.y, sin(x/10), 0, 'the points');
wave = cos(2*pi*x/5);
p = smooth_profile([x, 1e-3*wave], 5, [], [], []);
check_near(p(60:140,2), 0.5e-3*wave(60:140), 2e-5, 'half of a wave of the length of the filter');
p = smooth_profile([x, 1e-3*cos(2*pi*x/50)], 5, [], [], []);
check_near(p(60:140,2), 1e-3*cos(2*pi*x(60:140)/50), 1e-6, 'long waves stay');
line = make_spline(x, 3 + 2*x + 0.1*wave, [], 1e12);
check(max(abs(diff(line.y, 2))) < 1e-6, 'much smoothness is a straight line');
corner = max(0, x-50);
q = smooth_profile([x, corner], 10);
check_near(q(:,2), corner, 1e-9, 'a kink stays a kink');
q = smooth_profile([x, corner], 10, [], [], []);
check(abs(q(101,2)) > 0.1, 'without it the corner is rounded');
q = smooth_profile(read_profile(fullfile(folder,'60E1.prr')), [], 0, 0.25);
check(all(abs(diff(q.ProfileS(2:end-1)) - 0.25) < 5e-3), 'new points at equal steps');
check_error(@() make_spline(x, x, [], 0, [], [], [], 1, 1, 4), 'use_deriv must be 2 or 3');

% --- B-splines: the same curve as by the equations of the smoothing spline, with and without kinks
place = [0; 10*mod((1:40)'*0.61803398875, 1); 10];
place = sort(place);
weight = 1 + 0.5*sin(7*place);
fine = linspace(0, 10, 777)';
for kinks = {[], [15 30]}
   for lambda = [1e-3 1]
      ours = make_spline(place, sin(place), cos(2*place), lambda, weight, kinks{1});
      by_b = make_spline(place, sin(place), cos(2*place), lambda, weight, kinks{1}, [], 1);
      [~, yy, zz] = eval_spline(ours, fine);
      [~, yb, zb] = eval_spline(by_b, fine);
      check_near([yb zb], [yy zz], 1e-8, 'B-splines with a knot at each point');
      [~, b, ~, c] = eval_spline_deriv(by_b, fine);
      [~, yy, ~, zz] = eval_spline_deriv(ours, fine);
      check_near([b c], [yy zz], 1e-6, 'their second derivatives');
   end
end
more = make_spline(place, sin(place), [], 1, weight, [15 30], [], 1, [], 2, 0);
check(all(diff(more.tj(1:4))>0) && all(by_b.tj(1:4)==0), 'use_repl: outer knots');
check_near(more.y, by_b.y, 1e-10, 'do not change the curve');
wide = make_spline(x, sin(x/10), [], 0, [], [], [], 1, 5);
check(numel(wide.s)==21 && numel(wide.cy)==numel(wide.tj)-4, 'ds_bspl: knots');
[~, yy] = eval_spline(wide, x);
check_near(yy, sin(x/10), 2e-4, 'a curve of few knots');
cubic = x.^2/50 - x;
third = make_spline(x, cubic + 0.1*wave, [], 1e9, [], [], [], 0, [], 3);
check(max(abs(diff(third.y, 3))) < 1e-6 && max(abs(third.y - cubic)) < 0.05, 'use_deriv = 3: a parabola is preserved');
jump = max(0, x-50).^2/100;
free = make_spline(x, jump, [], 10, [], [], 101, 0, [], 3);
tied = make_spline(x, jump, [], 10, [], [], [], 0, [], 3);
[~, yf] = eval_spline(free, [49.9; 50.1]);
[~, yt] = eval_spline(tied, [49.9; 50.1]);
check_near(yf, [0; 1e-4], 1e-6, 'iaccel: the curvature jumps from 0 to 1/50');
check(max(abs(yt - [0; 1e-4])) > 1e-4, 'without it the jump is smoothed');
[q, spl] = smooth_profile([x, jump], [], 10, 0.25, [], 101, 0, 1, 2);
check(size(q,1)==1+ceil(spl.s(end)/0.25) && isfield(spl, 'tj') && isequal(spl.iaccel, 101), 'the same arguments of smooth_profile');
% basis functions: a partition of one, exact for straight lines; polynomials of pieces; roots
t = [0 0 0 0 1 2.5 2.5 4 7 7 7 7];
at = [0; 0.3; 1; 2.5; 3.9; 7];
[b1, b2, b3, b4] = eval_bspline_basisfnc(t, at);
check(isequal([size(b1,2) size(b2,2) size(b3,2) size(b4,2)], 11:-1:8) && isequal(sum(b1,2), ones(6,1)), 'sizes of all orders');
check_near([sum(b3,2) sum(b4,2)], ones(6,2), 1e-14, 'a partition of one');
greville = (t(2:9) + t(3:10) + t(4:11))/3;
check_near(b4*greville', at, 1e-14, 'a straight line');
check_near(eval_bspline_basisfnc([0 1 2], [-1; 0.5; 3], 1), [0 0; 1 0; 0 0], 0, 'nothing beyond the knots');
poly = make_ppform(struct('s',unique(t)', 'tj',t, 'cy',[0 0 0 1 2 -1 3 0]', 'cz',[]));
for i = 1 : 4
   d = (0.1:0.2:0.9)' * (poly.s(i+1)-poly.s(i));
   [~, ~, ~, b] = eval_bspline_basisfnc(t, poly.s(i)+d);
   check_near(poly.ay0(i) + d.*(poly.ay1(i) + d.*(poly.ay2(i) + d.*poly.ay3(i))), b*poly.cy, 1e-13, 'polynomials of the pieces');
end
[u, found] = solve_cubic_eq([0 0 0 1], [3 5], 1, 0, 1, 1, 1);
check(found==1 && abs(u-4)<1e-12, 'root of a piece, from its beginning on');
[u, found] = solve_cubic_eq([0 1 0 0], [3 5], 7);
check(found==0 && isnan(u), 'there is none');
check_error(@() make_spline(x, x(2:end), [], 0), 'same number of points');

% --- colours
check(isequal(size(matlab_color([1 2 8])), [3 3]) && isequal(matlab_color(8), matlab_color(1)), 'colours in turn');

% --- curves: points, derivatives, positions along a profile
t = linspace(0, pi, 400)';
arc = make_spline([], 10*cos(t), 10*sin(t));
[~, yy, zz] = eval_spline(arc, [5; 15.7; 100]);
check_near(hypot(yy, zz), [10; 10; 10], 1e-5, 'points on a circle, the last one at its end');
check_near(yy(3), -10, 1e-6, 'behind the end');
[ss, yy, zz] = eval_spline(arc, [], [7; 0; -3]);
check_near([zz ss], [sqrt(100-[7;0;-3].^2) 10*acos([0.7;0;-0.3])], 1e-3, 'positions of given y');
check(isnan(eval_spline(arc, [], 11)), 'there is none');
[dy, ~, dz, ~, kappa, r] = eval_spline_deriv(arc, [3; 8; 20]);
check_near(hypot(dy, dz), [1; 1; 1], 1e-5, 'unit tangents');
check_near([kappa r], [0.1 10; 0.1 10; 0.1 10], 1e-2, 'curvature of the circle and its radius');
check_near(arc.ay1, arc.a1y, 0, 'coefficients by both names');
check_near(make_arclength([-3;0;3], [4;0;4]), [-5;0;5], 1e-12, 'zero where y is zero');
check_error(@() eval_spline(arc), 'either positions');

% --- names of contact positions used by other scripts
sol = parse_out1('manchester');
check(isequaln([sol.cp_pos.xtr sol.cp_pos.ytr sol.cp_pos.ztr sol.cp_pos.yr sol.cp_pos.zr sol.cp_pos.xw sol.cp_pos.yw sol.cp_pos.zw], ...
               [sol.cp_pos.xcp_tr sol.cp_pos.ycp_tr sol.cp_pos.zcp_tr sol.cp_pos.ycp_r sol.cp_pos.zcp_r sol.cp_pos.xcp_w ...
                sol.cp_pos.ycp_w sol.cp_pos.zcp_w]), 'xtr ... zw');

% --- surfaces of splines: polynomials of third order and their derivatives are reproduced
u = [0 1 2.5 4 6 7]';
v = linspace(-1, 2, 9);
[uu, vv] = ndgrid(u, v);
height = @(a, b) 1 + a.^2.*b - 0.1*a.^3 + b.^3;
s = make_2dspline(u, v, [], 3*vv + 0.2*uu, height(uu,vv), [], 0);
[~, x, y, z] = eval_2dspline(s, [0.3 3 7], [-0.9 0.1 2]);
check_near([x; y; z], [0.3 3 7; 3*[-0.9 0.1 2]+0.2*[0.3 3 7]; height([0.3 3 7],[-0.9 0.1 2])], 1e-11, 'points one by one');
[~, x, ~, z] = eval_2dspline(s, [0.3 3 7], [-0.9 0.1]);
check_near([x z], [[0.3;3;7]*[1 1], height([0.3;3;7]*[1 1], ones(3,1)*[-0.9 0.1])], 1e-11, 'all with all');
place = eval_2dspline(s, [0.5 3], [], [1.3 -1]);
check_near(place, ([1.3 -1]-0.2*[0.5 3])/3, 1e-9, 'v of given y');
place = eval_2dspline(s, [0.5 3], [], [1.3 -1 2]);
check_near(place, (ones(2,1)*[1.3 -1 2]-0.2*[0.5;3]*ones(1,3))/3, 1e-9, 'the same, all with all');
check(isnan(eval_2dspline(s, 3, [], 99)), 'no v for it');
[dx, dy, dz] = eval_2dspline_deriv(s, 3, 0.4, 1);
check_near([dx dy dz], [1 0.2 2*3*0.4-0.3*9], 1e-10, 'derivatives to u');
[dx, dy, dz] = eval_2dspline_deriv(s, 3, 0.4, 2);
check_near([dx dy dz], [0 3 9+3*0.16], 1e-10, 'derivatives to v');
t = make_2dspline(u, v, 2*uu, vv, height(uu,vv), ones(6,9), 0);
[~, x] = eval_2dspline(t, 3, 0.4);
check_near(x, 6, 1e-11, 'x of its own');
t = make_2dspline((0:5)', v, ones(6,1)*v, ((0:5)==2)'*ones(1,9));
[~, ~, ~, z] = eval_2dspline(t, [1 2 3 4], 0.2*[1 1 1 1]);
check_near(z, [1 4 1 0]/6, 1e-12, 'control points: one sixth, four sixths');
[~, ~, ~, z] = eval_2dspline(t, 9, 0.2);
check(isnan(z), 'outside of the surface');
% reflected light: a plane, and a cylinder
plane = make_2dspline(u, v, uu, vv, 0*uu, [], 0);
[x, y, z, theta] = make_reflec(plane, [0 0 1], [0 90], u, v);
check_near([x y z], [uu vv 0*uu], 1e-12, 'points of the surface');
check_near(theta, 0*uu, 1e-6, 'light and eye above a plane');
[~, ~, ~, theta] = make_reflec(plane, [90 45], [0 90], u, v);
check_near(theta, 45+0*uu, 1e-10, 'azimuth and elevation');
angles = linspace(0, 1, 60);
tube = make_2dspline(u, angles, u*ones(1,60), ones(6,1)*sin(angles), ones(6,1)*cos(angles), [], 0);
[~, ~, ~, theta] = make_reflec(tube, [0 0 1], [0 0 1], 3, angles);
check_near(theta, 2*angles*180/pi, 1e-3, 'twice the angle of the normal');
check_error(@() make_2dspline(u(1:3), v, vv(1:3,:), vv(1:3,:)), '4 values');
% missing points, by a mask and by NaN: the surface ends there, and is the same polynomial up to there
height = @(a, b) 1 + a.^2.*b - 0.1*a.^2 + b.^3;
mask = ones(6,9);
mask(1:3,7:9) = 0;
mask(5:6,1:2) = 0;
some = height(uu,vv);
some(mask==0) = NaN;
fu = linspace(0.03, 6.97, 36);
fv = linspace(-0.99, 1.99, 41);
[fuu, fvv] = ndgrid(fu, fv);
[~, iu] = max(bsxfun(@lt, fuu(:), u'), [], 2);
[~, iv] = max(bsxfun(@lt, fvv(:), v), [], 2);
m = @(i, j) mask(sub2ind(size(mask), i, j));
inside = reshape(m(iu-1,iv-1) & m(iu,iv-1) & m(iu-1,iv) & m(iu,iv), size(fuu));
for s = {make_2dspline(u, v, 3*vv+0.2*uu, height(uu,vv), mask, 0), make_2dspline(u, v, [], 3*vv+0.2*uu, some, [], 0)}
   [~, ~, y, z] = eval_2dspline(s{1}, fu, fv);
   check(isequal(~isnan(z), inside) && isequal(~isnan(y), inside), 'the surface ends where points are missing');
   check_near(z(inside), height(fuu(inside), fvv(inside)), 1e-11, 'its points');
   [~, ~, dz] = eval_2dspline_deriv(s{1}, fu, fv, 2);
   check(isequal(~isnan(dz), inside), 'its derivatives');
   check_near(dz(inside), fuu(inside).^2 + 3*fvv(inside).^2, 1e-10, 'and their values');
end
place = eval_2dspline(s{1}, [1 1 5], [], 3*[0.5 1.5 1.5]+0.2*[1 1 5]);
check_near(place([1 3]), [0.5 1.5], 1e-9, 'v of given y');
check(isnan(place(2)), 'no v where points are missing');
t = make_2dspline((0:5)', v, ones(6,1)*v, 2*(0:5)'*ones(1,9) + ones(6,1)*v.^3, mask);
[~, ~, ~, z] = eval_2dspline(t, [0.5 3.5 4.7], [0.5 1.5 0.1]);
check_near(z, 2*[0.5 3.5 4.7] + [0.5 1.5 0.1].^3, 1e-11, 'control points go on in a line');
mask(4,5) = 0;
check_error(@() make_2dspline(u, v, vv, vv, mask), 'point 5 is missing alone');
for i = 1 : 5
   write_simpack(sprintf('slice%d.prr', i), '', (-10:10)', (-10:10)'.^2/600 + i^2);
end
f = fopen('five.slcs', 'w');
fprintf(f, '0 1\n5\n0 0 0\n1\n');
fprintf(f, '%d ''slice%d.prr''\n', [100*(1:5); 1:5]);
fclose(f);
[~, ~, y, z] = eval_2dspline(read_slices('five.slcs', 0, -1), 250, [0 0.25 0.5]);
% chords of 1 mm along the slices
check_near([y; z - 2.5^2], [-10 -5 0; [100 25 0]/600], 1e-3, 'a section between slices that are read');
