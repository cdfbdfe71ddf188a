function [ values ] = cntc_getprofilevalues( ire, itask, iparam, rparam )
% CNTC_GETPROFILEVALUES  Get a profile as used by the library.
%
%   values = cntc_getprofilevalues( ire, itask, iparam, rparam )
%
%   ire      result element of a wheel-rail problem (default 1)
%   itask    -1: state, 0 or an error code, and its detail
%            0: number of points
%            1, 2: n x 2 array of y, z in profile or track coordinates [mm]
%            3: for rails y, z of the highest point, offsets y, z, y, z of the gauge point [L]
%            4, 5: arc length [mm], inclination [A] of n points
%            6, 7, 8: n x 3 array of x, y, z along a line with constant u, v or y on a varying profile [mm]; NaN
%                     where there is no surface
%            9: writes the surface of a varying profile to dump_spl2d.m
%   iparam   itype: 0 rail, 1 wheel; isampl: -1 points of the input, 0 of the spline (default), 1 equal distances,
%            n > 1 n steps between points of the spline
%   rparam   distance of points [mm] (default 1), and for varying profiles: position [mm] or [rad], first and last
%            position on the line

   if (nargin<1)
      ire = [];
   end
   ire = cntc_ids(ire);
   if (nargin<3 || isempty(iparam))
      iparam = [0 0];
   end
   if (nargin<4 || isempty(rparam))
      rparam = 1.0;
   end
   if (any(itask==[-1 3 9]))
      n = 6;
   elseif (any(itask==[6 7 8]))
      n = cntc_call('cntc_getprofilevalues', ire, itask, numel(iparam), iparam, numel(rparam), rparam, 1, 0);
   else
      n = cntc_call('cntc_getprofilevalues', ire, 0, numel(iparam), iparam, numel(rparam), rparam, 1, 0);
   end
   cntc_report_errors('cntc_getprofilevalues', ire, -1);
   if (itask==0 && n>0)
      values = n;
      return
   end
   width = 1;
   if (any(itask==[1 2]))
      width = 2;
   elseif (any(itask==[6 7 8]))
      width = 3;
   end
   values = [];
   if (n<=0)
      warning('cntc_getprofilevalues: there is no profile, the library returned %d.', n);
      return
   end
   v = cntc_call('cntc_getprofilevalues', ire, itask, numel(iparam), iparam, numel(rparam), rparam, n*width, zeros(n,width));
   cntc_report_errors('cntc_getprofilevalues', ire, -1);
   if (itask==9)
      return
   elseif (itask==-1)
      v = v(1:2);
   elseif (width==3)
      % values by which the library marks positions without surface
      nothing = any(v(:,1)>98e9, 2) | any(v(:,2:3)>998, 2);
      v(nothing,:) = NaN;
   end
   values = v;

end % function cntc_getprofilevalues
