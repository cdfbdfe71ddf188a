function [ dst_max, l, n ] = plot_update( prf1, prf2, fac, plot_n, use_angl2, norm_dist, varargin )
% PLOT_UPDATE  Two profiles and their magnified difference: wear, or the effect of smoothing.
%
%   [dst_max, l, n] = plot_update( prf1, prf2, fac, plot_n, use_angl2, norm_dist, add_plot )
%   [dst_max, l, n] = plot_update( prf1, prf2, fac, plot_n, use_angl2, norm_dist, show_angl, add_plot, force_spline )
%
%   prf1, prf2   structs of READ_PROFILE. With equal numbers of points they are compared point by point, otherwise each point of
%                prf2 with the nearest point of the curve through prf1
%   fac          magnification; negative (default): 1, 2 or 5 times a power of ten such that the largest difference
%                is at most a tenth of the width
%   plot_n       a line at every plot_n-th point; 0 (default): none
%   use_angl2    1: normals of prf2; 0 (default): of prf1
%   norm_dist    1 (default): difference along the normal; 0: both components; -1: along the tangent, drawn along the normal
%   add_plot     1: add to the current figure; 0 (default): clear it
%   force_spline 1: nearest point of the curve also with equal numbers of points; show_angl is accepted and ignored
%
%   dst_max      largest difference as selected by norm_dist [mm]
%   l            lines: first profile, second profile, magnified difference
%   n            lines at points
%
% See also: read_profile, smooth_profile.

   if (nargin<3 || isempty(fac)), fac = -1; end
   if (nargin<4 || isempty(plot_n)), plot_n = 0; end
   if (nargin<5 || isempty(use_angl2)), use_angl2 = 0; end
   if (nargin<6 || isempty(norm_dist)), norm_dist = 1; end
   last = {[], [], []};
   last((nargin==7)+(1:numel(varargin))) = varargin;
   add_plot     = isequal(logical(last{2}), true);
   force_spline = isequal(logical(last{3}), true);
   y2 = prf2.ProfileY(:);
   z2 = prf2.ProfileZ(:);
   [y1, z1] = opposite(prf1.ProfileY(:), prf1.ProfileZ(:), y2, z2, force_spline);

   [ty, tz] = tangents(y1, z1);
   if (use_angl2)
      [ty, tz] = tangents(y2, z2);
   end
   ny = -tz;
   nz =  ty;
   across = (y2-y1).*ny + (z2-z1).*nz;
   along  = (y2-y1).*ty + (z2-z1).*tz;
   if (norm_dist>0)
      parts = [across, across.*ny, across.*nz];
   elseif (norm_dist==0)
      parts = [hypot(across, along), y2-y1, z2-z1];
   else
      parts = [along, along.*ny, along.*nz];
   end
   [dst_max, k] = max(abs(parts(:,1)));
   if (fac<0)
      fac = round_down(0.1*(max(y2)-min(y2)) / max(dst_max, eps));
   end

   if (~add_plot)
      clf
   end
   hold on
   l(1) = plot(prf1.ProfileY, prf1.ProfileZ, '-', 'color',matlab_color(1));
   l(2) = plot(y2, z2, '--', 'color',matlab_color(2));
   y = y1 + fac*parts(:,2);
   z = z1 + fac*parts(:,3);
   l(3) = plot(y, z, '-', 'color',matlab_color(3));
   plot(y(k), z(k), '*', 'color',matlab_color(3));
   n = [];
   for i = 1 : plot_n : plot_n*numel(y1)
      if (i<=numel(y1) && fac*abs(parts(i,1))>0.01)
         n(end+1) = plot([y1(i) y(i)], [z1(i) z(i)], '-', 'color',matlab_color(6));
      end
   end
   set(gca, 'ydir','reverse');
   axis equal
   grid on
   xlabel('y [mm]');
   ylabel('z [mm]');
   text(0.95, 0.93, sprintf('%g x', fac), 'units','normalized', 'horizontalalignment','right');

end % function plot_update

%------------------------------------------------------------------------------------------------------

function [ fac ] = round_down( fac )
% 1, 2 or 5 times a power of ten

   unit = 10^floor(log10(fac));
   step = [1 2 5];
   fac  = unit * max(step(step<=fac/unit*(1+eps(8))));

end % function round_down

%------------------------------------------------------------------------------------------------------

function [ y, z ] = opposite( y1, z1, y2, z2, force_spline )
% Points of the first profile that correspond to those of the second

   y = y1;
   z = z1;
   if (numel(y1)==numel(y2) && ~force_spline)
      return
   end
   y = zeros(size(y2));
   z = y;
   dy = diff(y1);
   dz = diff(z1);
   for i = 1 : numel(y2)
      part = ((y2(i)-y1(1:end-1)).*dy + (z2(i)-z1(1:end-1)).*dz) ./ (dy.^2 + dz.^2);
      part = min(max(part, 0), 1);
      [~, k] = min(hypot(y1(1:end-1)+part.*dy-y2(i), z1(1:end-1)+part.*dz-z2(i)));
      y(i) = y1(k) + part(k)*dy(k);
      z(i) = z1(k) + part(k)*dz(k);
   end

end % function opposite

%------------------------------------------------------------------------------------------------------

function [ ty, tz ] = tangents( y, z )
% Directions at the points: means of those of the adjacent chords

   d = hypot(diff(y), diff(z));
   ty = diff(y)./d;
   tz = diff(z)./d;
   ty = [ty(1); (ty(1:end-1)+ty(2:end))/2; ty(end)];
   tz = [tz(1); (tz(1:end-1)+tz(2:end))/2; tz(end)];
   d = hypot(ty, tz);
   ty = ty./d;
   tz = tz./d;

end % function tangents
