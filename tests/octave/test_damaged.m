% Damaged result files: correct numbers, or an error message of one sentence with the file name; never an endless loop

rand('twister', 16);
run_example('cattaneo');
run_example('subsurface');
run_example('wheel_on_rail', 'profiles/60E1.prr', 'profiles/S1002.prw');
warning('off', 'all');
kinds = {'cattaneo.0002.mat', @() loadcase('damaged', 2); ...
         'wheel_on_rail.0002a.mat', @() loadcase('damaged', 2, 1); ...
         'subsurface.0001.subs', @() loadstrs('damaged', 1); ...
         'cattaneo.out', @() parse_out3('damaged'); ...
         'wheel_on_rail.out', @() parse_out1('damaged')};
reported = 0;   total = 0;
for k = 1 : size(kinds,1)
   f = fopen(kinds{k,1}, 'r');
   whole = fread(f, Inf, 'uint8')';
   fclose(f);
   target = regexprep(kinds{k,1}, '^[a-z_]+', 'damaged');
   for i = 1 : 30
      bytes = whole;
      at = ceil(rand*numel(bytes));
      switch (mod(i,5))
         case 0
            bytes = bytes(1:at);
         case 1
            bytes(at) = fix(rand*256);
         case 2
            bytes(at : min(end,at+fix(rand*200))) = [];
         case 3
            last = min(numel(bytes), at+fix(rand*100));
            bytes(at:last) = fix(rand(1,last-at+1)*256);
         case 4
            % digits in the head of the file
            digits = find(bytes(1:min(end,2500))>='0' & bytes(1:min(end,2500))<='9');
            bytes(digits(ceil(rand*numel(digits)))) = '0' + fix(rand*10);
      end
      f = fopen(target, 'w');
      fwrite(f, bytes, 'uint8');
      fclose(f);
      total = total + 1;
      try
         result = kinds{k,2}();
      catch reason
         reported = reported + 1;
         check(~isempty(strfind(reason.message, 'damaged')) && isempty(strfind(reason.message, char(10))), ...
               sprintf('%s, damage %d at %d, is reported as: %s', kinds{k,1}, mod(i,5), at, reason.message));
      end
   end
   delete(target);
end
fprintf('%d damaged files, %d were reported\n', total, reported);
check(reported>25, 'damage is reported');

% --- the HDF5 file, whose checksums detect every changed digit
run_input('sheet', fileread('wheel_on_rail.inp'), '--hdf5', 'profiles/60E1.prr', 'profiles/S1002.prw');
f = fopen('sheet.h5', 'r');
whole = fread(f, Inf, 'uint8')';
fclose(f);
good = loadcase('sheet.h5', 2);
% entries of the index of the chunks of arrays: byte 5 is the kind, 6 the level
trees = strfind(char(whole), 'TREE');
trees = trees(whole(trees+4)==1 & whole(trees+5)==0);
wrong = 0;   reported = 0;
for i = 1 : 40
   bytes = whole;
   at = ceil(rand*numel(bytes));
   switch (mod(i,4))
      case 0
         bytes(at) = fix(rand*256);
      case 1
         last = min(numel(bytes), at+fix(rand*100));
         bytes(at:last) = fix(rand(1,last-at+1)*256);
      case 2
         bytes = bytes(1:at);
      case 3
         at = trees(ceil(rand*numel(trees))) + 24 + fix(rand*32);
         bytes(at) = bitxor(bytes(at), bitshift(1,fix(rand*8)));
   end
   f = fopen('damaged.h5', 'w');
   fwrite(f, bytes, 'uint8');
   fclose(f);
   try
      found = loadcase('damaged.h5', 2);
      if (~isequaln(found, good))
         wrong = wrong + 1;
         printf('damage %d at %d: other values\n', mod(i,4), at);
      end
   catch reason
      reported = reported + 1;
      check(~isempty(strfind(reason.message, 'damaged')) && isempty(strfind(reason.message, char(10))), ...
            sprintf('damage %d at %d is reported as: %s', mod(i,4), at, reason.message));
   end
end
delete('damaged.h5');
fprintf('40 damaged HDF5 files, %d were reported\n', reported);
check(wrong==0, sprintf('%d damaged HDF5 files give other values', wrong));

% --- an interrupted run
f = fopen('early.inp', 'w');
text = fileread('cattaneo.inp');
fprintf(f, '%s', strrep(text, '9.1954  -0.875', '9.1954  word'));
fclose(f);
system(sprintf('"%s" --quiet 2 early 2> /dev/null', getenv('CONTACT_PROGRAM')));
sol = parse_out3('early');
check(~sol.complete && numel(sol.icase)==1, 'missing cases are reported');
check(getfield(parse_out3('cattaneo'), 'complete'), 'a complete run is complete');
