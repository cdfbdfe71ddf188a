/* Every routine of the library once more under its name with an underscore behind it, the name that Fortran
 * callers get who declare no interface. All arguments are addresses; more of them, such as the hidden lengths
 * of texts, do no harm. */

#define ALIAS0(name) \
  void name(void); \
  void name##_(void); \
  void name##_(void) { name(); }
#define ALIAS1(name) \
  void name(void *); \
  void name##_(void *a); \
  void name##_(void *a) { name(a); }
#define ALIAS2(name) \
  void name(void *, void *); \
  void name##_(void *a, void *b); \
  void name##_(void *a, void *b) { name(a, b); }
#define ALIAS3(name) \
  void name(void *, void *, void *); \
  void name##_(void *a, void *b, void *c); \
  void name##_(void *a, void *b, void *c) { name(a, b, c); }
#define ALIAS4(name) \
  void name(void *, void *, void *, void *); \
  void name##_(void *a, void *b, void *c, void *d); \
  void name##_(void *a, void *b, void *c, void *d) { name(a, b, c, d); }
#define ALIAS5(name) \
  void name(void *, void *, void *, void *, void *); \
  void name##_(void *a, void *b, void *c, void *d, void *e); \
  void name##_(void *a, void *b, void *c, void *d, void *e) { name(a, b, c, d, e); }
#define ALIAS6(name) \
  void name(void *, void *, void *, void *, void *, void *); \
  void name##_(void *a, void *b, void *c, void *d, void *e, void *f); \
  void name##_(void *a, void *b, void *c, void *d, void *e, void *f) { name(a, b, c, d, e, f); }
#define ALIAS7(name) \
  void name(void *, void *, void *, void *, void *, void *, void *); \
  void name##_(void *a, void *b, void *c, void *d, void *e, void *f, void *g); \
  void name##_(void *a, void *b, void *c, void *d, void *e, void *f, void *g) { name(a, b, c, d, e, f, g); }
#define ALIAS8(name) \
  void name(void *, void *, void *, void *, void *, void *, void *, void *); \
  void name##_(void *a, void *b, void *c, void *d, void *e, void *f, void *g, void *h); \
  void name##_(void *a, void *b, void *c, void *d, void *e, void *f, void *g, void *h) { name(a, b, c, d, e, f, g, h); }
#define ALIAS9(name) \
  void name(void *, void *, void *, void *, void *, void *, void *, void *, void *); \
  void name##_(void *a, void *b, void *c, void *d, void *e, void *f, void *g, void *h, void *i); \
  void name##_(void *a, void *b, void *c, void *d, void *e, void *f, void *g, void *h, void *i) { name(a, b, c, d, e, f, g, h, i); }
#define ALIAS10(name) \
  void name(void *, void *, void *, void *, void *, void *, void *, void *, void *, void *); \
  void name##_(void *a, void *b, void *c, void *d, void *e, void *f, void *g, void *h, void *i, void *j); \
  void name##_(void *a, void *b, void *c, void *d, void *e, void *f, void *g, void *h, void *i, void *j) { name(a, b, c, d, e, f, g, h, i, j); }

ALIAS3(cntc_calculate)
ALIAS2(cntc_calculate1)
ALIAS3(cntc_calculate3)
ALIAS1(cntc_finalize)
ALIAS0(cntc_finalizelast)
ALIAS4(cntc_getcalculationtime)
ALIAS6(cntc_getcontactforces)
ALIAS4(cntc_getcontactlocation)
ALIAS5(cntc_getcontactpatchareas)
ALIAS5(cntc_getcreepages)
ALIAS6(cntc_getdisplacements)
ALIAS4(cntc_getelementdivision)
ALIAS5(cntc_getfielddata)
ALIAS5(cntc_getflags)
ALIAS4(cntc_getglobalforces)
ALIAS4(cntc_getgriddiscretization)
ALIAS4(cntc_gethertzcontact)
ALIAS3(cntc_getmaximumpressure)
ALIAS4(cntc_getmaximumtemperature)
ALIAS3(cntc_getmaximumtraction)
ALIAS1(cntc_getmaxnumthreads)
ALIAS5(cntc_getmicroslip)
ALIAS2(cntc_getnumcontactpatches)
ALIAS4(cntc_getnumelements)
ALIAS5(cntc_getparameters)
ALIAS3(cntc_getpenetration)
ALIAS4(cntc_getpotcontact)
ALIAS8(cntc_getprofilevalues)
ALIAS8(cntc_getprofilevalues_new)
ALIAS3(cntc_getreferencevelocity)
ALIAS5(cntc_getsensitivities)
ALIAS6(cntc_gettractions)
ALIAS3(cntc_getwheelsetposition)
ALIAS3(cntc_getwheelsetvelocity)
ALIAS6(cntc_initialize)
ALIAS9(cntc_initializefirst)
ALIAS9(cntc_initializefirst_new)
ALIAS5(cntc_readinpfile)
ALIAS2(cntc_resetcalculationtime)
ALIAS5(cntc_setcreepages)
ALIAS5(cntc_setextrarigidslip)
ALIAS2(cntc_setfileunits)
ALIAS5(cntc_setflags)
ALIAS5(cntc_setfrictionmethod)
ALIAS3(cntc_setglobalflags)
ALIAS5(cntc_sethertzcontact)
ALIAS5(cntc_setmaterialparameters)
ALIAS5(cntc_setmetadata)
ALIAS3(cntc_setnormalforce)
ALIAS3(cntc_setpenetration)
ALIAS5(cntc_setpotcontact)
ALIAS7(cntc_setprofileinputfname)
ALIAS7(cntc_setprofileinputvalues)
ALIAS3(cntc_setreferencevelocity)
ALIAS4(cntc_setrollingstepsize)
ALIAS7(cntc_setsolverflags)
ALIAS4(cntc_settangentialforces)
ALIAS5(cntc_settemperaturedata)
ALIAS3(cntc_settimestep)
ALIAS4(cntc_settrackdimensions)
ALIAS5(cntc_setundeformeddistc)
ALIAS2(cntc_setverticalforce)
ALIAS4(cntc_setwheelsetdimensions)
ALIAS4(cntc_setwheelsetflexibility)
ALIAS4(cntc_setwheelsetposition)
ALIAS4(cntc_setwheelsetvelocity)
ALIAS10(subs_addblock)
ALIAS3(subs_calculate)
ALIAS6(subs_getblocksize)
ALIAS7(subs_getresults)
