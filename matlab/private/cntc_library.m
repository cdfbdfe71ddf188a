function [ answer ] = cntc_library( question, value )
% CNTC_LIBRARY  The loaded library: how it is called, and which messages it reports.
%
%   cntc_library('load')          load it unless it is loaded; returns whether it was loaded before
%   cntc_library('unload')
%   cntc_library('mex')           is it called by the gateway cntc_mex? Otherwise by Matlab's calllib
%   cntc_library('name')          its name for calllib
%   cntc_library('idebug', value) set or get: 0 silent, 1 report error codes, 2 also remarks
%
% The library is searched for as CONTACT_LIBRARY of the environment, then in bin, lib and build/release/bin beside
% this folder, and in bin of an installation that has these scripts in share/contact.

   persistent state;
   if (isempty(state))
      state = struct('loaded',false, 'mex',false, 'name','', 'idebug',1);
   end
   answer = [];
   switch (question)
      case 'load'
         answer = state.loaded;
         if (~state.loaded)
            [file, state.name] = find_library();
            state.mex = use_gateway();
            if (state.mex)
               cntc_mex('open', file);
            elseif (~libisloaded(state.name))
               loadlibrary(file, find_header(file), 'alias', state.name);
            end
            state.loaded = true;
         end
      case 'unload'
         if (state.loaded && state.mex)
            cntc_mex('close');
         elseif (state.loaded)
            unloadlibrary(state.name);
         end
         state.loaded = false;
      case {'mex','name'}
         if (~state.loaded)
            error('contact: the library is not loaded; call cntc_initlibrary first.');
         end
         answer = state.(question);
      case 'idebug'
         if (nargin>1)
            state.idebug = value;
         end
         answer = state.idebug;
   end

end % function cntc_library

%------------------------------------------------------------------------------------------------------

function [ file, name ] = find_library( )
% Full path, and the name that older scripts have in the global variable libname

   global libname;
   if (isempty(libname))
      libname = 'contact_addon_linux64';
      if (ispc)
         libname = 'contact_addon_win64';
      elseif (ismac)
         libname = 'contact_addon_maci64';
      end
   end
   name = libname;
   file = getenv('CONTACT_LIBRARY');
   if (~isempty(file))
      return
   end
   endings = {'.so','.dll','.dylib'};
   top     = fileparts(fileparts(fileparts(mfilename('fullpath'))));
   folders = {'bin','lib',fullfile('build','release','bin'),fullfile('..','..','bin')};
   for f = folders
      for e = endings
         file = fullfile(top, f{1}, [name e{1}]);
         if (exist(file,'file')==2)
            return
         end
      end
   end
   error('contact: the library %s was not found in bin or build/release/bin of %s; set CONTACT_LIBRARY to its path.', ...
         name, top);

end % function find_library

%------------------------------------------------------------------------------------------------------

function [ header ] = find_header( file )
% The header for loadlibrary, in include beside this folder or beside that of the library

   top = fileparts(fileparts(fileparts(mfilename('fullpath'))));
   header = fullfile(top, 'include', 'contact_addon.h');
   if (exist(header,'file')~=2)
      header = fullfile(fileparts(file), '..', 'include', 'contact_addon.h');
   end

end % function find_header

%------------------------------------------------------------------------------------------------------

function [ yes ] = use_gateway( )
% The gateway where it was built, always in Octave

   here = fileparts(mfilename('fullpath'));
   yes  = (exist('cntc_mex')==3 || exist(fullfile(here,['cntc_mex.' mexext()]),'file')>0);
   if (~yes && exist('OCTAVE_VERSION','builtin'))
      error('contact: Octave calls the library by a gateway; build it once with cntc_buildmex (needs mkoctfile).');
   end

end % function use_gateway
