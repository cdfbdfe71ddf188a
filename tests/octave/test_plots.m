% Each kind of plot is drawn to a PNG file without a screen; its contents are checked by the graphics objects

1;
function snap( name )
% Print the figure; the picture must have colours besides white
   file = [name '.png'];
   print(file, '-dpng', '-r40');
   im = imread(file);
   check(numel(unique(im))>20 && mean(im(:)<250)>0.005, ['picture ' name ' is not empty']);
end
function [ n ] = count( type )
   n = numel(findobj(gca, 'type', type));
end
function [ h ] = colors_shown()
   h = findobj(gcf, 'type', 'surface');
   h = h(1);
end

run_example('wheel_on_rail', 'profiles/60E1.prr', 'profiles/S1002.prw');
run_example('cattaneo');
run_example('carter2d');
run_example('sliding_temperature');
run_example('subsurface');
set(0, 'defaultfigurevisible', 'off');
prr = read_profile('profiles/60E1.prr');
prw = read_profile('profiles/S1002.prw');

% --- plot2d
s = loadcase('cattaneo', 2);
opt = plot2d;
check(opt.orie==2 && strcmp(opt.pxory,'x') && opt.negpn==1 && opt.facpt==1 && isempty(opt.plim), 'defaults of plot2d');
opt.facpt = -1;
clf;   plot2d(s, opt);
lines = get(findobj(gca,'type','line'), 'ydata');
check(numel(lines)==2 && isequal(lines{1}(:), -s.px(10,:)') && isequal(lines{2}(:), s.trcbnd(10,:)'), 'lines of plot2d');
snap('plot2d_row');
opt.orie = 1;   opt.pxory = 'y';   opt.negpn = 0;   opt.xslc = [-0.5 0.5];
clf;   plot2d(s, opt);
check(count('line')==6, 'two columns with both bounds');
snap('plot2d_columns');
check_error(@() plot2d(s, struct('yslc',[])), 'must be one position at least');
check(~isempty(findobj(gcf, 'tag','legend')), 'a legend of the columns');
plot2d(s, setfield(opt,'xslc',0));
check(isempty(findobj(gcf, 'tag','legend')), 'which the next plot does not have');
check_error(@() plot2d(s, setfield(opt,'orie',3)), 'orie');
check_error(@() plot2d([s s]), 'one contact patch');

% --- plot3d, flat: all fields
opt = plot3d;
check(strcmp(opt.field,'default') && isnan(opt.exterval) && strcmp(opt.rw_surf,'none') && opt.numvecx==15, 'defaults of plot3d');
w = loadcase('wheel_on_rail', 4);
for name = {'eldiv','eldiv_spy','eldiv_contour','h','mu','pn','px','py','ptabs','ptarg','ptvec','ptabs+vec','un','ux', ...
            'uy','utabs+vec','sx','sy','shft','shft+vec','srel','srel+vec','sabs','sabs+vec','fricdens','default'}
   opt.field = name{1};
   plot3d(w, opt);
   check(~isempty(get(get(gca,'title'),'string')), ['title of ' name{1}]);
   switch (name{1})
      case {'pn','px','py'}
         c = get(colors_shown(), 'cdata');
         check_near(max(c(:)), max(max(w.(name{1})(w.eldiv>0))), 1e-12, ['values of ' name{1}]);
      case {'ptabs+vec','default'}
         c = get(colors_shown(), 'cdata');
         check_near(max(c(:)), max(hypot(w.px(:),w.py(:))), 1e-12, 'magnitude of tractions');
         check(count('hggroup')>=1, 'arrows');
      case 'srel'
         c = get(colors_shown(), 'cdata');
         check_near(max(c(:)), max(w.srel(:)), 1e-15, 'slip velocity');
      case 'sabs'
         c = get(colors_shown(), 'cdata');
         check_near(max(c(:)), max(w.srel(:))*w.kincns.veloc, 1e-9, 'slip in mm/s');
      case 'fricdens'
         c = get(colors_shown(), 'cdata');
         power = w.srel .* hypot(w.px,w.py) * w.kincns.veloc;
         check_near(1000*max(c(:)), max(power(:)), 1e-9*max(power(:)), 'power density, W = N mm/s / 1000');
   end
   if (any(strcmp(name{1}, {'eldiv','eldiv_spy','eldiv_contour','pn','ptvec','ptabs+vec','srel+vec'})))
      snap(['plot3d_' strrep(name{1},'+','_')]);
   end
