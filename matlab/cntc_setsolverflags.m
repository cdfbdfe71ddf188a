function cntc_setsolverflags( ire, icp, gdigit, iparam, rparam )
% CNTC_SETSOLVERFLAGS  Set solution methods and their parameters by the G digit.
%
%   cntc_setsolverflags( ire, icp, gdigit, iparam, rparam )
%
%   ire, icp  result element (default 1) and contact patch or problem; -1 (default): wheel and rail as a whole
%   gdigit    iparam; rparam
%   0         maxgs, maxin, maxnr, maxout; eps                                    default solvers
%   1         none                                                                keep all
%   2, 3      maxgs, maxin, maxnr, maxout, inislp; eps, omegah, omegas, omgslp    ConvexGS, SteadyGS
%   4         maxgs, maxin, maxnr, maxout, inislp; eps, omgslp                    friction that changes with slip
%   5         maxgs, maxin, maxnr, maxout, kdowfb;
%             eps, fdecay, betath, d_ifc, d_lin, d_cns, d_slp, pow_s              GDsteady
%   6         mxsens; epsens                                                      sensitivities
%   Default: iparam = [], rparam = [].
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'cntc_setsolverflags');
   if (nargin<4 || isempty(iparam))
      iparam = [];
   end
   if (nargin<5 || isempty(rparam))
      rparam = [];
   end
   cntc_call('cntc_setsolverflags', ire, icp, gdigit, numel(iparam), iparam, numel(rparam), rparam);
   cntc_report_errors('cntc_setsolverflags', ire, icp);

end % function cntc_setsolverflags
