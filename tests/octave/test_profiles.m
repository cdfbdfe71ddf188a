% Profiles: the scripts read the same profiles as the program
1;

function put( name, lines )
   f = fopen(name, 'w');
   fprintf(f, "%s\n", lines{:});
   fclose(f);
end

function mkdir_if( name )
   if (exist(name,'dir')~=7)
      mkdir(name);
   end
end

function [ z, slope ] = at( p, side, y )
% Height and slope on the running surface
   use = (p.ProfileZ < 12);
   yy = side*p.ProfileY(use);
   zz = p.ProfileZ(use);
   [yy, k] = unique(yy);
   z = interp1(yy, zz(k), y);
   slope = (interp1(yy, zz(k), y+0.05) - interp1(yy, zz(k), y-0.05)) / 0.1;
end

function [ q ] = with_warning_off( fun )
   old = warning('off', 'all');
   q = fun();
   warning(old);
end

run_example('wheel_on_rail', 'profiles/60E1.prr', 'profiles/S1002.prw');
out   = parse_out1('wheel_on_rail');
rail  = read_profile('profiles/60E1.prr');
wheel = read_profile('profiles/S1002.prw');
check(all(diff(rail.ProfileY)>0 | diff(rail.ProfileZ)~=0) && rail.ProfileY(1)<0 && rail.ProfileY(end)>0, 'rails begin at the track centre');
check(wheel.ProfileY(1)>0 && wheel.ProfileY(end)<0 && max(wheel.ProfileZ)>20, 'wheels begin at the field side, flange down');
check(rail.ProfileS(1)==0 && all(diff(rail.ProfileS)>0), 'length along the profile');

% the contact reference of the program lies on the rail, which has the contact angle there, and below the wheel
for icase = [2 7]
   s = loadcase('wheel_on_rail', icase);
   m = s(1).meta;
   side = 1 - 2*(s(1).config==0);
   [z, slope] = at(rail, side, m.ycp_r);
   check_near([z slope], [m.zcp_r tan(m.deltcp_r)], 0.02, 'rail profile at the contact');
   z = at(wheel, side, m.ycp_w);
   check_near(z - m.zcp_w, out.cp_creep.pen(1,icase), 0.01, 'the wheel lies lower by the approach');
end

% --- mirroring, scaling, order
p = struct('ProfileY',rail.ProfileY, 'ProfileZ',rail.ProfileZ);
back = struct('ProfileY',flipud(-p.ProfileY), 'ProfileZ',flipud(p.ProfileZ));
q = modify_profile(back, 0, 1);
check_near([q.ProfileY q.ProfileZ], [p.ProfileY p.ProfileZ], 1e-12, 'mirrored back and ordered');
q = modify_profile(struct('ProfileY',p.ProfileY/1000,'ProfileZ',-p.ProfileZ/1000), 0, 0, 0, 1000);
check_near([q.ProfileY q.ProfileZ], [p.ProfileY p.ProfileZ], 1e-9, 'upside down in metres');
q = modify_profile(struct('ProfileY',flipud(wheel.ProfileY),'ProfileZ',-flipud(wheel.ProfileZ)), 1);
check_near([q.ProfileY q.ProfileZ], [wheel.ProfileY wheel.ProfileZ], 1e-12, 'wheel upside down and reversed');
[~, tip] = max(wheel.ProfileZ);
q = modify_profile(struct('ProfileY',wheel.ProfileY(1:tip),'ProfileZ',-wheel.ProfileZ(1:tip)), 1);
check_near([q.ProfileY q.ProfileZ], [wheel.ProfileY(1:tip) wheel.ProfileZ(1:tip)], 1e-12, 'wheel upside down that ends at the flange tip');
check_error(@() modify_profile(struct('ProfileY',[0;1],'ProfileZ',[0;0]), 1, 0, -1, 1, 0), 'must decrease');
check_error(@() modify_profile(struct('ProfileY',0,'ProfileZ',0)), 'at least two points');

