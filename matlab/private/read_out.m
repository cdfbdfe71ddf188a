function [ out ] = read_out( fname, caller )
% READ_OUT  Lines of an .out file, with the case (and contact patch) that each of them belongs to.
%
%   out.lines    the lines, a cell array
%   out.text     all lines in one text, each followed by a line feed
%   out.first    for each line: position of its first character in out.text
%   out.complete false if the file reports missing cases or, for files of this program, if its end is missing
%   out.ncase    number of cases
%   out.icase    numbers of the cases as printed
%   out.case_of  for each line: position in the list of cases, 0 before the first
%   out.patch_of for each line: number of the contact patch, 0 before the first patch of a case

   lines = read_lines(fname, caller);
   if (numel(lines)<2 || isempty(strfind(lines{2}, 'detailed investigation of 3D')))
      error('%s: "%s" is not an .out file of CONTACT.', caller, fname);
   end

   out.lines   = lines;
   parts       = [lines; repmat({char(10)}, 1, numel(lines))];
   out.text    = [parts{:}];
   out.first   = cumsum([1, cellfun('length', lines(1:end-1))+1]);
   ours = any(find_text(out, 'open source')<=6);
   out.complete = isempty(find_text(out, ' Not complete: ')) && (~ours || ~isempty(find_text(out, ' CONTACT ended ')));
   if (~out.complete)
      told = find_text(out, ' Not complete: ');
      what = 'it ends in the midst of a run';
      if (~isempty(told))
         what = strtrim(lines{told(end)});
      end
      warning('%s: "%s" does not have all cases: %s.', caller, fname, what);
   end
   starts      = find(strncmp(lines, ' Case', 5));
   starts      = starts(~cellfun('isempty', regexp(lines(starts), '^ Case +\d+', 'once')));
   out.ncase   = numel(starts);
   out.icase   = zeros(1, out.ncase);
   for i = 1 : out.ncase
      out.icase(i) = sscanf(lines{starts(i)}, ' Case %d', 1);
   end
   mark = zeros(1, numel(lines));
   mark(starts) = 1;
   out.case_of = cumsum(mark);

   out.patch_of = zeros(1, numel(lines));
   patches = find_text(out, 'DATA FOR CONTACT PATCH');
   ends = [patches(2:end)-1, numel(lines)];
   for i = 1 : numel(patches)
      k = patches(i) : ends(i);
      k = k(out.case_of(k)==out.case_of(patches(i)));
      number = sscanf(lines{patches(i)}, ' ----- DATA FOR CONTACT PATCH %d', 1);
      if (isempty(number) || number<1 || number>1000)
         error('%s: "%s" is damaged: line %d has no contact patch number.', caller, fname, patches(i));
      end
      out.patch_of(k) = number;
   end

end % function read_out
