function [ ierror ] = cntc_readinpfile( ire, inp_type, fname )
% CNTC_READINPFILE  Take the settings of wheel and rail from the first case of an input file.
%
%   ierror = cntc_readinpfile( ire, inp_type, fname )
%
%   ire       result element of a wheel-rail problem (default 1)
%   inp_type  CNTC.inp_modul1; or CNTC.inp_spck: MODULE = 0 or 11, Z and E = 0 or 3; C1, P, N, F, H, S and I keep
%             their values
%   fname     name of the file; with CNTC.inp_modul1 .inp or .toml, the readable format
%   ierror    0, or a negative code CNTC.err_*
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   ire = cntc_ids(ire);
   ierror = cntc_call('cntc_readinpfile', ire, inp_type, fname, numel(fname), []);
   cntc_report_errors('cntc_readinpfile', ire, -1, ierror);

end % function cntc_readinpfile
