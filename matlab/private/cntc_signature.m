function [ letters ] = cntc_signature( name )
% CNTC_SIGNATURE  Kinds of the arguments of a routine of the library, one letter each.
%
%   i, r, s   integers, real numbers, text going in
%   I, R      integers, real numbers coming out
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   persistent table;
   if (isempty(table))
      table.cntc_setfileunits = 'ii';
      table.cntc_initializefirst = 'IIisssiii';
      table.cntc_initializefirst_new = 'IIisssiii';
      table.cntc_initialize = 'iiIIsi';
      table.cntc_setglobalflags = 'iii';
      table.cntc_getmaxnumthreads = 'I';
      table.cntc_finalize = 'i';
      table.cntc_finalizelast = '';
      table.cntc_setflags = 'iiiii';
      table.cntc_setmetadata = 'iiiir';
      table.cntc_setsolverflags = 'iiiiiir';
      table.cntc_setmaterialparameters = 'iiiir';
      table.cntc_settemperaturedata = 'iiiir';
      table.cntc_setwear = 'iiir';
      table.cntc_settimestep = 'iir';
      table.cntc_setrollingstepsize = 'iirr';
      table.cntc_setfrictionmethod = 'iiiir';
      table.cntc_setpotcontact = 'iiiir';
      table.cntc_settangentialforces = 'iirr';
      table.cntc_readinpfile = 'iisiI';
      table.cntc_setreferencevelocity = 'iir';
      table.cntc_sethertzcontact = 'iiiir';
      table.cntc_setpenetration = 'iir';
      table.cntc_setnormalforce = 'iir';
      table.cntc_setundeformeddistc = 'iiiir';
      table.cntc_setcreepages = 'iirrr';
      table.cntc_setextrarigidslip = 'iiirr';
      table.cntc_setverticalforce = 'ir';
      table.cntc_setprofileinputfname = 'isiiiir';
      table.cntc_setprofileinputvalues = 'iiriiir';
      table.cntc_settrackdimensions = 'iiir';
      table.cntc_setwheelsetdimensions = 'iiir';
      table.cntc_setwheelsetposition = 'iiir';
      table.cntc_setwheelsetvelocity = 'iiir';
      table.cntc_setwheelsetflexibility = 'iiir';
      table.cntc_calculate = 'iiI';
      table.cntc_getflags = 'iiiiI';
      table.cntc_getparameters = 'iiiiR';
      table.cntc_getprofilevalues = 'iiiiiriR';
      table.cntc_getprofilevalues_new = 'iiiiiriR';
      table.cntc_getwheelsetposition = 'iiR';
      table.cntc_getwheelsetvelocity = 'iiR';
      table.cntc_getnumcontactpatches = 'iI';
      table.cntc_getcontactlocation = 'iiiR';
      table.cntc_getreferencevelocity = 'iiR';
      table.cntc_gethertzcontact = 'iiiR';
      table.cntc_getnumelements = 'iiII';
      table.cntc_getgriddiscretization = 'iiRR';
      table.cntc_getpotcontact = 'iiiR';
      table.cntc_getpenetration = 'iiR';
      table.cntc_getcreepages = 'iiRRR';
      table.cntc_getcontactforces = 'iiRRRR';
      table.cntc_getglobalforces = 'iiiR';
      table.cntc_getcontactpatchareas = 'iiRRR';
      table.cntc_getelementdivision = 'iiiI';
      table.cntc_getmaximumpressure = 'iiR';
      table.cntc_getmaximumtraction = 'iiR';
      table.cntc_getmaximumtemperature = 'iiRR';
      table.cntc_geterrors = 'iiiR';
      table.cntc_getwear = 'iiiR';
      table.cntc_getfielddata = 'iiiiR';
      table.cntc_gettractions = 'iiiRRR';
      table.cntc_getmicroslip = 'iiiRR';
      table.cntc_getdisplacements = 'iiiRRR';
      table.cntc_getsensitivities = 'iiiiR';
      table.cntc_getcalculationtime = 'iiRR';
      table.cntc_resetcalculationtime = 'ii';
      table.subs_addblock = 'iiiiiiirrr';
      table.subs_calculate = 'iiI';
      table.subs_getblocksize = 'iiiIII';
      table.subs_getresults = 'iiiiiiR';
   end
   if (~isfield(table, name))
      error('cntc_signature: the library has no routine %s.', name);
   end
   letters = table.(name);

end % function cntc_signature
