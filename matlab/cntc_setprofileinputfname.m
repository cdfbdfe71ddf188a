function cntc_setprofileinputfname( ire, fname, iparam, rparam )
% CNTC_SETPROFILEINPUTFNAME  Set the profile of wheel or rail by the name of a file.
%
%   cntc_setprofileinputfname( ire, fname, iparam, rparam )
%
%   ire       result element of a wheel-rail problem (default 1)
%   fname     name of the file, relative to the folder of input files
%   iparam    itype, unused, mirrory, mirrorz, errhndl, ismooth; itype: 0 rail, 1 wheel, -1 by the extension; mirrory:
%             1 mirrors y, 0 and -1 leave it as the file says; others as in input files (default -1)
%   rparam    factor to mm (-1 by the units), smoothing [-] or [mm], maxomit [-], zigthrs, kinkhigh, kinklow [rad],
%             kinkwid [L] (default [1 0])
%
% See also: cntc_setprofileinputvalues.
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   ire = cntc_ids(ire);
   if (nargin<3 || isempty(iparam))
      iparam = -1;
   end
   if (nargin<4 || isempty(rparam))
      rparam = [1 0];
   end
   cntc_call('cntc_setprofileinputfname', ire, fname, numel(fname), numel(iparam), iparam, numel(rparam), rparam);
   cntc_report_errors('cntc_setprofileinputfname', ire, -1);

end % function cntc_setprofileinputfname
