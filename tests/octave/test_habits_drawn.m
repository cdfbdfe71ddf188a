% Plots by the options and helper functions of other scripts

folder = fullfile(getenv('CONTACT_SOURCE'), 'examples', 'profiles');
run_example('manchester', 'profiles/60E1.prr', 'profiles/S1002.prw');
prr = read_profile(fullfile(folder, '60E1.prr'));
prw = read_profile(fullfile(folder, 'S1002.prw'));
s = loadcase('manchester', 1);

opt = plot3d;
opt.rw_surfc = 'both';
opt.typplot  = 'rw_rear';
opt.field    = 'pn';
figure(1);
check(isempty(warnings_of(@() plot3d(s, opt, prr, prw))), 'rw_surfc is an option');
check(numel(get(gca, 'children')) > 2, 'rail, wheel and bars are drawn');

opt = plot3d;
opt.view  = 'rdyn';
opt.field = 'pn';
figure(2);   clf;   plot3d(s, opt);
[az, el] = view();
check(mod(az,360)==180 && el==90, 'view = rdyn');
aspect = get(gca, 'dataaspectratio');
check_near(aspect(2)/aspect(1), 1, 1e-12, 'from above to scale');
opt.view = 'default';
plot3d(s, opt);
aspect = get(gca, 'dataaspectratio');
check_near(aspect(2)/aspect(1), 1, 1e-12, 'heights stand on a plane to scale');

s.twice = 2*s.pn;
opt.field = 'twice';
opt.view  = [0 90];
plot3d(s, opt);
colours = findobj(gca, 'type','surface');
c = get(colours(1), 'cdata');
check_near(max(c(:)), 2*max(s.pn(:)), 1e-9*max(s.pn(:)), 'any field of the struct');

still = s;
still.px(:) = 0;
still.py(:) = 0;
opt = plot3d;
opt.field = 'ptabs+vec';
figure(3);   plot3d(still, opt);
h = findobj(gca, 'type','surface');
c = get(h(end), 'cdata');
check(max(c(:))==0, 'arrows of length zero');
opt.rw_surfc = 'prr';
plot3d(still, opt, prr);
check(~isempty(findobj(gca, 'type','surface')), 'and on a rail');

figure(4);   clf;
h = plot_arrow([1 2], [4 0], 2);
check_near(get(h(1), 'xdata'), [1 5], 1e-12, 'shaft of an arrow');
check_near([get(h(2), 'xdata'); get(h(2), 'ydata')], [4 5 4; 2+tan(pi/12) 2 2-tan(pi/12)], 1e-12, 'head of an arrow');
check_near(get(h(1), 'color'), matlab_color(2), 1e-12, 'colour by number');
h = plot_arrow([0 0 0], [0 0 2], 'k', 1, 1);
check_near(get(h(1), 'zdata'), [0 2], 1e-12, 'an arrow in space');
check_error(@() plot_arrow([0 0], [1 1 1]), '2 or 3 numbers');
h = plot_cm([10 5], 2, 6, 90, 'r');
check(numel(h)==7, 'sign of a centre of mass');
check_near([max(get(h(1),'xdata')) max(get(h(1),'ydata'))], [12 7], 1e-3, 'its circle');
check_near([get(h(4),'xdata'); get(h(4),'ydata')], [10 10; 7 13], 1e-9, 'its first arrow');
check(numel(plot_cm([0;0], 1, [], [], [], 1))==3, 'without arrows');

y = (-10:10)';
for i = 1 : 3
   write_simpack(sprintf('slice%d.prr', i), '', y, y.^2/600 + i);
