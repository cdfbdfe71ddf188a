function cntc_setprofileinputvalues( ire, values, iparam, rparam )
% CNTC_SETPROFILEINPUTVALUES  Set the profile of wheel or rail by its points.
%
%   cntc_setprofileinputvalues( ire, values, iparam, rparam )
%
%   ire      result element of a wheel-rail problem (default 1)
%   values   n x 2 or 2 x n array of y and z, or y1, z1, y2, ...
%   iparam   itype, unused, mirrory, mirrorz, errhndl, ismooth; itype: 0 rail, 1 wheel, -1 by the extension
%   rparam   factor to mm, smoothing [-] or [mm], maxomit [-], zigthrs, kinkhigh, kinklow [rad], kinkwid [L]
%   Default: iparam = 0, a rail; rparam = [-1 0], which means values in [L].
%
% See also: cntc_setprofileinputfname.

   if (nargin<1)
      ire = [];
   end
   ire = cntc_ids(ire);
   if (nargin<3 || isempty(iparam))
      iparam = 0;
   end
   if (nargin<4 || isempty(rparam))
      rparam = [-1 0];
   end
   if (size(values,2)==2)
      values = values';
   end
   cntc_call('cntc_setprofileinputvalues', ire, numel(values)/2, values(:), numel(iparam), iparam, numel(rparam), rparam);
   cntc_report_errors('cntc_setprofileinputvalues', ire, -1);

end % function cntc_setprofileinputvalues
