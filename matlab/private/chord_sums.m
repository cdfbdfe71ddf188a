function [ s ] = chord_sums( y, z )
% CHORD_SUMS  Cumulative lengths of the chords from the first point of a profile.

   s = [0; cumsum(hypot(diff(y(:)), diff(z(:))))];

end % function chord_sums
