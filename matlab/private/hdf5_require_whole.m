function hdf5_require_whole( fname, place, value )
% HDF5_REQUIRE_WHOLE  Stop if HDF5 did not find a chunk of an array, see src/hdf5/file.f90.
%
%   fname   name of the file, for the message
%   place   group or dataset
%   value   its contents: struct, or array

   if (isstruct(value))
      names = fieldnames(value);
      for i = 1 : numel(names)
         hdf5_require_whole(fname, [place '/' names{i}], value.(names{i}));
      end
      return
   end
   lost = false;
   if (isa(value,'double'))
      missing = value(isnan(value));
      lost    = any(typecast(missing(:)', 'uint64') == typecast(hex2num('7ff8636f6e746163'), 'uint64'));
   elseif (isa(value,'int8'))
      lost    = any(value(:) == -128);
   end
   if (lost)
      error('"%s" is damaged: a chunk of %s was not found.', fname, place);
   end

end % function hdf5_require_whole