% --- write and read again
write_simpack(rail, 'copy.prr', 'a copy');
q = read_profile('copy.prr');
check_near([q.ProfileY q.ProfileZ], [rail.ProfileY rail.ProfileZ], 1e-9, 'Simpack rail');
raw = read_simpack('copy.prr');
check(strcmp(raw.comment,'a copy') && raw.type==0, 'header of a Simpack file');
write_simpack(wheel, 'copy.prw');
q = read_profile('copy.prw');
check_near([q.ProfileY q.ProfileZ], [wheel.ProfileY wheel.ProfileZ], 1e-9, 'Simpack wheel');
write_miniprof(rail, 'copy.ban', 'a copy');
q = read_profile('copy.ban');
check_near(q.ProfileY, rail.ProfileY, 1e-9, 'Miniprof rail');
write_miniprof([wheel.ProfileY wheel.ProfileZ], 'copy.whl');
q = read_profile('copy.whl');
check_near(q.ProfileZ, wheel.ProfileZ, 1e-9, 'Miniprof wheel');
check_error(@() write_simpack(rail, 'copy.prw'), 'does not fit');
check_error(@() write_simpack(rail, 'copy.txt'), 'extension');
check_error(@() write_miniprof(wheel, 'copy.ban'), 'does not fit');
check_error(@() read_profile('copy.prw', 0), 'wheel profile by its extension');
check_error(@() read_profile('nosuch.prr'), 'cannot open');

% --- options inside a Simpack file
put('opt.prr', {'header.begin','type = 0','header.end','spline.begin','shift.y = 1','mirror.y = 1', ...
    'bound.y.min = -3','bound.y.max = 4','units.len.f = 1000 ! mm','point.begin', ...
    '-5 2 % out of bounds','-4 1','0 0 1.0','3 1','5 4','point.end','spline.end','what follows is not read'});
q = read_profile('opt.prr');
check_near([q.ProfileY q.ProfileZ], [-4 1; -1 0; 3 1], 1e-12, 'shift, bounds, mirroring, weights');
q = read_profile('opt.prr', 0, -1);
check_near(q.ProfileY, [-3; 1; 4], 1e-12, 'the mirroring of the file is switched off');
put('turn.prr', {'header.begin','type = 0','header.end','spline.begin','rotate = 90','units.ang.f = 57.295779513082323','units.len.f = 1', ...
    'bound.y.min = -2','bound.y.max = 2','shift.y = 1','point.begin','-1 2','0 1','0.001 1','1 0','0 -1','-1 -3','point.end','spline.end'});
q = read_profile('turn.prr', 0, 0, -1);
check_near([q.ProfileY q.ProfileZ], 1000*[-2 0; -1 1; -1 1.001; 0 2; 1 1], 1e-9, 'rotated after the shift, then cut');
put('bad.prr', {'header.begin','type = 0','header.end','spline.begin','rotate = 4','point.begin','0 0','1 0','point.end','spline.end'});
check_error(@() read_profile('bad.prr'), 'at most pi');
put('bad.prr', {'spline.begin','header.begin'});
check_error(@() read_profile('bad.prr'), 'not expected here');
put('bad.prr', {'header.begin','type = 0','header.end'});
check_error(@() read_profile('bad.prr'), 'no spline.end');
put('bad.prr', {'header.begin','type = 1','header.end','spline.begin','point.begin','0 0','1 0','point.end','spline.end'});
check_error(@() read_profile('bad.prr'), 'does not fit its extension');

% --- Miniprof headers and plain tables
put('table.txt', {'# a table','-30, 10','-10 1','','  0 0','10 1','30 11'});
q = read_profile('table.txt');
check_near([q.ProfileY q.ProfileZ], [-30 10; -10 1; 0 0; 10 1; 30 11], 1e-12, 'table with comments');
put('cols.ban', {'XOffset=2','YOffset=-1','ColumnDef=X,Y,A','','-10 2 0','0 1 0','0 7','10 2 0'});
q = with_warning_off(@() read_profile('cols.ban', 0, 0, -1));
check_near([q.ProfileY q.ProfileZ], [-8 1; 2 0; 12 1], 1e-12, 'columns and offsets');
put('other.ban', {'ColumnDef=*,Y,*,X','','7 2 9 -10','8 1 9 0','9 2 9 10'});
q = read_profile('other.ban', 0, 0, -1);
check_near([q.ProfileY q.ProfileZ], [-10 2; 0 1; 10 2], 1e-12, 'columns without meaning');
put('bad.ban', {'XOffset=2','','1 2','Key=3','2 3'});
check_error(@() read_profile('bad.ban'), 'keyword among the numbers');

