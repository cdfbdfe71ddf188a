function [ sol, ws_pos, tot_forc, cp_pos, cp_creep, cp_force, cp_subs ] = parse_out1( fname, ire, idebug )
% PARSE_OUT1  Read positions, forces and results per contact patch of module 1 cases from an .out file.
%
%   sol = parse_out1( fname )
%   sol = parse_out1( fname, ire )     cases of a result element of the library; -1 or []: all (default)
%   [npatch, ws_pos, tot_forc, cp_pos, cp_creep, cp_force, cp_subs] = parse_out1( ... )   the parts of sol
%
%   fname   name of the .out file; without extension, .out is added
%   a third argument, idebug, is ignored
%
% Values of a case are rows with one column per case; values of contact patches are arrays with one row per
% patch and one column per case. Missing values are NaN, e.g. for patches that do not exist.
%
%   sol.complete  false, with a warning, if the file reports missing cases or is truncated
%   sol.icase     numbers of the cases; sol.ire, sol.tim: result elements and times [s], in files of the library
%   sol.config    0, 1: left and right wheel on rail; 4, 5: the same on roller
%   sol.ws_pos    wheelset: s (for rollers x), y, z [mm], roll, yaw, pitch [rad]
%                 and velocities vs, vy, vz [mm/s], vroll, vyaw, vpitch, vpitch_rol [rad/s]
%   sol.whl_dev   deviations of a flexible wheelset: dx, dy, dz, droll, dyaw, dpitch and their velocities vx, ..., vpitch
%   sol.rail      deviations dy, dz [mm], droll [rad] with velocities vy, vz, vroll; of the massless
%                 rail: deflections dy_defl, dz_defl [mm], springs ky, kz [N/mm], forces fy, fz [N]
%   sol.tot_forc  forces on the rail in track and wheelset directions: fx_tr ... fz_ws [N]; with O >= 4 moments at
%                 the rail and wheel markers: mx_r_tr, my_r_tr, mz_r_tr, mx_w_ws, my_w_ws, mz_w_ws [N mm]
%   sol.npatch    numbers of contact patches
%   sol.cp_pos    contact reference: xcp_tr, ycp_tr, zcp_tr [mm], delttr [rad], ycp_r, zcp_r, xcp_w, ycp_w, zcp_w [mm];
%                 prev1, prev2: patches of the previous case that this one continues, 0 for a new one
%   sol.cp_creep  cksi, ceta [-], cphi [rad/mm]; pen: approach [mm]; veloc [mm/s], chi [rad], dq [mm]
%   sol.cp_force  fn, fx, fs [N], mn [N mm]; fx_rel, fs_rel: forces relative to fstat * fn, or to fn;
%                 elen: elastic energy [J], fricw: frictional power [W], pmax [N/mm2], temp [degC].
%                 Conformal patches have the sums over the curved surface, and tilde_fn [N]
%   sol.cp_stat   numbers npot, ncon, nadh, nslip, nplast of elements, inorm, itang of iterations
%   sol.cp_subs   largest stresses below the surface, arrays (patch, case, block): sighyd.val, .x, .y, .z, ...
%
% Names used by other scripts are available as well: ws_pos.x, .vx, dx_whl ..., dyrail ..., kyrail ... fzdefl; tot_forc.mx_tr ...;
% cp_pos.delt_tr, ncon, nadh, nslip, nplast, prev_icp (patch, number, case); cp_force.fric.
%
% See also: parse_out3, loadcase.

   fname = with_extension(fname, '.out');
   sol = guarded(fname, 'parse_out1', @() parse_lines(read_out(fname, 'parse_out1')));
   sol = other_names(sol);
   if (nargin>1 && ~isempty(ire) && ire>=0)
      if (~isfield(sol, 'ire'))
         error('parse_out1: "%s" has no numbers of result elements.', fname);
      end
      sol = chosen_cases(sol, sol.ire==ire, numel(sol.icase));
   end
   if (nargout>1)
      ws_pos   = sol.ws_pos;
      tot_forc = sol.tot_forc;
      cp_pos   = sol.cp_pos;
      cp_creep = sol.cp_creep;
      cp_force = sol.cp_force;
      cp_subs  = sol.cp_subs;
      sol      = sol.npatch;
   end

end % function parse_out1

%------------------------------------------------------------------------------------------------------

