function [ mater ] = add_combined( mater )
% ADD_COMBINED  Combined constants of both bodies, by the names of established scripts.
%
%   mater.ga   combined modulus of rigidity [N/mm2], the harmonic mean
%   mater.si   combined Poisson ratio [-]
%   mater.ak   difference parameter K [-]; 0 for bodies of one material

   g  = mater.gg;
   nu = mater.poiss;
   mater.ga = 2 / (1/g(1) + 1/g(2));
   mater.si = mater.ga/2 * (nu(1)/g(1) + nu(2)/g(2));
   mater.ak = mater.ga/4 * ((1-2*nu(1))/g(1) - (1-2*nu(2))/g(2));

end % function add_combined
