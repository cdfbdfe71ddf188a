% The same structs from .mat and .subs files and from the HDF5 file of the experiment
1;

function [ txt, n ] = with_all_elements( txt )
% Input with A = 2 in each case: the fourth digit of the line with H G I A O W R; n: number of cases

   at = regexp(txt, '^\s*\d{7}\s+H[ -]G[ -]I', 'end', 'lineanchors');
   from = regexp(txt, '\d{7}\s+H[ -]G[ -]I', 'start');
   txt(from+3) = '2';
   n = numel(at);

end

function compare( name, icase )
% All patches of a case; .mat files have six figures

   check_same_struct(loadcase([name '.h5'], icase), loadcase(name, icase), 6, sprintf('%s.%d', name, icase));

end

% --- examples with .mat files of all elements, one or more of each material and friction law
names = {'cattaneo','carter2d','bentall','simplified','layer_element','layer_traction','visc_rollers', ...
         'falling_friction','sliding_temperature','groove','wheel_on_rail','conformal_wheel'};
for k = 1 : numel(names)
   txt = fileread(fullfile(getenv('CONTACT_SOURCE'), 'examples', [names{k} '.inp']));
   % A-digit: H G I A O W R, in a separate line after the other digits
   [txt, n] = with_all_elements(txt);
   run_input(names{k}, txt, '--hdf5', 'profiles/60E1.prr', 'profiles/S1002.prw');
   ncase = 0;
   for icase = 1 : min(n,6)
      if (isempty(glob(sprintf('%s.%04d*.mat', names{k}, icase))))
         continue
      end
      compare(names{k}, icase);
      ncase = ncase + 1;
   end
   check(ncase>=1, ['cases of ' names{k}]);
end

