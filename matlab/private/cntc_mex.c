/* Gateway from Octave (or Matlab) to the library: opens it and calls a routine by its name.
 *
 *   cntc_mex('open', path)                        load the library
 *   cntc_mex('close')                             forget it
 *   is = cntc_mex('isopen')
 *   [out...] = cntc_mex('call', name, signature, arg...)
 *   [code, text] = cntc_mex('error', ire, icp)    what went wrong last: contact_last_error
 *
 * All arguments of the library's routines are addresses and none returns a value, so that one letter per
 * argument says everything: i, r, s integer, real and text going in; I, R integer and real coming
 * out. For what comes out an array of the right size is given, whose values the routine sees.
 */
#include "mex.h"
#include <dlfcn.h>
#include <string.h>

enum { MAX_ARGUMENTS = 12, NAME_LENGTH = 64, TEXT_LENGTH = 1024 };

static void *library = NULL;

static void *symbol(const char *name)
{
  void *address;
  if (!library)
    mexErrMsgTxt("The library is not loaded; call cntc_initlibrary first.");
  address = dlsym(library, name);
  if (!address)
    mexErrMsgIdAndTxt("contact:symbol", "The library has no routine %s.", name);
  return address;
}

static void open_library(const mxArray *path)
{
  char *text = mxArrayToString(path);
  if (!text)
    mexErrMsgTxt("The path of the library must be a text.");
  /* stays in memory when it is closed: its threads may still exist */
  library = dlopen(text, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  mxFree(text);
  if (!library)
    mexErrMsgIdAndTxt("contact:open", "The library cannot be loaded: %s", dlerror());
  if (!mexIsLocked())
    mexLock();
}

/* Copy of an argument in the form the library wants; all are released by Octave when the call ends */
static void *convert(char letter, const mxArray *value, int number)
{
  mwSize n, k;
  if (letter == 's') {
    char *text = mxArrayToString(value);
    if (!text)
      mexErrMsgIdAndTxt("contact:argument", "Argument %d must be a text.", number);
    return text;
  }
  if (!mxIsDouble(value) || mxIsComplex(value))
    mexErrMsgIdAndTxt("contact:argument", "Argument %d must be real numbers.", number);
  n = mxGetNumberOfElements(value);
  if (letter == 'i' || letter == 'I') {
    const double *from = mxGetPr(value);
    int *to = mxCalloc(n + 1, sizeof(int));
    for (k = 0; k < n; k++) {
      if (!(from[k] > -2147483648.0 && from[k] < 2147483648.0) || from[k] != (double)(int)from[k])
        mexErrMsgIdAndTxt("contact:argument", "Argument %d must be whole numbers.", number);
      to[k] = (int)from[k];
    }
    return to;
  }
  if (letter == 'r' || letter == 'R') {
    double *to = mxCalloc(n + 1, sizeof(double));
    if (n > 0)
      memcpy(to, mxGetPr(value), n * sizeof(double));
    return to;
  }
  mexErrMsgIdAndTxt("contact:argument", "Letter '%c' of a signature is unknown.", letter);
  return NULL;
}

static mxArray *result(char letter, const mxArray *model, const void *values)
{
  mwSize n = mxGetNumberOfElements(model), k;
  mxArray *array = mxCreateDoubleMatrix(mxGetM(model), mxGetN(model), mxREAL);
  double *to = mxGetPr(array);
  for (k = 0; k < n; k++)
    to[k] = letter == 'I' ? (double)((const int *)values)[k] : ((const double *)values)[k];
  return array;
}

static void call(int nlhs, mxArray *plhs[], int nrhs, const mxArray *prhs[])
{
  char name[NAME_LENGTH], signature[MAX_ARGUMENTS + 2];
  void *a[MAX_ARGUMENTS] = {NULL};
  void *address;
  int i, out = 0, n;

  if (mxGetString(prhs[0], name, sizeof name) || mxGetString(prhs[1], signature, sizeof signature))
    mexErrMsgTxt("Name and signature must be texts, with at most 12 arguments.");
  n = (int)strlen(signature);
  if (n > MAX_ARGUMENTS || n != nrhs - 2)
    mexErrMsgIdAndTxt("contact:argument", "%s has %d arguments, not %d.", name, n, nrhs - 2);
  address = symbol(name);
  for (i = 0; i < n; i++)
    a[i] = convert(signature[i], prhs[2 + i], i + 1);

#define P void *
  switch (n) {
  case 0: ((void (*)(void))address)(); break;
  case 1: ((void (*)(P))address)(a[0]); break;
  case 2: ((void (*)(P, P))address)(a[0], a[1]); break;
  case 3: ((void (*)(P, P, P))address)(a[0], a[1], a[2]); break;
  case 4: ((void (*)(P, P, P, P))address)(a[0], a[1], a[2], a[3]); break;
  case 5: ((void (*)(P, P, P, P, P))address)(a[0], a[1], a[2], a[3], a[4]); break;
  case 6: ((void (*)(P, P, P, P, P, P))address)(a[0], a[1], a[2], a[3], a[4], a[5]); break;
  case 7: ((void (*)(P, P, P, P, P, P, P))address)(a[0], a[1], a[2], a[3], a[4], a[5], a[6]); break;
  case 8:
    ((void (*)(P, P, P, P, P, P, P, P))address)(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]);
    break;
  case 9:
    ((void (*)(P, P, P, P, P, P, P, P, P))address)(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8]);
    break;
  case 10:
    ((void (*)(P, P, P, P, P, P, P, P, P, P))address)(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9]);
    break;
  default: mexErrMsgTxt("More than ten arguments are not supported.");
  }
#undef P

  for (i = 0; i < n; i++)
    if ((signature[i] == 'I' || signature[i] == 'R') && (out < nlhs || out == 0))
      plhs[out++] = result(signature[i], prhs[2 + i], a[i]);
}

static void last_error(int nlhs, mxArray *plhs[], const mxArray *prhs[])
{
  char text[TEXT_LENGTH] = "";
  int (*ask)(int, int, char *, int) = (int (*)(int, int, char *, int))symbol("contact_last_error");
  int code = ask((int)mxGetScalar(prhs[0]), (int)mxGetScalar(prhs[1]), text, TEXT_LENGTH);
  plhs[0] = mxCreateDoubleScalar(code);
  if (nlhs > 1)
    plhs[1] = mxCreateString(text);
}

void mexFunction(int nlhs, mxArray *plhs[], int nrhs, const mxArray *prhs[])
{
  char command[16];
  if (nrhs < 1 || mxGetString(prhs[0], command, sizeof command))
    mexErrMsgTxt("The first argument must be a command.");
  if (!strcmp(command, "open") && nrhs == 2)
    open_library(prhs[1]);
  else if (!strcmp(command, "close")) {
    if (library)
      dlclose(library);
    library = NULL;
  } else if (!strcmp(command, "isopen"))
    plhs[0] = mxCreateLogicalScalar(library != NULL);
  else if (!strcmp(command, "call") && nrhs >= 3)
    call(nlhs, plhs, nrhs - 1, prhs + 1);
  else if (!strcmp(command, "error") && nrhs == 3)
    last_error(nlhs, plhs, prhs + 1);
  else
    mexErrMsgTxt("Unknown command, or wrong number of arguments.");
}
