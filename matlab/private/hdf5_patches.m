function [ patches ] = hdf5_patches( expnam, icase )
% HDF5_PATCHES  Contact patches of a case in the HDF5 file of an experiment, as structs described in LOADCASE.
%
%   patches   cell array, empty if there is no file or no such case

   patches = {};
   parts = [{'inputs','markers','totals','status'}, patch_names(1:99)];
   c = hdf5_case(expnam, icase, parts);
   if (isempty(c))
      return
   end
   if (isfield(c, 'failure'))
      error('loadcase: case %d of "%s" has no result.', icase, expnam);
   end
   names = patch_names(1:99);
   names = names(isfield(c, names));
   for i = 1 : numel(names)
      patches{i} = patch_struct(c, c.(names{i}), i, numel(names));
      [patches{i}.meta.status, patches{i}.meta.reason] = case_status(c);
      patches{i}.meta.icase = icase;
   end

end % function hdf5_patches

%------------------------------------------------------------------------------------------------------

function [ status, reason ] = case_status( c )
% Status of a case and the reason; solved cases have no group 'status'

   status = 'solved';
   reason = '';
   if (isfield(c, 'status'))
      status = char(c.status.status);
      reason = sprintf('%s: %s', char(c.status.iteration), char(c.status.reason));
   end

end % function case_status

%------------------------------------------------------------------------------------------------------

function [ names ] = patch_names( numbers )

   names = cell(1, numel(numbers));
   for i = 1 : numel(numbers)
      names{i} = sprintf('patch_%d', numbers(i));
   end

end % function patch_names

%------------------------------------------------------------------------------------------------------

function [ s ] = patch_struct( c, p, ipatch, npatch )
% One patch; c: group of the case, p: that of the patch

   d = c.inputs.digits;
   g = p.grid;
   rolling = (d.t>=2);
   wheel_rail = isfield(c, 'markers');

   s = struct('config',0, 'h_digit',double(d.h));
   chi = 0;   dq = 1;
   if (rolling)
      chi = g.chi;   dq = g.dq;
   end
   d_digit  = 2;
   reference = [0 0];
   if (wheel_rail)
      s.config  = double(d.c1);
      d_digit   = 1 + find(strcmp(char(c.inputs.search.location), {'locus','locus_extended','conformal','grid', ...
                                                                 'steep_grid','first_contact'}));
      reference = [g.x_elem g.y_elem];
      s.meta    = pair_meta(c, p, ipatch, npatch, s.config);
      veloc     = g.veloc;
   else
      s.meta    = plain_meta(c.inputs.kinematics);
      veloc     = 1;
      if (rolling)
         veloc  = g.veloc;
      end
   end
   s.mater  = materials(c.inputs.material, double(d.m), p);
   s.fric   = friction(c.inputs.friction, double(d.l));
   s.kincns = struct('t_digit',double(d.t), 'chi',chi, 'dq',dq, 'veloc',veloc);
   s.mx = double(g.mx);   s.my = double(g.my);
   s.xl = g.xl + reference(1);   s.yl = g.yl + reference(2);
   s.dx = g.dx;   s.dy = g.dy;
   s.d_digit  = d_digit;
   s.x_offset = [];    s.y_offset = [];
   s.x = s.xl + ((1:s.mx)-0.5) * s.dx;
   s.y = s.yl + ((1:s.my)-0.5) * s.dy;

   % arrays of elements have the shape (mx,my) in the file; fields that a frictionless case does not have are zero
   names = {'eldiv','h','mu','pn','px','py','un','ux','uy'};
   for i = 1 : numel(names)
      s.(names{i}) = zeros(s.my, s.mx);
      if (isfield(p.fields, names{i}))
         s.(names{i}) = double(p.fields.(names{i}))';
      end
   end
   s.srel = zeros(s.my, s.mx);
   if (isfield(p.fields, 'sx'))
      s.srel = hypot(p.fields.sx, p.fields.sy)';
   end
   s.shft = s.srel * dq;
   names = setdiff(fieldnames(p.fields), [names, {'sx','sy'}]);
   for i = 1 : numel(names)
      s.(names{i}) = p.fields.(names{i})';
   end
   s = add_bound(s);

end % function patch_struct

%------------------------------------------------------------------------------------------------------

