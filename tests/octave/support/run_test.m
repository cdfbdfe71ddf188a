function run_test( test_script )
% RUN_TEST  Run a test script of this folder and end Octave with status 1 if it fails.

   graphics = any(strcmp(available_graphics_toolkits(), 'qt')) && ~isempty(getenv('DISPLAY'));
   if (graphics)
      graphics_toolkit('qt');
   end
   source(fullfile(fileparts(fileparts(mfilename('fullpath'))), [test_script '.m']));
   printf('%s: %d checks passed\n', test_script, check_count());

end % function run_test
