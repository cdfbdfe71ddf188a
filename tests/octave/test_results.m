% Results of the program, and published ones, loaded by the scripts

% --- module 3: Cattaneo's problem, elements in contact only
run_example('cattaneo');
s = loadcase('cattaneo', 2);
check(isequal([s.mx s.my], [19 19]) && s.kincns.t_digit==1 && s.config==0, 'grid and kinematics of cattaneo');
check_near([s.xl s.dx s.dy], [-1.26667 0.13333 0.13333], 1e-9, 'position of the grid');
check_near([s.x(1) s.x(end) s.y(10)], -1.26667+[0.5 18.5 9.5]*0.13333, 1e-9, 'centres of elements');
check_near([s.fric.fstat s.fric.fkin s.mater.gg s.mater.poiss], [0.4 0.4 200 200 0.42 0.42], 1e-9, 'friction and materials');
area = s.dx*s.dy;
out = parse_out3('cattaneo');
check_near(sum(s.pn(:))*area, out.force.fn(2), 1e-3*9.2, 'sum of pressures');
check_near(sum(s.px(:))*area, out.force.fx_true(2), 2e-3*3.2, 'sum of tractions');
check_near(out.force.fx_true(2)/(0.4*out.force.fn(2)), -7/8, 1e-3, 'tangential force of the input');
check_near(max(s.pn(:)), out.force.pmax(2), 1e-3, 'largest pressure');
check(sum(s.eldiv(:)>0)==out.stat.ncon(2) && sum(s.eldiv(:)==1)==out.stat.nadh(2), 'numbers of elements');
check(all(s.pn(s.eldiv==0)==0) && all(s.trcbnd(s.eldiv==0)==0), 'no traction out of contact');
check(all(isnan(s.h(s.eldiv==0))), 'values that are not in the file are unknown');
slip = (s.eldiv==2);
check_near(hypot(s.px(slip),s.py(slip)), s.trcbnd(slip), 1e-4, 'traction at the bound where it slips');
check_near(s.h(10,10:12), 0.01*s.x(10:12).^2 + 0.01*s.y(10)^2, 1e-8, 'undeformed distance is a parabola');

% --- status of the case, for our scripts; other readers skip that line
check(strcmp(s.meta.status,'solved') && isempty(s.meta.reason), 'the case is solved');
plain = load('-ascii', 'cattaneo.0002.mat');
check(size(plain,2)==11 && isequal(plain(1,end),2410), 'the file loads as a table');
text = regexprep(fileread('cattaneo.0002.mat'), 'STATUS: solved', 'STATUS: not converged (outer): residual 9.0E-02');
f = fopen('cattaneo.0099.mat', 'w');   fwrite(f, text);   fclose(f);
t = loadcase('cattaneo', 99);
check(strcmp(t.meta.status,'not converged') && strcmp(t.meta.reason,'outer: residual 9.0E-02'), 'a case that did not converge');
f = fopen('cattaneo.0099.mat', 'w');   fwrite(f, strrep(text, 'STATUS', 'other'));   fclose(f);
t = loadcase('cattaneo', 99);
check(isempty(t.meta.status), 'a file of another program');
delete('cattaneo.0099.mat');

% --- differences
d = diffcase(s, loadcase('cattaneo', 2));
check(all(d.px(:)==0) && isequal(d.eldiv,s.eldiv), 'a case does not differ from itself');
t = s;
t.px = s.px + 1;
d = diffcase(t, s);
check_near(d.px, ones(19), 1e-12, 'difference of tractions');
check_error(@() diffcase(s, rmfield(setfield(s,'mx',18),'h')), 'different sizes');
for name = {'xl','yl','dx','dy'}
   % grids differ if a position differs by more than a thousandth of an element
   for part = [ 3e-2 1e-5 ]
      t = s;
      t.(name{1}) = s.(name{1}) + part*s.dx/(1 + 18*(name{1}(1)=='d'));
      check(~isempty(strfind(warnings_of(@() diffcase(s, t)), 'different positions'))==(part>1e-3), ['grids that differ in ' name{1}]);
   end
end
check_error(@() loadcase('cattaneo', 7), 'there are no results of case 7');
check_error(@() loadcase('nosuch'), 'there are no results');

