function run_input( name, text, options, varargin )
% RUN_INPUT  Write an input file into this folder and run the program on it.
%
%   run_input( name, text, options, file, ... )   with files of examples/ that it needs

   for i = 1 : numel(varargin)
      folder = fileparts(varargin{i});
      if (exist(folder,'dir')~=7)
         mkdir(folder);
      end
      copyfile(fullfile(getenv('CONTACT_SOURCE'), 'examples', varargin{i}), varargin{i});
   end
   f = fopen([name '.inp'], 'w');
   fwrite(f, text);
   fclose(f);
   [status, output] = system(sprintf('"%s" --quiet %s 2 %s 2>&1', getenv('CONTACT_PROGRAM'), options, name));
   if (status~=0)
      error('The program could not run %s: %s', name, output);
   end

end % function run_input
