function [ opt ] = with_defaults( opt, defaults, caller )
% WITH_DEFAULTS  Options of the user, completed by default values.
%
% An unknown option causes a warning, because it has no effect.

   if (isempty(opt))
      opt = struct();
   end
   if (~isstruct(opt))
      error('%s: the options must be a struct, as made by opt = %s.', caller, caller);
   end
   names = fieldnames(opt);
   for i = 1 : numel(names)
      if (~isfield(defaults, names{i}))
         warning('%s: there is no option "%s".', caller, names{i});
      end
   end
   names = fieldnames(defaults);
   for i = 1 : numel(names)
      if (~isfield(opt, names{i}))
         opt.(names{i}) = defaults.(names{i});
      end
   end

end % function with_defaults
