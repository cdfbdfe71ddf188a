function [ plastic ] = has_plasticity( mater )
% HAS_PLASTICITY  Is there a layer that yields? Its yield limit is then neither zero nor infinite.

   plastic = (mater.m_digit==4 && mater.tau_c0>1e-10 && mater.tau_c0<=1e10);

end % function has_plasticity