% a mirrored rail is still a rail, also in metres; the order follows from the shape, independent of the file
files = {rail, struct('ProfileY',flipud(rail.ProfileY), 'ProfileZ',flipud(rail.ProfileZ))};
for i = 1 : 2
   write_simpack([files{i}.ProfileY, files{i}.ProfileZ], 'order.prr');
   text = fileread('order.prr');
   for inversion = '01'
      f = fopen('order.prr', 'w');
      fwrite(f, strrep(text, "spline.begin\n", ["spline.begin\n  inversion = " inversion "\n"]));
      fclose(f);
      check(read_simpack('order.prr').inversion==inversion-'0', 'as stated in the file');
      q = read_profile('order.prr');
      check_near([q.ProfileY q.ProfileZ], [rail.ProfileY rail.ProfileZ], 1e-6, 'order by the shape');
      q = read_profile('order.prr', [], 1, -1, 1000);
      check_near([q.ProfileY q.ProfileZ], 1000*[-flipud(rail.ProfileY) flipud(rail.ProfileZ)], 1e-3, 'mirrored and scaled');
   end
end

% --- slices: a rail that rises between two features
mkdir_if('slices');
for i = 1 : 5
   write_simpack([rail.ProfileY, rail.ProfileZ-0.1*i], sprintf('slices/s%d.prr', i));
end
put('rise.slcs', {'0.0 1000.0 % in metres','5','3 0 0','1','0.0 ''slices/s1.prr''','0.1 ''slices/s2.prr''', ...
    '0.2 ''slices\s3.prr''','0.3 ''slices/s4.prr''','0.4 ''slices/s5.prr''', ...
    '0.0 -1 30 999','0.1 -1 30 999','0.2 0 30 999','0.3 0 30 999','0.4 0 30 999'});
r = read_profile('rise.slcs');
check(r.nslc==5 && r.u_intpol==1, 'slices file');
check_near(r.u', [0 100 200 300 400], 1e-9, 'positions in mm');
r = resample_slices(r, 1);
check(all(isnan(r.vy(1,1:10))) && ~any(isnan(r.vy(3,:))), 'a part that two slices do not have');
check_near(r.vz(5,end), r.vz(1,end)-0.4, 1e-9, 'the rise');
check_near(hypot(diff(r.vy(3,1:3)),diff(r.vz(3,1:3))), [1 1]*30/31, 5e-3, 'distance of points');
% the surface of splines exists where the slices exist: a part is missing at the beginning, then at the end
[~, ~, y, z] = eval_2dspline(r, [50; 250], [0.05 0.7]);
check(isequal(isnan(z), [true false; false false]), 'no surface where two slices lack a part');
check_near(y(2,1), interp1(linspace(0, 1, size(r.vy,2)), mean(r.vy(3:4,:)), 0.05), 1e-2, 'its points');
text = strrep(strrep(fileread('rise.slcs'), '0.0 -1 30 999', '0.0 0 30 -1'), '0.1 -1 30 999', '0.1 0 30 -1');
f = fopen('fall.slcs', 'w');   fwrite(f, text);   fclose(f);
r = read_profile('fall.slcs');
y = resample_slices(r, 1).vy;
last = find(~isnan(y(1,:)), 1, 'last');
check_near(y(1,last), interp1(r.prof{1}.ProfileS, r.prof{1}.ProfileY, 30), 1e-9, 'a part ends at its feature');
check(~any(isnan(y(3,:))) && last>1, 'the others have all parts');
put('bad.slcs', {'0 1','2','0 0 0','3','0 ''slices/s1.prr''','1 ''slices/s2.prr'''});
check_error(@() read_slices('bad.slcs'), 'interpolation method 3');

% --- published profiles
folder = fullfile(getenv('CONTACT_REFERENCE'), 'examples');
if (exist(fullfile(folder,'MBench_UIC60_v3.prr'),'file')==2)
   a = read_profile(fullfile(folder,'MBench_UIC60_v3.prr'));
   b = read_profile(fullfile(folder,'MBench_UIC60_v3.ban'), 0, 1);
   y = (-25:25)';
   check_near(interp1(b.ProfileY,b.ProfileZ,y), interp1(a.ProfileY,a.ProfileZ,y), 1e-3, 'two formats of one rail');
   w = read_profile(fullfile(folder,'MBench_S1002_v3.prw'));
   check_near([w.ProfileY([1 end])' w.ProfileZ(end)], [60 -69.6126 13.4856], 1e-3, 'ends of the wheel');
   c = read_slices(fullfile(folder,'..','testbank','profiles','uk_interrupt_v2.slcs'), 0, 0, 0, 1000);
   c = resample_slices(c, 1);
   check(size(c.vy,1)==c.nslc && any(isnan(c.vy(:))), 'crossing with interrupted parts');
else
   disp('published profiles are not available; not compared');
end