end
f = fopen('habit.slcs', 'w');
fprintf(f, '0 1\n3\n0 0 0\n1\n');
fprintf(f, '%d ''slice%d.prr''\n', [0 1; 100 2; 200 3]');
fclose(f);
slcs = read_profile('habit.slcs', [], 0, -1);
opt = plot_2dspline;
opt.show_slc  = 1:99;
opt.slc_color = (1:6)';
opt.urange    = [0 150];
figure(5);   plot_2dspline(slcs, opt);
h = findobj(gca, 'type','surface');
z = get(h(1), 'zdata');
check_near([min(z(1,:)) min(z(end,:))], [1 2], 1e-3, 'the slices within the range');
x = get(h(1), 'xdata');
check_near([x(1) x(end)], [0 100], 1e-9, 'their positions');
check(numel(findobj(gca, 'type','line', 'linewidth',1.5))==3, 'slices are highlighted');
opt.typplot = 'refl';   opt.refl_avec = [105 30];   opt.refl_dth = 5;
plot_2dspline([], slcs, opt);
h = findobj(gca, 'type','surface');
check(isempty(setdiff(unique(get(h(1), 'cdata')), [0 1])), 'stripes');
check_error(@() plot_2dspline(slcs, struct('typplot','sphere')), 'must be ''surf''');

% rear view of both profiles: track coordinates, as scripts set their axes there
opt = plot3d;
opt.rw_surfc = 'both';
opt.typplot  = 'rw_rear';
opt.field    = 'pn';
figure(6);   plot3d(s, opt, prr, prw);
h = findobj(gca, 'marker','o');
out = parse_out1('manchester');
check_near([get(h(1), 'xdata') get(h(1), 'ydata')], [out.cp_pos.ytr(1) out.cp_pos.ztr(1)], 2e-3, 'the contact is where the .out file has it');
check(strcmp(get(get(gca,'xlabel'),'string'), 'y_{tr} [mm]'), 'its axis');
opt = rmfield(opt, 'rw_surfc');
opt.rw_surf = 'both';
plot3d(s, opt, prr, prw);
h = findobj(gca, 'marker','o');
check_near([get(h(1), 'xdata') get(h(1), 'ydata')], [out.cp_pos.yr(1) out.cp_pos.zr(1)], 2e-3, 'rail coordinates by our name');

% missing parts are omitted
opt = plot3d;
opt.rw_surfc = 'both';
figure(7);
check(~isempty(strfind(warnings_of(@() plot3d(s, opt, prr)), 'left out')), 'no wheel');
check(~isempty(strfind(warnings_of(@() plot3d([], opt)), 'no contact patch')), 'no contact');

% stresses below the surface in rear and side view, in the coordinates of the track, of the rail and of the wheel
lines = strsplit(fileread('manchester.inp'), "\n");
first = find(strncmp(lines, ' 2000. ', 7), 1);
block = {' 1 1', ' 9', ' 5 9 6', ' -1 -0.5 0 0.5 1', ' -4 -3 -2 -1 0 1 2 3 4', ' 0 0.25 0.5 1 2 4', ' 0', ''};
text = strrep(strjoin([lines(1:first), block, {' 0 MODULE', ''}], "\n"), ' 1203100 ', ' 1203103 ');
run_input('below', text, '', 'profiles/60E1.prr', 'profiles/S1002.prw');
b = loadstrs('below', 1);
s = loadcase('below', 1);
out = parse_out1('below');
largest = squeeze(max(b.sigvm, [], 1));
side = squeeze(max(b.sigvm, [], 2));
opt = plot3d;
opt.rw_surfc = 'both';   opt.typplot = 'rw_rear';   opt.field = 'pn';
figure(7);
text = warnings_of(@() plot3d(s, opt, prr, prw, b));
h = findobj(gca, 'type','hggroup');
check(numel(h)==1 && isempty(text), 'contours in the rear view');
check_near(get(h, 'zdata'), largest, 1e-9*max(largest(:)), 'the largest stress along the line of sight');
% five points of the middle column and the depth below them, by the angle that the .out file has
h = [get(h,'xdata')(5,:); get(h,'ydata')(5,:)];
a = out.cp_pos.delt_tr(1);
check_near(h, [out.cp_pos.ytr(1)-sin(a)*b.z'; out.cp_pos.ztr(1)+cos(a)*b.z'], 5e-3, 'their places in track coordinates');
opt.rw_surfc = 'prr';
plot3d(s, opt, prr, prw, b);
h = findobj(gca, 'type','hggroup');
check_near(get(h,'ydata')(:,1), interp1(prr.ProfileY, prr.ProfileZ, get(h,'xdata')(:,1)), 1e-3, 'z = 0 is the surface of the rail');
opt.rw_surfc = 'prw';
plot3d(s, opt, prr, prw, b);
h = findobj(gca, 'type','hggroup');
[y, k] = unique(prw.ProfileY);
check_near(get(h,'ydata')(:,1), interp1(y, prw.ProfileZ(k), get(h,'xdata')(:,1)), 1e-3, 'and that of the wheel');
opt.rw_surfc = 'prr';   opt.typplot = 'rw_side';
plot3d(s, opt, prr, prw, b);
h = findobj(gca, 'type','hggroup');
check_near(get(h, 'zdata'), side, 1e-9*max(side(:)), 'side view');
check_near(get(h, 'xdata')(:,1), out.cp_pos.xtr(1) + b.x, 5e-3, 'its places');
opt.typplot = 'surf';
text = warnings_of(@() plot3d(s, opt, prr, prw, b));
check(~isempty(strfind(text, 'rear and side view only')), 'other views warn that they do not show stresses');
opt.typplot = 'rw_rear';
check_error(@() plot3d(s, opt, prr, prw, [b b]), '2 blocks of stresses are given for 1 patches');
check_error(@() plot3d(s, opt, prr, prw, struct('x',0)), 'a block of loadstrs');

% names, letters, axes, and a struct made by the script
hand = rmfield(s, {'x','y','x_offset','y_offset','kincns'});
opt = plot3d;
opt.field    = 'srel_vec';
opt.eldivcol = ['b';'m';'g'];
opt.ixrange  = 'tight';
opt.view     = [0 90];
hand.kincns  = struct('t_digit',3, 'veloc',1);
figure(8);   subplot(1,2,1);   plot(1:2);   subplot(1,2,2);   plot(1:2);
opt.addplot  = -1;
plot3d(hand, opt);
check(numel(findobj(gcf, 'type','axes'))>=2 && ~isempty(findobj(gca, 'color',[0 0 1])), 'one of two axes is redrawn');
check_near(hand.xl + hand.dx/2, s.x(1), 1e-12, 'the grid of a struct without x');

% letters for yes and no, empty options
opt = plot3d;   opt.field = 'pn';   opt.view = [0 90];   opt.addplot = 2;   opt.colormap = [];
opt.addeldiv = 'yes';
plot3d(hand, opt);
n = numel(findobj(gca, 'type','line'));
opt.addeldiv = 'n';
plot3d(hand, opt);
check(n>0 && isempty(findobj(gca, 'type','line')) && numel(findobj(gcf, 'type','axes'))>=2, 'addeldiv by letters, axes cleared');
opt.view = [];
plot3d(hand, opt);
[az, el] = view();
check(az==-37.5 && el==30, 'an empty view is the default');

% a profile and its wear
worn = prr;
worn.ProfileZ = prr.ProfileZ + 1e-3*(abs(prr.ProfileY)<20);
figure(9);   [most, l, n] = plot_update(prr, worn, 500, 10);
check(most<=1e-3+1e-12 && most>0.99e-3 && numel(l)==3 && ~isempty(n), 'largest difference along the normal');
z = get(l(3), 'ydata');
k = find(abs(prr.ProfileY)==min(abs(prr.ProfileY)), 1);
check_near(z(k) - prr.ProfileZ(k), 0.5, 1e-3, 'magnified');
every = worn;
every.ProfileY = worn.ProfileY(1:2:end);
every.ProfileZ = worn.ProfileZ(1:2:end);
check_near(plot_update(prr, every, 500), most, 1e-5, 'profiles with other points');
before = numel(get(gca, 'children'));
[least, l] = plot_update(prr, worn, [], 0, 0, 1, 0, 1, 1);
check(numel(get(gca, 'children'))>before && least<=most+1e-12, 'show_angl, add_plot, force_spline');
z = get(l(3), 'ydata');
width = max(worn.ProfileY) - min(worn.ProfileY);
check(max(abs(z(:)-prr.ProfileZ))<=0.1*width && max(abs(z(:)-prr.ProfileZ))>0.03*width, 'a suitable magnification');

% a wheel flat: pressures in rail coordinates, with the outline of another case, of which scripts delete the lines of slip
run_example('cattaneo');
slips = loadcase('cattaneo', 2);
slips.x_offset = 1;   slips.y_offset = -1;
opt = plot3d;   opt.field = 'pn';   opt.view = 'rail';   opt.addeldiv = 0;   opt.addplot = 1;   opt.zrange = [0 2500];
opt.ixrange = 'all';   opt.iyrange = 'all';
figure(10);   clf;
plot3d(slips, opt);
opt.field = 'eldiv_contour';
plot3d(slips, opt);
c = get(gca, 'children');
check(numel(c)==5 && isequal(get(c(1),'color'), opt.eldivcol(1,:)) && isequal(get(c(3),'color'), opt.eldivcol(2,:)), ...
      'two lines each around contact and slip, the last ones around contact');
delete(c(3:4));
check(numel(get(gca, 'children'))==3 && ~isempty(findobj(gca, 'type','surface')), 'lines of slip deleted');
% earlier plots stay visible: another case, all patches of one
half = slips.dx/2;
ends = [slips.x(1)-half slips.x(end)+half slips.y(1)-half slips.y(end)+half];   % without offsets
other = slips;   other.x_offset = 6;
plot3d(other, opt);
check_near(axis(), ends + [1 6 -1 -1], 1e-9, 'addplot widens the axes');
figure(10);   clf;
opt = plot3d;   opt.field = 'eldiv_contour';   opt.ixrange = 'all';   opt.iyrange = 'all';
plot3d([slips other], opt);
check_near(axis(), ends + [1 6 -1 -1], 1e-9, 'all patches are in sight');
bbox = cntc_boundbox(slips);
check_near(bbox, [min(slips.x(any(slips.eldiv>0,1)))-slips.dx/2, max(slips.x(any(slips.eldiv>0,1)))+slips.dx/2, ...
                  min(slips.y(any(slips.eldiv>0,2)))-slips.dy/2, max(slips.y(any(slips.eldiv>0,2)))+slips.dy/2], 1e-12, 'rectangle');
check_near(cntc_boundbox(slips, [-9 0 0 8]), [-9 bbox(2) bbox(3) 8], 1e-12, 'made larger');

% arrows along circles, axes
figure(11);   clf;
h = circ_arrow([1;2], 3, 0, 90, 5, 0.7, 0.8);
x = get(h(1), 'xdata');   y = get(h(1), 'ydata');
check_near([x(1) y(1) x(end) y(end)], [4 2 1 5], 1e-12, 'tail and tip');
check_near(hypot(x-1, y-2), 3+0*x, 1e-12, 'a circle between them');
x = get(h(2), 'xdata');   y = get(h(2), 'ydata');
check_near([x(2) y(2)], [1 5], 1e-12, 'the head is at the tip');
check(numel(x)==3 && min(x([1 3]))>1, 'and points along the circle');
h = circ_arrow([0 0], -1, 0, 90);
y = get(h(1), 'ydata');
check_near(y(end), -1, 1e-12, 'a negative radius: the other way round');
h = circ_arrow([0 0 5], [1 2], 0, 90, 'k', 1, 1, [0 0 1; 1 0 0; 0 1 0]);
check_near([get(h(1),'xdata')(end) get(h(1),'ydata')(end) get(h(1),'zdata')(end)], [0 0 7], 1e-12, 'an ellipse in another plane');
h = plot_axes([0,0], 150, -90, 1, ['$z_{tr}$';'$x_{tr}$';'        '], 'k', [], [], [], [], 0, 1.2);
set(h([1,2,4,5,7,8,11:14]), 'linewidth',1);
check_near([get(h(1),'ydata')(2) get(h(4),'xdata')(2)], [-150 150], 1e-10, 'z points down, x to the right');
check(strcmp(get(h(3),'string'), '$z_{tr}$') && strcmp(get(h(6),'string'), '$x_{tr}$'), 'names');
h = plot_axes([0 0], 1, 0, -1, 'yzx', 2, 8, [], 10, [], [], [], 1);
check_near(get(h(4),'ydata')(2), -1, 1e-12, 'seen from behind');
check(numel(h)==10 && isequal(get(h(6),'string'), 'z'), 'without the sense of rotation');
set(gca, 'ydir','reverse');
h = plot_axes([0 0], 1, 0, -1);
check_near(get(h(4),'ydata')(2), 1, 1e-12, 'in a reversed picture');
h = plot_axes3([1 2 3], 2, [90 0 0], 'xyz', 'b');
check_near([get(h(4),'xdata')(2) get(h(4),'ydata')(2) get(h(4),'zdata')(2)], [1 2 5], 1e-12, 'roll turns y into z');
h = plot_axes3([0 0 0], 1, [0 0 1; 1 0 0; 0 1 0], {'a','b','c'}, 1, [], [], [], [], [], 0, 0);
check_near([get(h(7),'xdata')(2) get(h(7),'ydata')(2) get(h(7),'zdata')(2)], [1 0 0], 1e-12, 'a matrix');
check(strcmp(get(h(9),'string'), 'c') && numel(h)==10, 'its names');
