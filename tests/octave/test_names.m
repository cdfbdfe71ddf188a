% Functions and their numbers of arguments, options, fields and constants agree with published_names.txt

source_folder = getenv('CONTACT_SOURCE');
run_example('cattaneo');
run_example('subsurface');
run_example('manchester', 'profiles/60E1.prr', 'profiles/S1002.prw');
for i = 1 : 2
   write_simpack(sprintf('slice%d.prw', i), '', (10:-1:-10)', -(10:-1:-10)'.^2/600 + i);
end
f = fopen('two.slcw', 'w');
fprintf(f, '0 1\n2\n0 0 0\n1\n0 ''slice1.prw''\n0.2 ''slice2.prw''\n');
fclose(f);

lines = strsplit(fileread(fullfile(source_folder, 'tests', 'octave', 'published_names.txt')), "\n");
kinds = struct('call',0, 'option',0, 'field',0, 'constant',0);
for i = find(~cellfun('isempty', lines) & ~strncmp(lines, '#', 1))
   words = strsplit(lines{i}, ' ');
   names = words(2:end);
   switch (words{1})
      case 'call'
         for name = names
            part = strsplit(name{1}, '/');
            takes = nargin(part{1});
            gives = nargout(part{1});
            check(takes<0 || takes>=str2double(part{2}), sprintf('%s takes %d arguments', part{1:2}));
            check(gives<0 || gives>=str2double(part{3}), sprintf('%s gives %s results', part{[1 3]}));
         end
      case 'option'
         opt = feval(names{1});
         names = names(2:end);
         check(all(isfield(opt, names)), ['options of ' lines{i}]);
      case 'field'
         % the call may have blanks
         part = strsplit(lines{i}(7:end), ' : ');
         result = eval(part{1});
         names = strsplit(part{2}, ' ');
         for name = names
            check(myisfield(result, name{1}), sprintf('%s has no %s', part{1}, name{1}));
         end
      case 'constant'
         check(all(isfield(cntc_getmagicnumbers(), names)), lines{i});
      otherwise
         error('FAILED: what is "%s"?', lines{i});
   end
   kinds.(words{1}) = kinds.(words{1}) + numel(names);
end
disp(kinds);
check(kinds.call>100 && kinds.option>40 && kinds.field>80 && kinds.constant>20, 'all of the table');