% --- temperatures, all elements, rolling
run_example('sliding_temperature');
s = loadcase('sliding_temperature');
check(isfield(s,'temp1') && s.h_digit==3 && s.kincns.t_digit>=2, 'temperatures are loaded');
out = parse_out3('sliding_temperature.out');
check_near(max(max(s.temp1(:)),max(s.temp2(:))), out.force.temp(1), 0.1, 'largest temperature');
check_near(s.shft, s.srel*s.kincns.dq, 1e-15, 'slip distance');

% --- wheel on rail: patches, left and right
run_example('wheel_on_rail', 'profiles/60E1.prr', 'profiles/S1002.prw');
out = parse_out1('wheel_on_rail');
check(isequal(size(out.npatch),[1 10]) && isequal(out.config,[1 1 1 1 1 0 0 0 0 0]), 'cases and sides');
for icase = [2 9]
   s = loadcase('wheel_on_rail', icase);
   check(numel(s)==out.npatch(icase) && s(1).meta.npatch==numel(s), 'all patches are loaded');
   fn = sum(s(1).pn(:)) * s(1).dx*s(1).dy;
   check_near(fn, out.cp_force.fn(1,icase), 2e-3*fn, 'normal force of a patch');
   check_near([s(1).meta.ycp_r s(1).meta.zcp_r], [out.cp_pos.ycp_r(1,icase) out.cp_pos.zcp_r(1,icase)], 1e-3, 'contact reference');
   check_near(s(1).meta.deltcp_r+s(1).meta.roll_r, out.cp_pos.delttr(1,icase), 2e-4, 'contact angle');
end
check_near(out.tot_forc.fz_tr, 60000*ones(1,10), 60, 'vertical forces');
check_near(out.ws_pos.y(2:3), [1.5 3.0], 1e-9, 'lateral positions');
% the contact reference in the coordinates of the elements, of a left wheel: the established program does not mirror it
lines = strsplit(fileread('wheel_on_rail.0007a.mat'), "\n");
places = sscanf(lines{6}, '%f');
lines{6} = sprintf(' %.6g', [places(1:9); -2; 3]);
f = fopen('steps.0001a.mat', 'w');   fprintf(f, "%s\n", lines{:});   fclose(f);
s1 = loadcase('steps');
check(s1.config==0 && isequal([s1.meta.spinxo s1.meta.spinyo], [-2 3]), 'contact reference of a left wheel');
f = fopen('steps.0001a.mat', 'w');   fprintf(f, "%s\n", strrep(lines{1}, 'STATUS', 'other'), lines{2:end});   fclose(f);
s1 = loadcase('steps');
check(isequal([s1.meta.spinxo s1.meta.spinyo], [-2 -3]), 'of the established program');
[s1, s2] = loadcase('wheel_on_rail', 2, -1);
check(isequal(s1.pn, loadcase('wheel_on_rail', 2, 1).pn) && isempty(s2), 'patches in separate structs');
check(numel(parse_out3('wheel_on_rail').force.fn)==10 && all(isnan(parse_out3('wheel_on_rail').force.fn)), ...
      'parse_out3 leaves module 1 cases alone');
check(all(isnan(parse_out1('cattaneo').config)), 'parse_out1 ignores cases of module 3');

% --- stresses below the surface
run_example('subsurface');
b = loadstrs('subsurface', 1);
check(b.npoints==b.nx*b.ny*b.nz && isequal(size(b.sigvm),[b.nx b.ny b.nz]), 'shape of a block');
check(all(diff(b.x)>0) && all(diff(b.z)>0), 'coordinates increase');
out = parse_out3('subsurface');
plain = parse_out3('cattaneo');
check(~isfield(plain,'subs') || isempty(plain.subs), 'no stresses below the surface where none were computed');
check_near(max(b.sigvm(:)), out.subs.sigvm.val(1,1,1), 0.6e-3*max(b.sigvm(:)), 'largest von Mises stress');
if (isfield(b,'sigxx'))
   mises = sqrt(((b.sigma1-b.sigma2).^2+(b.sigma2-b.sigma3).^2+(b.sigma3-b.sigma1).^2)/2);
   check_near(mises(:), b.sigvm(:), 1e-3*max(b.sigvm(:)), 'von Mises stress of the principal stresses');
end
check_error(@() loadstrs('subsurface', 77), 'there are no results of case 77');

