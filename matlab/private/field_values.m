function [ f ] = field_values( sol, field )
% FIELD_VALUES  Values of one of the quantities of PLOT3D.
%
%   f.val      (my,mx) array, with exterior elements as stored
%   f.vx, vy   arrows, [] if there are none
%   f.colors   are the values shown by colours? Not for 'ptvec'
%   f.title, f.unit   texts for the picture
%   f.name     the quantity after 'default' has been replaced

   if (strcmp(field, 'default'))
      field = 'ptabs+vec';
      if (sol.kincns.t_digit==0)
         field = 'pn';
      end
   end
   f = struct('name',field, 'val',[], 'vx',[], 'vy',[], 'colors',true, 'title','', 'unit','');
   ptabs   = hypot(sol.px, sol.py);
   rolling = (sol.kincns.t_digit>=2);

   switch (field)
      case {'eldiv','eldiv_spy','eldiv_contour'}
         f = plain(f, sol.eldiv, 'Element division', '');
      case 'h'
         f = plain(f, sol.h, 'Undeformed distance h', 'mm');
      case 'mu'
         f = plain(f, sol.mu, 'Coefficient of friction \mu', '-');
      case 'taucrt'
         f = plain(f, stored(sol, field), 'Yield limit \tau_{crit}', 'N/mm^2');
      case {'pn','px','py'}
         f = plain(f, sol.(field), ['Traction p_' field(2)], 'N/mm^2');
      case 'ptabs'
         f = plain(f, ptabs, 'Magnitude of tangential tractions', 'N/mm^2');
      case 'ptarg'
         f = plain(f, atan2(sol.py,sol.px)*180/pi, 'Direction of tangential tractions', 'deg');
      case 'ptvec'
         f = arrows(plain(f, ptabs, 'Tangential tractions', 'N/mm^2'), sol.px, sol.py);
         f.colors = false;
      case 'ptabs+vec'
         f = arrows(plain(f, ptabs, 'Tangential tractions', 'N/mm^2'), sol.px, sol.py);
      case {'un','ux','uy'}
         f = plain(f, sol.(field), ['Displacement difference u_' field(2)], 'mm');
      case 'utabs+vec'
         f = arrows(plain(f, hypot(sol.ux,sol.uy), 'Tangential displacement differences', 'mm'), sol.ux, sol.uy);
      case {'uplsx','uplsy'}
         f = plain(f, stored(sol, field), ['Plastic displacement u_{pl,' field(5) '}'], 'mm');
      case 'upls+vec'
         x = stored(sol, 'uplsx');
         y = stored(sol, 'uplsy');
         f = arrows(plain(f, hypot(x,y), 'Plastic displacements', 'mm'), x, y);
      case {'sx','sy'}
         s = sol.shft;
         f.unit = 'mm';
         if (rolling)
            s = sol.srel;
            f.unit = '-';
         end
         [vx, vy] = along_slip(sol, s, ptabs);
         if (strcmp(field,'sx'))
            f = plain(f, vx, 'Slip s_x', f.unit);
         else
            f = plain(f, vy, 'Slip s_y', f.unit);
         end
      case 'shft'
         f = plain(f, sol.shft, 'Slip distance', 'mm');
      case 'shft+vec'
         [vx, vy] = along_slip(sol, sol.shft, ptabs);
         f = arrows(plain(f, sol.shft, 'Slip distance', 'mm'), vx, vy);
      case {'srel','srel+vec','sabs','sabs+vec'}
         if (~rolling)
            error('plot3d: field ''%s'' exists in rolling (T = 2 or 3); use ''shft'' in shifts.', field);
         end
         s = sol.srel;
         f.title = 'Relative slip velocity';
         f.unit  = '-';
         if (field(2)=='a')
            s = s * sol.kincns.veloc;
            f.title = 'Slip velocity';
            f.unit  = 'mm/s';
         end
         f = plain(f, s, f.title, f.unit);
         if (numel(field)>4)
            [vx, vy] = along_slip(sol, s, ptabs);
            f = arrows(f, vx, vy);
         end
      case 'fricdens'
         if (rolling)
            f = plain(f, sol.srel .* ptabs * sol.kincns.veloc/1000, 'Frictional power density', 'W/mm^2');
         else
            f = plain(f, sol.shft .* ptabs / 1000, 'Frictional work density', 'J/mm^2');
         end
      case {'temp1','temp2'}
         f = plain(f, stored(sol, field), ['Temperature of body ' field(5)], '^oC');
      otherwise
         if (isfield(sol, field) && isequal(size(sol.(field)), size(sol.pn)))
            f = plain(f, sol.(field), field, '');
            return
         end
         error('plot3d: there is no field ''%s''; help plot3d lists them.', field);
   end

end % function field_values

%------------------------------------------------------------------------------------------------------

function [ f ] = plain( f, val, title, unit )

   f.val   = val;
   f.title = title;
   f.unit  = unit;

end % function plain

%------------------------------------------------------------------------------------------------------

function [ f ] = arrows( f, vx, vy )

   f.vx = vx;
   f.vy = vy;

end % function arrows

%------------------------------------------------------------------------------------------------------

function [ val ] = stored( sol, field )

   if (~isfield(sol, field))
      error('plot3d: this case has no field ''%s''.', field);
   end
   val = sol.(field);

end % function stored

%------------------------------------------------------------------------------------------------------

function [ sx, sy ] = along_slip( sol, s, ptabs )
% Slip of body 1 against body 2, opposite to the traction on body 1

   ptabs(ptabs==0) = Inf;
   sx = -s .* sol.px ./ ptabs;
   sy = -s .* sol.py ./ ptabs;

end % function along_slip