function [ meta ] = plain_meta( kinematics )
% Positions of a contact problem of module 3

   names = {'tim','s_ws','th_ws','y_r','z_r','roll_r','rnom_rol','x_w','y_w','z_w','roll_w','yaw_w','rnom_whl', ...
            'xcp_r','ycp_r','zcp_r','deltcp_r','xcp_w','ycp_w','zcp_w','npatch','ipatch'};
   for i = 1 : numel(names)
      meta.(names{i}) = 0;
   end
   meta.spinxo = kinematics.spinxo;
   meta.spinyo = kinematics.spinyo;
   meta.ynom_whl = 0;
   meta.format = 2410;

end % function plain_meta

%------------------------------------------------------------------------------------------------------

function [ meta ] = pair_meta( c, p, ipatch, npatch, config )
% Positions of a contact patch of wheel and rail

   t = p.totals;
   m = c.markers;
   roller = (config>=4);
   meta = struct('tim',0, 's_ws',0, 'th_ws',c.inputs.position.pitch, 'y_r',m.y_r, 'z_r',m.z_r, 'roll_r',m.roll_r, ...
                 'rnom_rol',0, 'x_w',m.x_w, 'y_w',m.y_w, 'z_w',m.z_w, 'roll_w',m.roll_w, 'yaw_w',m.yaw_w, ...
                 'rnom_whl',c.inputs.wheel_dimensions.nomradw, 'xcp_r',t.xcp_tr, 'ycp_r',t.ycp_r, 'zcp_r',t.zcp_r, ...
                 'deltcp_r',t.deltcp_r, 'xcp_w',t.xcp_w, 'ycp_w',t.ycp_w, 'zcp_w',t.zcp_w, 'npatch',npatch, ...
                 'ipatch',ipatch, 'spinxo',p.grid.x_elem, 'spinyo',p.grid.y_elem, 'ynom_whl',m.ynom_whl, 'format',2410);
   if (roller)
      meta.rnom_rol = c.inputs.track.nomradr;
   else
      meta.s_ws = c.inputs.position.s_ws;
   end

end % function pair_meta

%------------------------------------------------------------------------------------------------------

function [ mater ] = materials( m, m_digit, p )
% Material model and parameters

   mater = struct('m_digit',m_digit, 'gg',m.gg(:)', 'poiss',m.poiss(:)');
   if (m_digit==1)
      mater.fg = m.fg(:)';
      mater.tc = m.tc(:)';
   elseif (m_digit==4)
      mater = chosen(m, {'gg3','laythk','tau_c0','k_tau'}, mater);
   elseif (m_digit>=2)
      mater.poiss = m.poiss([1 1]);
      mater.poiss = mater.poiss(:)';
      mater.flx   = [0 0 0];       % without motion there are no flexibilities
      if (isfield(p, 'simplified'))
         mater.flx = p.simplified.flx(:)';
      end
      if (isfield(m, 'k0_mf'))
         mater = chosen(m, {'k0_mf','alfamf','betamf'}, mater);
      else                        % M = 6, 7: no reduction of the slope
         mater.k0_mf = 1;   mater.alfamf = 1;   mater.betamf = 1;
      end
   end
   mater = add_combined(mater);

end % function materials

%------------------------------------------------------------------------------------------------------

function [ fric ] = friction( f, digit )
% Friction law, by the digit of the case if its name is not in this list, and the first set of parameters

   names = {'coulomb','','linear','rational','exponential','','temperature'};
   order = {'fstat','fkin','flin1','frat1','fexp1','sabsh1','flin2','frat2','fexp2','sabsh2','fref','tref','dfheat','dtheat', ...
            'memdst','mem_s0'};
   law   = find(strcmp(char(f.law), names)) - 1;
   if (isempty(law))
      law = digit;
   end
   % known parameters in the order of the input, followed by those of a new law
   there = setdiff(fieldnames(f)', {'law','variation','alpha','svf'});
   known = order(ismember(order, there));
   fric = chosen(f, [known, setdiff(there, order)], struct('frclaw',law));
   fric = add_static(fric);

end % function friction

%------------------------------------------------------------------------------------------------------

function [ s ] = chosen( from, names, s )
% Add the first values of fields to a struct

   for i = 1 : numel(names)
      v = from.(names{i});
      s.(names{i}) = v(1);
   end

end % function chosen
