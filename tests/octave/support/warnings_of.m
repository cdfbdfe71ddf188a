function text = warnings_of( fun )
% WARNINGS_OF  What a call prints: its warnings, '' for none.
%
% lastwarn is no measure of this: Octave 11 stores warnings of its own files there, although they are switched off.

   text = evalc('fun();');

end % function warnings_of
