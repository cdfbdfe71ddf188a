function [ b ] = add_principal( b )
% ADD_PRINCIPAL  Principal stresses and Tresca's shear stress of a block with a full stress tensor.
%
% The three eigenvalues of the symmetric tensor in closed form: by the angle of the deviator in the
% plane of equal mean stress.

   mean_stress = (b.sigxx + b.sigyy + b.sigzz) / 3;
   dxx = b.sigxx - mean_stress;
   dyy = b.sigyy - mean_stress;
   dzz = b.sigzz - mean_stress;
   j2  = (dxx.^2 + dyy.^2 + dzz.^2) / 2 + b.sigxy.^2 + b.sigxz.^2 + b.sigyz.^2;
   j3  = dxx.*dyy.*dzz + 2*b.sigxy.*b.sigyz.*b.sigxz ...
         - dxx.*b.sigyz.^2 - dyy.*b.sigxz.^2 - dzz.*b.sigxy.^2;
   r   = 2 * sqrt(j2/3);
   c   = zeros(size(r));
   c(r>0) = 4 * j3(r>0) ./ r(r>0).^3;
   angle  = acos(min(1, max(-1, c))) / 3;

   b.sigma1 = mean_stress + r .* cos(angle);
   b.sigma3 = mean_stress + r .* cos(angle + 2*pi/3);
   b.sigma2 = 3*mean_stress - b.sigma1 - b.sigma3;
   b.sigtr  = b.sigma1 - b.sigma3;

end % function add_principal