% --- several patches, left and right, with blocks below the surface
block = sprintf('2 2\n9\n3 4 2\n-2 0 2\n-3 -1 0.5 2\n-1 0.5\n1\n2 0 0.5\n0\n');
head  = sprintf(['203103\n0022033\n0002201\n999 100 30 1 1e-5\n0.35 0.35\n0.28 0.28 82000 82000\n' ...
                 '0.5 0.5 1.0 90d 0 0\n14 0 1435 0.025\n''profiles/60E1.prr'' 0 1 0\n0 0 0 0 0 0\n1360 -70 460\n' ...
                 '''profiles/S1002.prw'' 0 1 0\n']);
txt = '';
for side = [1 -1]
   txt = [txt, sprintf('1 MODULE\n%d%s0 %g 100000 0 %g 0\n20000 0 0 0 0 -43.5\n%s', side==1, head, 6.3*side, ...
                       0.03*side, block)];
end
run_input('sides', [txt sprintf('0\n')], '--hdf5', 'profiles/60E1.prr', 'profiles/S1002.prw');
for icase = 1 : 2
   compare('sides', icase);
   check(numel(loadcase('sides', icase))==2, 'two patches');
   check_same_struct(loadcase('sides.h5', icase, 2), loadcase('sides', icase, 2), 6, 'second patch');
   [a, b, c] = loadcase('sides.h5', icase, -1);
   check(a.meta.ipatch==1 && b.meta.ipatch==2 && isempty(c), 'patches in separate structs');
   for ipatch = 1 : 2
      [a1, a2] = loadstrs('sides', icase, ipatch);
      [b1, b2] = loadstrs('sides.h5', icase, ipatch);
      check_same_struct(b1, a1, 4, 'points anywhere');
      check_same_struct(b2, a2, 4, 'points below elements');
   end
end

% the left side is the mirror image of the right one; points are at the requested positions
for ipatch = 1 : 2
   [~, r] = loadstrs('sides.h5', 1, ipatch);
   [~, l] = loadstrs('sides.h5', 2, ipatch);
   check_near(l.y, -r.y(end:-1:1), 1e-9, 'rows of the left side');
   check_near(l.sigvm(:), r.sigvm(:,end:-1:1,:)(:), 1e-6*max(r.sigvm(:)), 'von Mises stress of the left side');
   check_near(l.sigyz(:), -r.sigyz(:,end:-1:1,:)(:), 1e-6*max(r.sigvm(:)), 'shear stress of the left side');
   check_near(l.uy(:), -r.uy(:,end:-1:1,:)(:), 1e-6*max(abs(r.uy(:))), 'displacement of the left side');
   first = loadstrs('sides.h5', 2, ipatch);
   check_near(first.y, [-3; -1; 0.5; 2], 1e-12, 'given coordinates on the left side');
end

% --- result elements share one file
one = sprintf('3 1 1\n203100\n022020\n0002001\n999 100 30 1 1e-5\n1000 -1e-4 0 0\n0.3 0.3\n0 0.2 1000\n0.28 0.28 82000 82000\n');
one = [one, sprintf('1\n13 11 -1.3 -1.1 0.2 0.2\n1 1\n0.01 0 0.01 0 0 0\n')];
run_input('elements', [one, strrep(strrep(one,'3 1 1','3 2 1'),'1000 -1e-4','2000 -1e-4'), sprintf('0\n')], '--hdf5');
s = loadcase('elements_re002', 1);
delete('elements_re002.0001.mat');
check_same_struct(loadcase('elements_re002', 1), s, 6, 'result element without .mat file');

% --- what follows from other choices: FaStrip as published after slope reduction, each with and without motion
txt = '';
values = {sprintf('0.8 0.5 0.1\n'), '', ''};
rolling = {'', sprintf('0 1 20000\n')};
for m = [5 6 7]
   for t = [0 3]
      txt = [txt, sprintf(['3 MODULE\n20%d100\n0022%d10\n0002201\n100 100 30 1 1e-5\n9000 0.001 0 0\n0.3 0.3\n%s' ...
                           '0.28 0.28 82000 82000\n%s-3\n9 9 4 3 1.125\n'], t, m, rolling{1+t/3}, values{m-4})];
   end
end
% pressures displace the surfaces of dissimilar bodies laterally, without motion as well
txt = [txt, sprintf(['3 MODULE\n200100\n0022010\n0002201\n100 100 30 10 1e-5\n9000 0 0 0\n0.3 0.3\n' ...
                     '0.28 0.3 82000 2000\n-3\n9 9 4 3 1.125\n0\n'])];
run_input('other', txt, '--hdf5');
for icase = 1 : 7
   compare('other', icase);
end
check(loadcase('other', 5).mater.k0_mf==1, 'slope reduction of an earlier case');
check(max(abs(loadcase('other.h5', 7).ux(:)))>1e-4, 'displacements without motion');

% the first point of contact as reference
txt = sprintf('1 MODULE\n1%s0 0 100000 0 0 0\n20000 0 0 0 0 -43.5\n0\n', ...
              strrep(strrep(head, '0022033', '0072033'), '203103', '203100'));
run_input('first', txt, '--hdf5', 'profiles/60E1.prr', 'profiles/S1002.prw');
compare('first', 1);
check(loadcase('first.h5', 1).d_digit==7, 'digit D of wheel and rail');

% --- without .mat and .subs files the HDF5 file is used; hints if there are no results
delete('cattaneo.0002.mat');
check(loadcase('cattaneo', 2).mx==19, 'HDF5 file instead of a .mat file');
delete('sides.0001a.subs');
check(loadstrs('sides', 1).npoints==24, 'HDF5 file instead of a .subs file');
d = diffcase(loadcase('cattaneo',2), loadcase('cattaneo.h5',2));
check(all(d.pn(:)==0), 'difference of cases of an HDF5 file');
check_error(@() loadcase('cattaneo.h5', 99), 'there are no results of case 99');
check_error(@() loadcase('cattaneo', 99), 'there are no results of case 99');
text = warnings_of(@() loadcase('sides.h5', 1, 3));
check(isempty(loadcase('sides.h5', 1, 3)) && ~isempty(strfind(text, 'number 3 does not exist')), 'a patch that the case does not have');
check_error(@() loadcase('sides.h5', 99, 3), 'there are no results of case 99');
check_error(@() loadstrs('cattaneo.h5', 2), 'there are no results of case 2');
f = fopen('text.h5', 'w');   fprintf(f, 'no HDF5 file\n');   fclose(f);
check_error(@() loadcase('text'), 'is not an HDF5 file');
f = fopen('empty.h5', 'w');   fclose(f);
check_error(@() loadcase('empty.h5'), 'is not an HDF5 file');

% --- the same by Matlab's functions
s = loadcase('sides.h5', 2);
t = loadcase('simplified.h5', 2);
[b1, b2] = loadstrs('sides.h5', 1);
addpath(fullfile(getenv('CONTACT_SOURCE'), 'tests', 'octave', 'support', 'matlab_hdf5'));
check(isequaln(loadcase('sides.h5', 2), s), 'h5info and h5read, wheel on rail');
check(isequaln(loadcase('simplified.h5', 2), t), 'h5info and h5read, simplified theory');
[c1, c2] = loadstrs('sides.h5', 1);
check(isequal(c1,b1) && isequal(c2,b2), 'h5info and h5read, stresses');
check_error(@() loadcase('cattaneo.h5', 99), 'there are no results of case 99');
rmpath(fullfile(getenv('CONTACT_SOURCE'), 'tests', 'octave', 'support', 'matlab_hdf5'));
