function [ p, spl ] = smooth_profile( p, l_filt, lambda, ds_sampl, ikinks, iaccel, use_wgt, use_bspline, ds_bspl, idebug )
% SMOOTH_PROFILE  Smooth a wheel or rail profile by a cubic smoothing spline.
%
%   [p, spl] = smooth_profile( p, l_filt, lambda, ds_sampl, ikinks, iaccel, use_wgt )
%
%   p         struct of READ_PROFILE, or an array of y and z [mm], one row per point
%   l_filt    wavelength whose amplitude is halved [mm]: longer waves are kept, shorter ones removed; or [] and
%   lambda    weight of smoothness, see MAKE_SPLINE [mm^3]; default 0: interpolation of all points
%   ds_sampl  distance of the new points along the profile [mm]; [] (default): the positions of the points of p
%   ikinks    numbers of points with a kink; -1 (default): those where the direction turns by more than 30 degrees; []: none
%   iaccel    numbers of points at which the curvature may jump; [] or -1 (default): none; they are not detected
%   use_wgt   1 (default): points are weighted by the length of profile around them; 0: equal weights
%   use_bspline, ds_bspl   see MAKE_SPLINE
%   idebug    accepted for compatibility and ignored
%
%   p         as p, with the new points and ProfileS;  spl  struct of MAKE_SPLINE
%
% With weights w = ds the spline has the response 1/(1 + lambda (2 pi/L)^4) to waves of length L, so l_filt is lambda = (l_filt/(2
% pi))^4 [mm^4].
%
% See also: make_spline, read_profile.

   if (nargin<2), l_filt = []; end
   if (nargin<3), lambda = []; end
   if (nargin<4), ds_sampl = []; end
   if (nargin<5), ikinks = -1; end
   if (nargin<7 || isempty(use_wgt)), use_wgt = 1; end
   if (nargin<6 || isequal(iaccel, -1)), iaccel = []; end
   if (nargin<8), use_bspline = []; end
   if (nargin<9), ds_bspl = []; end
   if (~isempty(l_filt) && l_filt>0 && ~isempty(lambda) && lambda>0)
      error('smooth_profile: give either l_filt or lambda.');
   end
   yz = profile_points(p, 'smooth_profile');
   s  = chord_sums(yz(:,1), yz(:,2));
   keep = [true; diff(s)>1e-9*s(end)];
   yz = yz(keep,:);
   s  = s(keep);
   if (numel(s)<2)
      error('smooth_profile: a profile needs at least two points.');
   end
   ds = diff(s);
   if (isequal(ikinks, -1))
      angle  = atan2(diff(yz(:,2)), diff(yz(:,1)));
      turn   = abs(mod(diff(angle)+pi, 2*pi)-pi);
      ikinks = 1 + find(turn > 30*pi/180);
   end
   wgt = ones(size(s));
   if (use_wgt>0)
      wgt = ([ds; 0] + [0; ds])/2;
   end
   if (~isempty(l_filt) && l_filt>0)
      lambda = (l_filt/(2*pi))^4;
      if (use_wgt<=0)
         lambda = lambda / mean(ds);
      end
   end
   spl = make_spline(s, yz(:,1), yz(:,2), lambda, wgt, ikinks, iaccel, use_bspline, ds_bspl);
   at = s;
   if (~isempty(ds_sampl) && ds_sampl>0)
      at = unique([(s(1) : ds_sampl : s(end))'; s(end)]);
   end
   [~, y, z] = eval_spline(spl, at);
   if (isstruct(p))
      p.ProfileY = y;
      p.ProfileZ = z;
      p.ProfileS = chord_sums(y, z);
   else
      p = [y, z];
   end

end % function smooth_profile
