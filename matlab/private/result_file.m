function [ fname ] = result_file( expnam, icase, ipatch, ext )
% RESULT_FILE  Name of the file with results of a case, empty if there is none.
%
%   expnam   experiment name with folder
%   icase    number of the case
%   ipatch   0: no letter; 1, 2, ...: letter a, b, ...
%   ext      '.mat' or '.subs'
%
% Case numbers have at least 4 digits; in older file names they have 6.

   letter = '';
   if (ipatch>0)
      letter = char('a' + ipatch - 1);
   end
   candidates = {sprintf('%s.%04d%s%s', expnam, icase, letter, ext), ...
                 sprintf('%s.%06d%s%s', expnam, icase, letter, ext)};
   for i = 1 : numel(candidates)
      fname = candidates{i};
      if (exist(fname, 'file')==2)
         return
      end
   end
   fname = '';

end % function result_file
