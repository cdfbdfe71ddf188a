function [ s ] = read_mat_file( fname, icase )
% READ_MAT_FILE  Contents of one .mat file as the struct described in LOADCASE.

   [rows, comments] = read_table(fname);
   if (size(rows,1)<6)
      error('loadcase: "%s" ends before the table of elements.', fname);
   end
   fmt = rows(1,end);
   if (fmt>2410)
      error('loadcase: "%s" has format %d; this script knows formats up to 2410.', fname, fmt);
   elseif (fmt<2320)
      error('loadcase: "%s" has format %d, older than 2320; run the case again.', fname, fmt);
   end
   elements = rows(7:end,:);
   if (size(rows,2)<11 || any(~isfinite(rows(4,1:6))) || any(rows(4,1:2)<1) || any(rows(4,1:2)~=fix(rows(4,1:2))) ...
         || prod(rows(4,1:2))>1e8 || any(rows(4,5:6)<=0))
      error('loadcase: "%s" is damaged: line 8 has invalid values of MX, MY, XL, YL, DX, DY.', fname);
   end

   s = struct('config',rows(4,9), 'h_digit',rows(6,2));
   s.meta   = read_meta(rows, fmt);
   [s.meta.status, s.meta.reason] = read_status(comments{1});
   if (isempty(s.meta.status) && any(s.config==[0 4]) && s.meta.ipatch>0)
      % the established program does not mirror the contact reference of a left wheel with its elements
      s.meta.spinyo = -s.meta.spinyo;
   end
   s.mater  = read_material(rows(5,:));
   s.fric   = read_friction(rows(6,:));
   s.kincns = struct('t_digit',rows(5,1), 'chi',rows(4,7), 'dq',rows(4,8), 'veloc',rows(6,3));
   s.mx = rows(4,1);   s.my = rows(4,2);
   s.xl = rows(4,3);   s.yl = rows(4,4);
   s.dx = rows(4,5);   s.dy = rows(4,6);
   s.d_digit  = rows(4,10);
   s.x_offset = [];    s.y_offset = [];
   s.x = s.xl + ((1:s.mx)-0.5) * s.dx;
   s.y = s.yl + ((1:s.my)-0.5) * s.dy;
   s.meta.icase = icase;

   s = read_elements(s, elements, comments{min(7,numel(comments))}, fname);

end % function read_mat_file

%------------------------------------------------------------------------------------------------------

function [ meta ] = read_meta( rows, fmt )
% Positions: of the case and the rail in row 1, of the wheel in row 2, of the contact in row 3

   meta = named(rows(1,1:7), {'tim','s_ws','th_ws','y_r','z_r','roll_r','rnom_rol'});
   meta = named(rows(2,1:6), {'x_w','y_w','z_w','roll_w','yaw_w','rnom_whl'}, meta);
   meta = named(rows(3,1:11), {'xcp_r','ycp_r','zcp_r','deltcp_r','xcp_w','ycp_w','zcp_w', ...
                'npatch','ipatch','spinxo','spinyo'}, meta);
   meta.ynom_whl = rows(4,11);
   meta.format   = fmt;

end % function read_meta

%------------------------------------------------------------------------------------------------------

function [ status, reason ] = read_status( line )
% Status of the case, after the names in the first line; '' in files of other programs

   status = '';
   reason = '';
   found  = regexp(line, 'STATUS: ([a-z ]*[a-z])( \(\w+\): (.*))?$', 'tokens', 'once');
   if (~isempty(found))
      status = found{1};
   end
   if (numel(found)>1)
      reason = regexprep(found{2}, '^ \((\w+)\): ', '$1: ');
   end

end % function read_status

%------------------------------------------------------------------------------------------------------

function [ mater ] = read_material( row )
% Material model and parameters, row 5

   m = row(2);
   mater = struct('m_digit',m, 'gg',row(3:4), 'poiss',row(5:6));
   if (m==1)
      mater.fg = row(7:8);
      mater.tc = row(9:10);
   elseif (m==4)
      mater = named(row(7:10), {'gg3','laythk','tau_c0','k_tau'}, mater);
   elseif (m>=2)
      % POISS(2) is not in the file
      mater.poiss = row([5 5]);
      mater.flx   = row(6:8);
      mater = named(row(9:11), {'k0_mf','alfamf','betamf'}, mater);
   end
   mater = add_combined(mater);

