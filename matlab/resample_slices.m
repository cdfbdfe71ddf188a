function [ slcs, ierror ] = resample_slices( slcs, ds, varargin )
% RESAMPLE_SLICES  Compute corresponding points on all slices of a varying profile.
%
%   slcs = resample_slices( slcs, ds )
%
%   slcs   struct of READ_SLICES
%   ds     largest distance of points across the profile [mm] (default 0.5); further arguments are ignored
%   ierror 0: problems are reported as errors
%
% The parts between features are divided into the same number of equal steps in all slices. Added fields:
%
%   vy, vz   nslc x npnt arrays of coordinates [mm]; NaN where a slice does not have a part
%   xsurf, ysurf, zsurf   positions u of the slices in an array of the same size, and vy, vz, under the names of other scripts
%
% Lines through points with the same number run along the surface. At a position u between slices,
% interp1(slcs.u, slcs.vy, u) and interp1(slcs.u, slcs.vz, u) are the points of a section.
%
% See also: read_slices, plot3d.

   if (nargin<2 || isempty(ds))
      ds = 0.5;
   end
   ierror = 0;
   nfeat = size(slcs.s_feat, 2);
   s     = slcs.s_feat;
   for i = 1 : slcs.nslc
      present = find(s(i,:)>=0);
      if (numel(present)<2)
         error('resample_slices: slice %d has fewer than two features.', i);
      end
      s(i,present(end)) = min(s(i,present(end)), slcs.prof{i}.ProfileS(end));
      if (any(diff(s(i,present))<=1e-6))
         error('resample_slices: the features of slice %d do not increase along the profile, which is %g mm long.', ...
               i, slcs.prof{i}.ProfileS(end));
      end
   end
   s(s<0) = NaN;

   slcs.vy = [];
   slcs.vz = [];
   for part = 1 : nfeat-1
      len   = s(:,part+1) - s(:,part);
      nstep = 1 + fix(max([0; len(~isnan(len))]) / ds);
      step  = (0:nstep) / nstep;
      if (part<nfeat-1)
         step = step(1:end-1);
      end
      at = s(:,part)*ones(size(step)) + len*step;
      % where a part ends at a part that is missing
      at(:,1) = s(:,part);
      vy = NaN(size(at));
      vz = NaN(size(at));
      for i = 1 : slcs.nslc
         p = slcs.prof{i};
         vy(i,:) = interp1(p.ProfileS, p.ProfileY, at(i,:), 'linear', 'extrap');
         vz(i,:) = interp1(p.ProfileS, p.ProfileZ, at(i,:), 'linear', 'extrap');
      end
      slcs.vy = [slcs.vy, vy];
      slcs.vz = [slcs.vz, vz];
   end
   % names of other scripts
   slcs.xsurf = repmat(slcs.u(:), 1, size(slcs.vy,2));
   slcs.ysurf = slcs.vy;
   slcs.zsurf = slcs.vz;

end % function resample_slices
