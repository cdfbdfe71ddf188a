function [ subs ] = collect_subs( out, npatch )
% COLLECT_SUBS  Largest stresses below the surface in an .out file, and their positions.
%
%   out      struct of READ_OUT
%   npatch   rows of the results: 1, or the largest number of contact patches
%
%   subs     [] if there are none, else a struct of arrays (npatch, ncase, nblock):
%            sighyd, sigvm, sigtr, sigma1, sigma3, sigxx, sigyy, sigzz [N/mm2]; each is a struct
%            with val and the position x, y, z [mm]

   subs = [];
   found = find_text(out, ' AT (X,Y,Z) = (');
   if (isempty(found))
      return
   end
   blocks = find_text(out, 'SUBSURFACE STRESSES BLOCK');
   names = {'sighyd','sigvm','sigtr','sigma1','sigma3','sigxx','sigyy','sigzz'};
   nblock = 1;
   for k = blocks
      nblock = max(nblock, sscanf(out.lines{k}, ' SUBSURFACE STRESSES BLOCK %d', 1));
      if (nblock>1000)
         error('line %d has no block number', k);
      end
   end
   for n = 1 : numel(names)
      for part = {'val','x','y','z'}
         subs.(names{n}).(part{1}) = NaN(npatch, out.ncase, nblock);
      end
   end

   for k = found
      name = regexp(out.lines{k}, 'SIG\w+', 'match', 'once');
      v    = sscanf(strrep(out.lines{k}(16:end), ',', ' '), '= %f AT (X Y Z) = ( %f %f %f', 4);
      head = blocks(find(blocks<k, 1, 'last'));
      b    = sscanf(out.lines{head}, ' SUBSURFACE STRESSES BLOCK %d', 1);
      i    = max(1, out.patch_of(k));
      j    = out.case_of(k);
      name = lower(name);
      subs.(name).val(i,j,b) = v(1);
      subs.(name).x(i,j,b) = v(2);
      subs.(name).y(i,j,b) = v(3);
      subs.(name).z(i,j,b) = v(4);
   end

end % function collect_subs
