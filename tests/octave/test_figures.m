% The figures of examples/figures, drawn from results of the examples as in doc/user/plots.md

examples = fullfile(getenv('CONTACT_SOURCE'), 'examples', 'figures');
addpath(examples);
if (exist('pictures','dir')~=7)
   mkdir('pictures');
end
draw_figures(getenv('CONTACT_PROGRAM'), 'pictures');
manual = fileread(fullfile(getenv('CONTACT_SOURCE'), 'doc', 'user', 'plots.md'));
scripts = glob(fullfile(examples, 'fig_*.m'));
check(numel(scripts)>=15, 'figures are there');
for i = 1 : numel(scripts)
   [~, name] = fileparts(scripts{i});
   im = imread(fullfile('pictures', [name(5:end) '.png']));
   check(numel(unique(im))>20 && mean(im(:)<250)>0.005, ['figure ' name ' is not empty']);
   check(~isempty(strfind(manual, strtrim(fileread(scripts{i})))), ['doc/user/plots.md shows the commands of ' name]);
   documented = fullfile(getenv('CONTACT_SOURCE'), 'doc', 'user', 'plots', [name(5:end) '.png']);
   check(exist(documented,'file')==2, [documented ' is in the documentation']);
end