end
opt.field = 'fricdens';
plot3d(s, opt);
c = get(colors_shown(), 'cdata');
work = s.shft .* hypot(s.px,s.py);
check_near(1000*max(c(:)), max(work(:)), 1e-9*max(work(:)), 'work density of a shift, J = N mm / 1000');
t = loadcase('sliding_temperature');
opt.field = 'temp1';
plot3d(t, opt);
opt.exterval = [];   opt.ixrange = 'all';   opt.iyrange = 'all';   opt.view = [0 90];
plot3d(t, opt);
c = get(colors_shown(), 'cdata');
check_near(c(1:t.my,1:t.mx), t.temp1, 0, 'temperatures out of contact as stored');
snap('plot3d_temp');
opt = plot3d;   opt.field = 'px';
plot3d(loadcase('carter2d'), opt);
snap('plot3d_one_row');
opt.field = 'pn';   opt.typplot = 'contourf';   opt.view = 'rail';
plot3d(w, opt);
snap('plot3d_contourf');
% a constant field, and one without values
even = loadcase('cattaneo', 2);
even.mu(:) = 0.25;
opt.field = 'mu';   opt.exterval = [];
plot3d(even, opt);
c = get(colors_shown(), 'cdata');
check(all(c(:)==0.25), 'contourf of a constant field');
opt.exterval = NaN;   even.eldiv(:) = 0;
plot3d(even, opt);
check(isempty(findobj(gca,'type','hggroup')), 'contourf without a value');
opt = plot3d;   opt.field = 'pn';   opt.colormap = 'none';   opt.zrange = [0 2000];
plot3d(w, opt);
check_near(zlim(), [0 2000], 0, 'zrange');
snap('plot3d_black');
opt = plot3d;   opt.exterval = 0;   opt.ixrange = [3 12];   opt.iyrange = [2 30];   opt.field = 'pn';   opt.view = [0 90];
opt.addeldiv = 1;   opt.xstretch = 2;
plot3d(w, opt);
c = get(colors_shown(), 'cdata');
check(isequal(size(c), [30 11]) && ~any(isnan(c(:))), 'ranges of elements, value outside');
aspect = get(gca, 'dataaspectratio');
check_near(aspect(2)/aspect(1), 2, 1e-12, 'xstretch');
subplot(1,2,1);
opt = plot3d;   opt.addplot = 1;   opt.field = 'pn';
plot3d(w, opt);
check(numel(findobj(gcf,'type','axes'))>=2 || numel(findall(gcf,'type','axes'))>=1, 'addplot draws into the current axes');
clf
check_error(@() plot3d(w, setfield(plot3d,'field','nosuch')), 'there is no field');
check_error(@() plot3d(w, setfield(plot3d,'typplot','nosuch')), 'typplot');
check_error(@() plot3d(w, setfield(plot3d,'field','taucrt')), 'has no field');
check_error(@() plot3d(s, setfield(plot3d,'field','srel')), 'use ''shft'' in shifts');
check_error(@() plot3d(w, setfield(plot3d,'typplot','rw_rear')), 'needs rw_surf');
check_error(@() plot3d(w, setfield(plot3d,'rw_surf','prr')), 'needs the rail profile');
text = warnings_of(@() plot3d(w, setfield(plot3d,'external',NaN)));
check(~isempty(strfind(text,'there is no option "external"')), 'an unknown option is reported');

% --- on the surfaces of rail and wheel, both sides
opt = plot3d;   opt.field = 'pn';   opt.rw_surf = 'prr';
for icase = [4 9]
   w = loadcase('wheel_on_rail', icase);
   plot3d(w, opt, prr);
   % the patch is the surface with the colours; its points must be on the profile
   h = colors_shown();
   side = 1 - 2*(w.config==0);
   on_rail = interp1(side*prr.ProfileY, prr.ProfileZ, get(h,'ydata')(:));
   use = abs(get(h,'ydata')(:))<30;
   check_near(get(h,'zdata')(:)(use), on_rail(use), 5e-3, 'the patch lies on the rail');
   snap(sprintf('plot3d_rail_%d', icase));
end
opt.rw_surf = 'prw';   opt.field = 'ptabs+vec';   opt.addeldiv = 1;
plot3d(w, opt, prr, 'profiles/S1002.prw');
snap('plot3d_wheel');
opt.rw_surf = 'both';   opt.xysteps = [5 4];   opt.view = 'rail';   opt.xrange = [-20 20];
plot3d(w, opt, prr, prw);
check_near(xlim(), [-20 20], 0, 'xrange');
snap('plot3d_both');

% --- equal slices give the rail itself
if (exist('slices','dir')~=7)
   mkdir('slices');
end
f = fopen('same.slcs', 'w');
fprintf(f, "0 1\n5\n0 0 0\n1\n");
for i = 1 : 5
   write_simpack(prr, sprintf('slices/%d.prr', i));
   fprintf(f, "%d 'slices/%d.prr'\n", 20*i-60, i);
end
fclose(f);
opt = plot3d;   opt.field = 'pn';   opt.rw_surf = 'prr';
plot3d(w, opt, prr);
z = get(colors_shown(), 'zdata');
plot3d(w, opt, 'same.slcs');
check_near(get(colors_shown(),'zdata'), z, 5e-3, 'contact on slices');
snap('plot3d_slices');

% --- rear and side view
opt = plot3d;   opt.field = 'pn';   opt.rw_surf = 'both';   opt.vecscale = 10/2000;
for kind = {'rw_rear','rw_side'}
   opt.typplot = kind{1};
   plot3d(w, opt, prr, prw);
   check(count('line')==5, 'rail, wheel, bars, their envelope and the contact reference');
   snap(['plot3d_' kind{1}]);