% --- old and damaged files
copyfile('cattaneo.0002.mat', 'old.0001.mat');
txt = fileread('old.0001.mat');
f = fopen('new.0001.mat', 'w');   fwrite(f, strrep(txt,'2410','2411'));   fclose(f);
check_error(@() loadcase('new'), 'knows formats up to 2410');
f = fopen('old.0001.mat', 'w');   fwrite(f, strrep(txt,'2410','1801'));   fclose(f);
check_error(@() loadcase('old'), 'older than 2320');
lines = strsplit(txt, "\n");
f = fopen('cut.0001.mat', 'w');   fprintf(f, "%s\n", lines{1:6});   fclose(f);
check_error(@() loadcase('cut'), 'ends before the table');
f = fopen('bad.0001.mat', 'w');   fprintf(f, "%s\n", lines{1:20});   fprintf(f, "1 2 3\n");   fclose(f);
check_error(@() loadcase('bad'), 'does not have 11 numbers');

% --- published results
reference = fullfile(getenv('CONTACT_REFERENCE'), 'examples');
if (exist(fullfile(reference,'subsurf.ref_subs'),'file')==2)
   sol = parse_out3(fullfile(reference,'tractcurv.ref_out'));
   check(numel(sol.icase)==120, 'cases of tractcurv');
   check_near(sol.creep.cksi([1 2]), [1e-5 4e-4], 1e-9, 'creepages of tractcurv');
   check_near([sol.force.fx(1) sol.force.fx_true(1) sol.force.fn(1)], [-7.015e-3 -247 106700], 1e-9, 'forces of tractcurv');
   check_near([sol.stat.npot(1) sol.stat.ncon(1) sol.stat.nadh(1)], [2112 1384 1382], 0, 'elements of tractcurv');
   sol = parse_out1(fullfile(reference,'mbench_a22_left.ref_out'));
   check(numel(sol.icase)==21 && all(sol.config==0), 'cases of the Manchester benchmark');
   check_near([sol.tot_forc.fy_tr(1) sol.cp_pos.ycp_r(1,1) sol.cp_pos.delttr(1,1)], [-36.24 8.66 0.0290], 1e-9, 'first case');
   check_near([sol.cp_force.fs(1,1) sol.cp_force.mn(1,1) sol.cp_creep.pen(1,1)], [253.6 4605 1.596e-2], 1e-9, 'its patch');
   copyfile(fullfile(reference,'subsurf.ref_subs'), 'subsurf.0001.subs');
   [b1, b2] = loadstrs('subsurf', 1);
   check(b1.nz==15 && isequal([b2.nx b2.ny b2.nz],[21 21 15]), 'blocks of subsurf');
   check_near(squeeze(b1.sigvm(1,1,1:2)), [1.74426; 1.34868], 1e-9, 'von Mises stress of subsurf');
   mises = sqrt(((b2.sigma1-b2.sigma2).^2+(b2.sigma2-b2.sigma3).^2+(b2.sigma3-b2.sigma1).^2)/2);
   check_near(mises(:), b2.sigvm(:), 2e-5, 'principal stresses of subsurf');
   d = diffstrs(b2, b2);
   check(all(d.sigvm(:)==0) && all(d.uz(:)==0), 'a block does not differ from itself');
   check_error(@() diffstrs(b1, b2), 'points');
   check(isempty(nthargout(3, @loadstrs, 'subsurf', 1)), 'a missing block is empty');
   files = [glob(fullfile(reference,'*.ref_out')); glob(fullfile(reference,'..','testbank','*','*.ref_out'))];
   check(numel(files)>=40, 'published outputs');
   for i = 1 : numel(files)
      s3  = parse_out3(files{i});
      s1  = parse_out1(files{i});
      txt = fileread(files{i});
      ncase = numel(regexp(txt, '\n Case +\d'));
      check(numel(s1.icase)==ncase && numel(s3.icase)==ncase, ['cases of ' files{i}]);
      npatch = numel(regexp(txt, 'DATA FOR CONTACT PATCH'));
      check(sum(s1.npatch)==npatch && sum(~isnan(s1.cp_force.fn(:)))==npatch && sum(~isnan(s1.cp_pos.ycp_r(:)))==npatch, ...
            ['patches of ' files{i}]);
      check(sum(~isnan(s3.force.fn))+npatch==numel(strfind(txt,'ELAST.EN.')), ['results of ' files{i}]);
      check(isequal(isnan(s1.config), isnan(s1.tot_forc.fx_tr)), ['total forces of ' files{i}]);
   end
else
   disp('published results are not available; not compared');
end
