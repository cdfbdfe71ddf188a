function run_example( varargin )
% RUN_EXAMPLE  Copy an example's input, with the files it needs, into this folder and run the program.
%
%   run_example( name, file, ... )

   examples = fullfile(getenv('CONTACT_SOURCE'), 'examples');
   for i = 1 : numel(varargin)
      file = varargin{i};
      if (i==1)
         file = [file '.inp'];
      end
      folder = fileparts(file);
      if (~isempty(folder) && exist(folder,'dir')~=7)
         mkdir(folder);
      end
      copyfile(fullfile(examples, file), file);
   end
   old = [glob([varargin{1} '.*.mat']); glob([varargin{1} '.*.subs'])];
   for i = 1 : numel(old)
      delete(old{i});
   end
   [status, output] = system(sprintf('"%s" --quiet 2 %s 2>&1', getenv('CONTACT_PROGRAM'), varargin{1}));
   if (status~=0)
      error('The program could not run %s: %s', varargin{1}, output);
   end

end % function run_example
