function [ s ] = mysetfield( s, varargin )
% MYSETFIELD  Set a field of a struct whose name may have dots: s = mysetfield(s, 'kincns.t_digit', 3).
%
%   s = mysetfield(s, name, value)
%   s = mysetfield(s, {i,j}, name, {k}, value)   with subscripts, as in setfield
%
% See also: mygetfield, myisfield.

   places = varargin(1:end-1);
   names  = {};
   for i = 1 : numel(places)
      if (iscell(places{i}))
         names{end+1} = places{i};
      else
         names = [names, regexp(deblank(places{i}), '\.', 'split')];
      end
   end
   s = setfield(s, names{:}, varargin{end});

end % function mysetfield
