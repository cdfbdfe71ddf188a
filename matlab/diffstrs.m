function [ dif ] = diffstrs( blk1, blk2 )
% DIFFSTRS  Difference blk1 - blk2 of stresses below the surface at the same points.
%
%   dif = diffstrs( blk1, blk2 )
%
%   blk1, blk2   structs of LOADSTRS
%   dif          struct of the same kind. Displacements, mean stress and components of the tensor are
%                differences. sigvm, sigtr and the principal stresses are computed from the difference of the
%                tensors if both files have them; otherwise sigvm is the difference of the two values.
%
% See also: loadstrs, plotstrs, diffcase.

   if (blk1.nx~=blk2.nx || blk1.ny~=blk2.ny || blk1.nz~=blk2.nz)
      error('diffstrs: the blocks have %d x %d x %d and %d x %d x %d points.', blk1.nx, blk1.ny, blk1.nz, ...
            blk2.nx, blk2.ny, blk2.nz);
   end
   apart = max(abs([blk1.x-blk2.x; blk1.y-blk2.y; blk1.z-blk2.z]));
   extent = max(abs([blk1.x; blk1.y; blk1.z]));
   if (apart > 1e-5*extent)
      warning('diffstrs: the points of the two blocks are up to %g mm apart.', apart);
   end

   dif = struct('nx',blk1.nx, 'ny',blk1.ny, 'nz',blk1.nz, 'npoints',blk1.npoints);
   dif.x = blk1.x;   dif.y = blk1.y;   dif.z = blk1.z;
   fields = {'ux','uy','uz','sighyd','sigvm','sigxx','sigxy','sigxz','sigyy','sigyz','sigzz'};
   for i = 1 : numel(fields)
      f = fields{i};
      if (isfield(blk1,f) && isfield(blk2,f))
         dif.(f) = blk1.(f) - blk2.(f);
      end
   end
   if (isfield(dif,'sigxx'))
      dif = add_principal(dif);
      dif.sigvm = sqrt(((dif.sigma1-dif.sigma2).^2 + (dif.sigma2-dif.sigma3).^2 + (dif.sigma3-dif.sigma1).^2) / 2);
   end

end % function diffstrs
