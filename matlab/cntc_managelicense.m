function [ ierror ] = cntc_managelicense( varargin )
% CNTC_MANAGELICENSE  No licence is needed; returns 0.
%
%   ierror = cntc_managelicense( varargin )

   ierror = 0;

end % function cntc_managelicense
