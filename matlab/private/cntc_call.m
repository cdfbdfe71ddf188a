function [ varargout ] = cntc_call( name, varargin )
% CNTC_CALL  Call a routine of the library.
%
%   [out1, out2, ...] = cntc_call( name, arg1, arg2, ... )
%
%   name        routine as in contact_addon.h
%   arg1, ...   all of its arguments in order; for results [] (a single number) or an array of the required size
%   out1, ...   the results in order

   letters = cntc_signature(name);
   if (numel(varargin)~=numel(letters))
      error('%s: the routine has %d arguments, %d were given.', name, numel(letters), numel(varargin));
   end
   is_result = (letters=='I' | letters=='R');
   for i = 1 : numel(letters)
      if (letters(i)=='s')
         if (~ischar(varargin{i}))
            error('%s: argument %d must be a text.', name, i);
         end
      elseif (isempty(varargin{i}) && is_result(i))
         varargin{i} = 0;
      elseif (islogical(varargin{i}) || isinteger(varargin{i}) || isempty(varargin{i}))
         varargin{i} = double(varargin{i});
      end
   end

   if (cntc_library('mex'))
      out = cell(1, max(1,sum(is_result)));
      if (any(is_result))
         [out{:}] = cntc_mex('call', name, letters, varargin{:});
      else
         cntc_mex('call', name, letters, varargin{:});
      end
   elseif (isempty(letters))
      calllib(cntc_library('name'), name);
      out = {};
   else
      % all arguments are addresses, so Matlab returns each of them
      for i = find(letters=='i' | letters=='I')
         varargin{i} = int32(varargin{i});
      end
      out = cell(1, numel(letters));
      [out{:}] = calllib(cntc_library('name'), name, varargin{:});
      out = cellfun(@double, out(is_result), 'uniformoutput',false);
   end
   varargout = out(1:max(nargout,0));

end % function cntc_call