function [ sol ] = other_names( sol )
% Additional names that other scripts use

   sol.ws_pos.x  = sol.ws_pos.s;
   sol.ws_pos.vx = sol.ws_pos.vs;
   sol.ws_pos = copied(sol.ws_pos, sol.whl_dev, {'dx','dy','dz','droll','dyaw','dpitch','vx','vy','vz','vroll','vyaw','vpitch'}, ...
         {'dx_whl','dy_whl','dz_whl','drollw','dyaww','dpitchw','vxwhl','vywhl','vzwhl','vrollw','vyaww','vpitchw'});
   sol.ws_pos = copied(sol.ws_pos, sol.rail, {'dy','dz','droll','vy','vz','vroll'}, ...
         {'dyrail','dzrail','drrail','vyrail','vzrail','vrrail'});
   sol.ws_pos = copied(sol.ws_pos, sol.rail, {'ky','dy_defl','fy','kz','dz_defl','fz'}, ...
         {'kyrail','dydefl','fydefl','kzrail','dzdefl','fzdefl'});
   for axis = 'xyz'
      sol.tot_forc.(['m' axis '_tr']) = sol.tot_forc.(['m' axis '_r_tr']);
      sol.tot_forc.(['m' axis '_ws']) = sol.tot_forc.(['m' axis '_w_ws']);
   end
   sol.cp_pos.delt_tr = sol.cp_pos.delttr;
   sol.cp_pos = copied(sol.cp_pos, sol.cp_pos, {'xcp_tr','ycp_tr','zcp_tr','ycp_r','zcp_r','xcp_w','ycp_w','zcp_w'}, ...
         {'xtr','ytr','ztr','yr','zr','xw','yw','zw'});
   for name = {'ncon','nadh','nslip','nplast'}
      sol.cp_pos.(name{1}) = sol.cp_stat.(name{1});
   end
   before = cat(3, sol.cp_pos.prev1, sol.cp_pos.prev2);
   sol.cp_pos.prev_icp = permute(before, [1 3 2]);
   sol.cp_force.fric = sol.cp_force.fricw;

end % function other_names

%------------------------------------------------------------------------------------------------------

function [ to ] = copied( to, from, names, others )
% Values under additional names, if they exist

   if (all(isnan(from.(names{1})(:))))
      return
   end
   for i = 1 : numel(names)
      to.(others{i}) = from.(names{i});
   end

end % function copied

%------------------------------------------------------------------------------------------------------

function [ s ] = chosen_cases( s, wanted, n )
% Selected cases out of n, in all arrays of nested structs

   names = fieldnames(s);
   for i = 1 : numel(names)
      v = s.(names{i});
      if (isstruct(v))
         s.(names{i}) = chosen_cases(v, wanted, n);
      elseif (strcmp(names{i}, 'prev_icp'))
         s.(names{i}) = v(:,:,wanted);
      elseif (size(v,2)==n && ~strcmp(names{i},'complete'))
         s.(names{i}) = v(:,wanted,:);
      end
   end

end % function chosen_cases

%------------------------------------------------------------------------------------------------------

function [ sol ] = parse_lines( out )
% Results from the lines of the file

   n   = out.ncase;
   m   = max([1, out.patch_of]);
   sol.complete = out.complete;
   sol.icase    = out.icase;
   sol.config   = find_config(out);
   told = cell(1, n);
   for i = find(strncmp(out.lines, ' Case', 5))
      j = out.case_of(i);
      if (j>0)
         told{j} = regexp(out.lines{i}, 'result element *(\d+)(?:, t= *([-+.eEdD\d]+))?', 'tokens', 'once');
      end
   end
   if (~all(cellfun('isempty', told)))
      sol.ire = NaN(1, n);
      sol.tim = NaN(1, n);
      for j = find(~cellfun('isempty', told))
         sol.ire(j) = str2double(told{j}{1});
         if (numel(told{j})>1)
            sol.tim(j) = str2double(told{j}{2});
         end
      end
   end
   out.in_module1 = ~isnan(sol.config);

   sol.ws_pos   = rows(out, 'Y_WS        Z_WS', 1, ...
         {'s','y','z','roll','yaw','pitch'}, {{'s_ws','x_ws'},'y_ws','z_ws','roll_ws','yaw_ws','pitch_ws'});
   sol.ws_pos   = rows(out, 'VY_WS       VZ_WS', 1, ...
         {'vs','vy','vz','vroll','vyaw','vpitch','vpitch_rol'}, ...
         {{'vs_ws','vx_ws'},'vy_ws','vz_ws','vroll_ws','vyaw_ws','vpitch_ws','vpitch_rol'}, sol.ws_pos);
   sol.whl_dev  = rows(out, ' DXWHL', 1, {'dx','dy','dz','droll','dyaw','dpitch'}, ...
         {'dxwhl','dywhl','dzwhl','drollw','dyaww','dpitchw'});
   sol.whl_dev  = rows(out, ' VXWHL', 1, {'vx','vy','vz','vroll','vyaw','vpitch'}, ...
         {'vxwhl','vywhl','vzwhl','vrollw','vyaww','vpitchw'}, sol.whl_dev);
   sol.rail     = rows(out, ' DYRAIL', 1, {'dy','dz','droll','vy','vz','vroll'}, ...
         {'dyrail','dzrail','drollr','vyrail','vzrail','vrollr'});
   deflection   = {'ky_rail','dy_defl','fy_rail','kz_rail','dz_defl','fz_rail'};
   sol.rail     = rows(out, ' DY_DEFL', 1, {'ky','dy_defl','fy','kz','dz_defl','fz'}, deflection, sol.rail);
   forces       = {'fx_tr','fy_tr','fz_tr','fx_ws','fy_ws','fz_ws'};
   sol.tot_forc = rows(out, 'FX(TR)      FY(TR)', 1, forces, forces);
   moments      = {'mx_r_tr','my_r_tr','mz_r_tr','mx_w_ws','my_w_ws','mz_w_ws'};
   sol.tot_forc = rows(out, 'MX@R(TR)', 1, moments, moments, sol.tot_forc);

   sol.npatch   = count_patches(out);
   sol.cp_pos   = rows(out, 'XCP(TR)     YCP(TR)', m, {'xcp_tr','ycp_tr','zcp_tr','delttr','ycp_r','zcp_r'}, ...
         {'xcp_tr','ycp_tr','zcp_tr','deltcp_tr','ycp_r','zcp_r'});
   wheel        = {'xcp_w','ycp_w','zcp_w'};
   sol.cp_pos   = rows(out, 'XCP(W)', m, wheel, wheel, sol.cp_pos);
   sol.cp_pos   = previous_patches(out, m, sol.cp_pos);
   kinematic    = {'cksi','ceta','cphi','veloc','chi','dq'};
   sol.cp_creep = rows(out, ' CKSI        CETA', m, kinematic, kinematic);
   sol.cp_force = rows(out, 'ELAST.EN.   FRIC', m, {'fn','fx','fs','mn','elen','fricw'}, ...
         {{'fn','bar_fn'},{'fx','bar_fx'},{'fs','bar_fs'},'mn','elast_en','fric_power'});
   second       = {'approach','pmax','temp','fx_rel','fs_rel','tilde_fn'};
   from         = {'approach','pmax','max_t1_t2',{'fx_fstat_fn','fx_fn'},{'fs_fstat_fn','fs_fn'},'tilde_fn'};
   sol.cp_force = rows(out, 'APPROACH     PMAX', m, second, from, sol.cp_force);
   sol.cp_creep.pen = sol.cp_force.approach;
   sol.cp_force = rmfield(sol.cp_force, 'approach');
   stat         = {'npot','ncon','nadh','nslip','nplast','inorm','itang'};
   sol.cp_stat  = rows(out, 'NPOT   NCON', m, stat, stat);
   sol.cp_subs  = collect_subs(out, m);

