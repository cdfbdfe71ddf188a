function [ sol ] = cntc_getcpresults( ire, icp )
% CNTC_GETCPRESULTS  Get all results of one contact patch in the form of loadcase, for plot2d and plot3d.
%
%   sol = cntc_getcpresults( ire, icp )
%
%   ire, icp   result element and contact patch or problem (default 1, 1)
%   sol        struct like that of loadcase. For wheel and rail it includes the profiles prr and prw, so that
%              plot3d( sol, opt ) needs no other profiles.
%
% Results are in CONTACT units (mm, N, tractions on the rail), whatever the units of the problem.
%
% See also: loadcase, plot3d, cntc_gettractions.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getcpresults');
   CNTC = cntc_getmagicnumbers();
   % a routine for wheel and rail leaves its result unchanged in basic contact
   npatch = cntc_call('cntc_getnumcontactpatches', ire, -999);
   wheel_rail = (npatch~=-999);
   whole = icp;
   if (wheel_rail)
      whole = -1;
      if (icp>npatch)
         error('cntc_getcpresults: there are %d contact patches, number %d was requested.', npatch, icp);
      end
   elseif (cntc_library('mex'))
      % its error message is expected and is discarded
      cntc_mex('error', ire, -1);
      cntc_mex('error', 0, -1);
   end

   units = cntc_getflags(ire, whole, CNTC.if_units);
   cntc_setflags(ire, whole, CNTC.if_units, CNTC.un_cntc);
   restored = onCleanup(@() cntc_setflags(ire, whole, CNTC.if_units, units));
   flags = cntc_getflags(ire, whole, [CNTC.ic_config, CNTC.ic_tang, CNTC.ic_discns, CNTC.ic_mater, CNTC.ic_heat]);
   p     = cntc_getparameters(ire, icp, 1);
   sol   = struct('config',0, 'h_digit',flags(5));
   sol.meta   = struct('spinxo',p.spinxo, 'spinyo',p.spinyo, 'npatch',0, 'ipatch',0);
   sol.mater  = struct('m_digit',flags(4), 'tau_c0',p.tau_c0);
   sol.kincns = struct('t_digit',flags(2), 'chi',p.chi, 'dq',p.dq, 'veloc',p.veloc);
   [sol.mx, sol.my, xc1, yc1, sol.dx, sol.dy] = cntc_getpotcontact(ire, icp);
   if (sol.mx*sol.my<=0)
      error('cntc_getcpresults: result element %d, patch %d has no results yet.', ire, icp);
   end
   sol.xl = xc1 - sol.dx/2;
   sol.yl = yc1 - sol.dy/2;
   sol.d_digit = flags(3);
   sol.x_offset = [];   sol.y_offset = [];
   sol.x = xc1 + (0:sol.mx-1)*sol.dx;
   sol.y = yc1 + (0:sol.my-1)*sol.dy;
   if (wheel_rail)
      sol.config = flags(1);
      % on rollers the first coordinate of the wheelset is not a position along a track
      sol.meta   = add_places(sol.meta, ire, icp, npatch, sol.config<4);
      sol.prr    = get_profile(ire, 0);
      sol.prw    = get_profile(ire, 1);
   end
   sol = add_fields(sol, ire, icp, CNTC);

end % function cntc_getcpresults

%------------------------------------------------------------------------------------------------------

function [ meta ] = add_places( meta, ire, icp, npatch, on_track )
% Positions of wheelset, wheel, rail and contact

   ws  = cntc_getwheelsetposition(ire);
   loc = cntc_getcontactlocation(ire, icp);
   meta.s_ws  = ws(1)*on_track;    meta.th_ws = ws(6);
   meta.xcp_r = loc(5);   meta.ycp_r = loc(6);   meta.zcp_r = loc(7);   meta.deltcp_r = loc(9);
   meta.xcp_w = loc(10);  meta.ycp_w = loc(11);  meta.zcp_w = loc(12);
   meta.x_w   = loc(21);  meta.y_w   = loc(22);  meta.z_w   = loc(23);
   meta.roll_w = loc(24); meta.yaw_w = loc(25);
   meta.y_r   = loc(26);  meta.z_r   = loc(27);  meta.roll_r = loc(28);
   radii = cntc_getparameters(ire, icp, 4);
   meta.rnom_whl = radii.nomradw;
   meta.rnom_rol = radii.nomradr;
   meta.npatch = npatch;
   meta.ipatch = icp;

end % function add_places

%------------------------------------------------------------------------------------------------------

function [ p ] = get_profile( ire, is_wheel )

   yz = cntc_getprofilevalues(ire, 1, [is_wheel 0]);
   p  = struct('ProfileY',yz(:,1), 'ProfileZ',yz(:,2), 'is_wheel',is_wheel);
   p.ProfileS = cntc_getprofilevalues(ire, 4, [is_wheel 0]);

end % function get_profile

%------------------------------------------------------------------------------------------------------

function [ sol ] = add_fields( sol, ire, icp, CNTC )

   sol.eldiv = cntc_getelementdivision(ire, icp);
   sol.h     = cntc_getfielddata(ire, icp, CNTC.fld_h);
   sol.mu    = cntc_getfielddata(ire, icp, CNTC.fld_mu);
   [sol.pn, sol.px, sol.py] = cntc_gettractions(ire, icp);
   [sol.un, sol.ux, sol.uy] = cntc_getdisplacements(ire, icp);
   [sx, sy] = cntc_getmicroslip(ire, icp);
   sol.srel = hypot(sx, sy);
   sol.shft = sol.srel;
   if (sol.kincns.t_digit>=2)
      sol.shft = sol.srel * sol.kincns.dq;
   end
   sol.trcbnd = sol.mu .* sol.pn;
   if (has_plasticity(sol.mater))
      sol.taucrt = cntc_getfielddata(ire, icp, CNTC.fld_taucrt);
      sol.uplsx  = cntc_getfielddata(ire, icp, CNTC.fld_uplsx);
      sol.uplsy  = cntc_getfielddata(ire, icp, CNTC.fld_uplsy);
      sol.trcbnd = min(sol.trcbnd, sol.taucrt);
   end
   if (sol.h_digit>0)
      sol.temp1 = cntc_getfielddata(ire, icp, CNTC.fld_temp1);
      sol.temp2 = cntc_getfielddata(ire, icp, CNTC.fld_temp2);
   end

end % function add_fields