end
opt.rw_surf = 'prw';   opt.typplot = 'rw_rear';
plot3d(w, opt, [], prw);
snap('plot3d_rear_wheel');
% wheel and rail of the rear view overlap at the contact by the approach, and nowhere else
opt.rw_surf = 'both';
plot3d(w, opt, prr, prw);
lines = findobj(gca, 'type','line');
rail = lines(end);   wheel = lines(end-1);
y = linspace(w.meta.ycp_r-4, w.meta.ycp_r+4, 81);
[yr, k] = unique(get(rail,'ydata')(:)*0 + get(rail,'xdata')(:));
zr = interp1(yr, get(rail,'ydata')(:)(k), y);
yw = get(wheel,'xdata')(:);   zw = get(wheel,'ydata')(:);
near = abs(yw-w.meta.ycp_r)<15;
[yw, k] = unique(yw(near));   zw = zw(near)(k);
overlap = interp1(yw, zw, y) - zr;
pen = parse_out1('wheel_on_rail').cp_creep.pen(1,9);
check(max(overlap)>0.3*pen && max(overlap)<2.5*pen, 'wheel and rail overlap by the approach in the rear view');

% --- positions and directions: tractions on the rows as drawn add up to the total forces of the program. In a conformal
%     contact the reference surface is between rail and wheel and not on the rail, hence one percent
text = fileread('wheel_on_rail.inp');
f = fopen('curved.inp', 'w');
fwrite(f, regexprep(text, '\n 0022033 ', "\n 0042033 "));
fclose(f);
[status, output] = system(sprintf('"%s" --quiet 2 curved 2>&1', getenv('CONTACT_PROGRAM')));
check(status==0, ['the program ran with D = 4: ' output]);
tolerance = [1e-3 1.2e-2];
names = {'wheel_on_rail', 'curved'};
opt = plot3d;
opt.typplot = 'rw_rear';   opt.rw_surf = 'prr';   opt.field = 'pn';   opt.vecscale = 0.01;
opt.iyrange = 'all';       opt.numvecy = 1e4;
for k = 1 : 2
   out = parse_out1(names{k});
   for icase = [4 5 9]
      s = loadcase(names{k}, icase);
      check(numel(s)==1, 'one patch');
      plot3d(s, opt, prr);
      lines = findobj(gca, 'type','line');
      bars = lines(2);
      y = get(bars,'xdata');   z = get(bars,'ydata');
      d = [y(2:3:end)-y(1:3:end); z(2:3:end)-z(1:3:end)];
      r = s.meta.roll_r;
      n = [cos(r) -sin(r); sin(r) cos(r)] * (d ./ hypot(d(1,:),d(2,:)));
      loaded = any(s.pn>0, 2)';
      pn = sum(s.pn(loaded,:),2) * s.dx*s.dy;
      ps = sum(s.py(loaded,:),2) * s.dx*s.dy;
      n  = n(:,loaded);
      force = n*pn + [n(2,:); -n(1,:)]*ps;
      check_near(force', [out.tot_forc.fy_tr(icase) out.tot_forc.fz_tr(icase)], tolerance(k)*60000, ...
                 sprintf('forces of %s, case %d', names{k}, icase));
   end
end

% --- plotstrs
b = loadstrs('subsurface', 1);
opt = plotstrs;
check(strcmp(opt.field,'mises') && strcmp(opt.dir,'y') && strcmp(opt.typplot,'contourf'), 'defaults of plotstrs');
plotstrs(b);
snap('plotstrs_contourf');
opt.typplot = 'contour';   opt.cntrlvl = [200 400 600];   opt.clabel = 'on';
plotstrs(b, opt);
snap('plotstrs_contour');
opt.typplot = 'contourf';   opt.cntrlvl = [1e5 2e5];
plotstrs(b, opt);
check(~isempty(findobj(gca,'type','surface')), 'contours above all values');
opt = plotstrs;   opt.typplot = 'surf';   opt.dir = 'z';   opt.zslc = 1;
for name = {'ux','uy','uz','hydro','tresca','sigma1','sigma2','sigma3','sigxx','sigxy','sigxz','sigyy','sigyz','sigzz'}
   opt.field = name{1};
   plotstrs(b, opt);
end
[~, k] = min(abs(b.z-1));
check_near(get(colors_shown(),'cdata'), b.sigzz(:,:,k)', 1e-12, 'slice of constant depth');
snap('plotstrs_surf');
opt.dir = 'x';   opt.scale = 'log';   opt.field = 'mises';
plotstrs(b, opt);
snap('plotstrs_log');
check_error(@() plotstrs(b, setfield(opt,'dir','w')), 'option dir');
check_error(@() plotstrs(b, setfield(opt,'field','nosuch')), 'there is no field');
[~, axis_points] = loadstrs('subsurface', 1);
check_error(@() plotstrs(axis_points), 'at least 2 x 2');