end % function parse_lines

%------------------------------------------------------------------------------------------------------

function [ config ] = find_config( out )
% Configuration of each case; NaN for other modules. With O=1 there is no title; then total forces indicate the module

   config = NaN(1, out.ncase);
   k = find_text(out, 'FX(TR)      FY(TR)');
   config(out.case_of(k)) = 1;
   titles = {'WHEEL-RAIL CONTACT, LEFT',0; 'WHEEL-RAIL CONTACT, RIGHT',1; ...
             'WHEEL-ROLLER CONTACT, LEFT',4; 'WHEEL-ROLLER CONTACT, RIGHT',5};
   for i = 1 : size(titles,1)
      k = find_text(out, titles{i,1});
      config(out.case_of(k)) = titles{i,2};
   end

end % function find_config

%------------------------------------------------------------------------------------------------------

function [ npatch ] = count_patches( out )
% Number of patches with results in each module 1 case

   npatch = zeros(1, out.ncase);
   for k = find_text(out, 'DATA FOR CONTACT PATCH')
      j = out.case_of(k);
      npatch(j) = max(npatch(j), out.patch_of(k));
   end

end % function count_patches

%------------------------------------------------------------------------------------------------------

function [ pos ] = previous_patches( out, m, pos )
% Numbers after PREV in the headings of patches

   pos.prev1 = NaN(m, out.ncase);
   pos.prev2 = NaN(m, out.ncase);
   for k = find_text(out, 'DATA FOR CONTACT PATCH')
      i = out.patch_of(k);
      j = out.case_of(k);
      pos.prev1(i,j) = 0;
      pos.prev2(i,j) = 0;
      text = regexp(out.lines{k}, 'PREV([ \d,]+)', 'tokens', 'once');
      if (~isempty(text))
         v = sscanf(strrep(text{1}, ',', ' '), '%d');
         pos.prev1(i,j) = v(1);
         if (numel(v)>1)
            pos.prev2(i,j) = v(2);
         end
      end
   end

end % function previous_patches

%------------------------------------------------------------------------------------------------------

function [ s ] = rows( out, heading, nrow, names, from, s )
% Values below all occurrences of a heading in module 1 cases, in the row of their patch

   if (nargin<6)
      s = struct();
   end
   new = empty_arrays(names, nrow, out.ncase);
   for k = find_text(out, heading)
      j = out.case_of(k);
      if (j>0 && out.in_module1(j))
         new = collect(new, max(1,out.patch_of(k)), j, names, heading_values(out.lines, k), from);
      end
   end
   for i = 1 : numel(names)
      s.(names{i}) = new.(names{i});
   end

end % function rows
