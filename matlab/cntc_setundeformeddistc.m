function cntc_setundeformeddistc( ire, icp, ibase, prmudf )
% CNTC_SETUNDEFORMEDDISTC  Set the undeformed distance (module 3), after cntc_setpotcontact.
%
%   cntc_setundeformeddistc( ire, icp, ibase, prmudf )
%
%   ire, icp   result element and contact patch or problem (default 1, 1)
%   ibase    prmudf
%   1        b1 ... b6 of b1 x2 + b2 xy + b3 y2 + b4 x + b5 y + b6
%   2        nn, xm, rm, y1, dy1, then nn heights [L]   circular along x with a profile across
%   3        b1 ... b8 of b1 sin(b2(x-b3)) - b4 sin(b5(x-b6)) + x2/b7 + y2/b8
%   9        distance of each element [L], as (my,mx) array or along x first

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_setundeformeddistc');
   if (ibase==9 && min(size(prmudf))>1)
      prmudf = prmudf';
   end
   cntc_call('cntc_setundeformeddistc', ire, icp, ibase, numel(prmudf), prmudf(:));
   cntc_report_errors('cntc_setundeformeddistc', ire, icp);

end % function cntc_setundeformeddistc
