function [ sol, force, subs ] = parse_out3( fname, use_struct, idebug )
% PARSE_OUT3  Read creepages, forces and other overall results of module 3 cases from an .out file.
%
%   sol = parse_out3( fname )
%   [creep, force, subs] = parse_out3( fname )       as arrays with one row per case
%   [creep, force, subs] = parse_out3( fname, 0 )    the same, also for one output
%
%   fname       name of the .out file; without extension, .out is added
%   use_struct  0: arrays; 1: a struct; default: a struct if there is one output
%   idebug      accepted for compatibility and ignored
%
%   creep   columns pen, cksi, ceta, cphi, ncon, nadh, nslip, nplast
%   force   columns fn, fx, fy, mz, elen, fricw, pmax, temp1, temp2; temp1 is the higher temperature, temp2 NaN, as
%           the file has only one value
%   subs    array (case, 4, 8) of value, x, y, z of sighyd, sigvm, sigtr, sigma1, sigma3, sigxx, sigyy, sigzz, of the
%           first block; [] if there is none
%
% All results are rows with one value per case, NaN for values that the file does not have (module 1 cases,
% refused cases, output with O = 0 or 1):
%
%   sol.complete  false, with a warning, if the file reports missing cases or is truncated
%   sol.icase   numbers of the cases
%   sol.kincns  chi [rad] (rolling) or dt [s] (shifts), dq [mm], veloc [mm/s]
%   sol.creep   ncon, nadh, nslip, nplast as in stat; cksi, ceta [-] or shift distances [mm], cphi [rad/mm] or [rad]; pen: approach [mm]
%   sol.force   fn [N]; fx, fy: tangential forces relative to fstat * fn, or to fn where friction varies;
%               fx_true, fy_true [N]; mz [N mm]; elen: elastic energy [J]; fricw: frictional power [W], in
%               shifts work [J]; pmax [N/mm2]; temp, also temp1: maximum temperature [degC]
%   sol.stat    numbers npot, ncon, nadh, nslip, nplast of elements, inorm, itang of iterations
%   sol.subs    largest stresses below the surface and their positions, arrays (1, ncase, nblock): sighyd.val, .x, ...
%
% Creepages and forces that were computed replace prescribed ones. Forces relative to friction come as printed, for
% prescribed forces from the input echo (O >= 2).
%
% See also: parse_out1, loadcase.

   fname = with_extension(fname, '.out');
   sol = guarded(fname, 'parse_out3', @() parse_lines(read_out(fname, 'parse_out3')));
   force = [];
   subs  = [];
   if ((nargin<2 || isempty(use_struct)) && nargout<2) || (nargin>1 && isequal(use_struct,1))
      return
   end
   names = {'sighyd','sigvm','sigtr','sigma1','sigma3','sigxx','sigyy','sigzz'};
   if (~isempty(sol.subs))
      subs = NaN(numel(sol.icase), 4, numel(names));
      parts = {'val','x','y','z'};
      for i = 1 : numel(names)
         for j = 1 : 4
            subs(:,j,i) = sol.subs.(names{i}).(parts{j})(1,:,1);
         end
      end
   end
   force = columns(sol.force, {'fn','fx','fy','mz','elen','fricw','pmax','temp1','temp2'});
   sol   = columns(sol.creep, {'pen','cksi','ceta','cphi','ncon','nadh','nslip','nplast'});

end % function parse_out3

%------------------------------------------------------------------------------------------------------

function [ table ] = columns( s, names )
% Rows of a struct as columns of an array

   table = zeros(numel(s.(names{1})), numel(names));
   for i = 1 : numel(names)
      table(:,i) = s.(names{i});
   end

end % function columns

%------------------------------------------------------------------------------------------------------

function [ sol ] = parse_lines( out )
% Results from the lines of the file

   n   = out.ncase;
   sol.complete = out.complete;
   sol.icase  = out.icase;
   sol.kincns = empty_arrays({'chi','dt','dq','veloc'}, 1, n);
   sol.creep  = empty_arrays({'cksi','ceta','cphi','pen'}, 1, n);
   sol.force  = empty_arrays({'fn','fx','fy','fx_true','fy_true','mz','elen','fricw','pmax','temp'}, 1, n);
   sol.stat   = empty_arrays({'npot','ncon','nadh','nslip','nplast','inorm','itang'}, 1, n);

   results = find_text(out, 'ELAST.EN.   FRIC');
   results = results(out.patch_of(results)==0);
   solved  = out.case_of(results);

   for k = find_text(out, 'KINEMATIC CONSTANTS')
      if (out.patch_of(k)>0)
         continue
      end
      j = out.case_of(k);
      v = heading_values(out.lines, k+1);
      sol.kincns = collect(sol.kincns, 1, j, {'chi','dt','dq','veloc'}, v, {'chi','dt','dq','veloc'});
      sol.creep  = collect(sol.creep, 1, j, {'cksi','ceta','cphi'}, v, {'cksi','ceta','cphi'});
      sol.force  = collect(sol.force, 1, j, {'fx','fy'}, v, {{'fx_fstat_fn','fx_fn'},{'fy_fstat_fn','fy_fn'}});
   end

   for i = 1 : numel(results)
      j = solved(i);
      v = heading_values(out.lines, results(i));
      sol.force = collect(sol.force, 1, j, {'fn','fx_true','fy_true','mz','elen','fricw'}, v, ...
                          {'fn','fx','fy','mz','elast_en',{'fric_power','fric_work'}});
      v = heading_values(out.lines, results(i)+2);
      sol.creep = collect(sol.creep, 1, j, {'cksi','ceta','pen'}, v, ...
                          {{'creep_x','shift_x'},{'creep_y','shift_y'},'approach'});
      sol.force = collect(sol.force, 1, j, {'fx','fy','pmax','temp'}, v, ...
                          {{'fx_fstat_fn','fx_fn'},{'fy_fstat_fn','fy_fn'},'pmax','max_t1_t2'});
   end

   for k = find_text(out, 'NPOT   NCON')
      if (out.patch_of(k)==0)
         names = fieldnames(sol.stat);
         sol.stat = collect(sol.stat, 1, out.case_of(k), names, heading_values(out.lines, k), names);
      end
   end
   for name = {'ncon','nadh','nslip','nplast'}
      sol.creep.(name{1}) = sol.stat.(name{1});
   end
   sol.force.temp1 = sol.force.temp;
   sol.force.temp2 = NaN(1, n);
   sol.subs = collect_subs(out, 1);

end % function parse_lines