end % function read_material

%------------------------------------------------------------------------------------------------------

function [ fric ] = read_friction( row )
% Friction law and parameters, row 6

   law = row(1);
   fric = struct('frclaw',law);
   if (law==0)
      fric = named(row(4:5), {'fstat','fkin'}, fric);
   elseif (law==6)
      fric = named(row(4:9), {'fref','tref','dfheat','dtheat','memdst','mem_s0'}, fric);
   elseif (any(law==[2 3 4]))
      % coefficients are named after the law: linear, rational or exponential
      coef = {'flin','frat','fexp'};
      c = coef{law-1};
      fric = named(row(4:10), {'fkin',[c '1'],'sabsh1',[c '2'],'sabsh2','memdst','mem_s0'}, fric);
   end
   fric = add_static(fric);

end % function read_friction

%------------------------------------------------------------------------------------------------------

function [ s ] = read_elements( s, table, heading, fname )
% Values of elements as (my,mx) arrays

   plastic = has_plasticity(s.mater);
   heat    = (s.h_digit>0);
   names = {'h','mu','pn','px','py','un','ux','uy','slip'};
   if (plastic)
      names = [names, {'taucrt','uplsx','uplsy'}];
   end
   if (heat)
      names = [names, {'temp1','temp2'}];
   end
   % if there are columns that this script does not know, names are read from the heading
   heading = lower(regexp(heading, '\S+', 'match'));
   if (~isempty(table) && size(table,2)>numel(names)+2 && numel(heading)>=size(table,2))
      names = regexprep(heading(end-size(table,2)+3:end), '^(srel|shft)$', 'slip');
   end
   if (~isempty(table) && size(table,2)~=numel(names)+2)
      error('loadcase: "%s" has %d columns; %d were expected.', fname, size(table,2), numel(names)+2);
   end
   number = [];
   if (~isempty(table))
      number = table(:,1);
   end
   if (any(number~=fix(number)) || numel(unique(number))~=numel(number) || ~all(isfinite(table(:))))
      error('loadcase: "%s" is damaged: element numbers that are not integers or are repeated, or values that are not finite.', ...
            fname);
   end
   if (~isempty(table) && any(table(:,2)~=fix(table(:,2)) | table(:,2)<0 | table(:,2)>3))
      error('loadcase: "%s" is damaged: an element state is not 0, 1, 2 or 3.', fname);
   end
   if (any(number<1 | number>s.mx*s.my))
      error('loadcase: "%s" has an element that is not in the grid of %d x %d.', fname, s.mx, s.my);
   end

   s.eldiv = zeros(s.my, s.mx);
   known_outside = {'pn','px','py'};
   v = struct();
   for i = 1 : numel(names)
      fill = NaN;
      if (any(strcmp(names{i}, known_outside)))
         fill = 0;
      end
      v.(names{i}) = to_grid(number, table, i+2, fill, s);
   end
   s.eldiv = to_grid(number, table, 2, 0, s);

   % slip is stored per unit of rolled distance, in shifts dq = 1
   order = {'h','mu','pn','px','py','un','ux','uy'};
   for i = 1 : numel(order)
      s.(order{i}) = v.(order{i});
   end
   s.srel = v.slip;
   s.shft = v.slip;
   if (s.kincns.t_digit>=2)
      s.shft = v.slip * s.kincns.dq;
   end
   more = setdiff(names, [order, {'slip'}]);
   for i = 1 : numel(more)
      s.(more{i}) = v.(more{i});
   end

   s = add_bound(s);

end % function read_elements

%------------------------------------------------------------------------------------------------------

function [ f ] = to_grid( number, table, column, fill, s )
% One column of the table, element numbers running along x first

   f = fill * ones(s.mx, s.my);
   if (~isempty(number))
      f(number) = table(:,column);
   end
   f = f';

end % function to_grid

%------------------------------------------------------------------------------------------------------

function [ s ] = named( values, names, s )
% Add values to a struct under the given names

   if (nargin<3)
      s = struct();
   end
   for i = 1 : numel(names)
      s.(names{i}) = values(i);
   end

end % function named
