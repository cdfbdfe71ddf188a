/* A caller of the published library: own variables, no pointers to constants, only names of the header */
#include "contact_addon.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

int main(void) {
  int ire = 1, icp = 1, imodul = 3, ifcver = 0, ierror = 0, ioutput = 0, blank = 1, length = 8;
  int n, method, mx, my, npot, i, flags[25], values[25];
  double params[10], veloc = 10000.0, force = 20000.0, vx = 0.001, vy = 0.0, phi = 0.0;
  double fn, fx, fy, mz, sum = 0.0, dx, dy, *pn, *px, *py;
  char wrkdir[] = " ", outdir[] = " ", expnam[] = "stranger";

  cntc_initializefirst(&ifcver, &ierror, &ioutput, wrkdir, outdir, expnam, &blank, &blank, &length);
  if (ierror != 0 || ifcver < 2500) return 1;
  cntc_initialize(&ire, &imodul, &ifcver, &ierror, outdir, &blank);
  if (ierror != 0) return 2;
  n = 2;
  flags[0] = 1933;
  values[0] = 1934;
  flags[1] = 1984;
  values[1] = 2;
  cntc_setflags(&ire, &icp, &n, flags, values);
  method = 0;
  n = 4;
  params[0] = params[1] = 0.28;
  params[2] = params[3] = 82000.0;
  cntc_setmaterialparameters(&ire, &icp, &method, &n, params);
  n = 2;
  params[0] = params[1] = 0.3;
  cntc_setfrictionmethod(&ire, &icp, &method, &n, params);
  cntc_setreferencevelocity(&ire, &icp, &veloc);
  method = -3;
  n = 5;
  params[0] = params[1] = 21.0;
  params[2] = 5.0;
  params[3] = 4.0;
  params[4] = 1.2;
  cntc_sethertzcontact(&ire, &icp, &method, &n, params);
  cntc_setnormalforce(&ire, &icp, &force);
  cntc_setcreepages(&ire, &icp, &vx, &vy, &phi);
  cntc_calculate(&ire, &icp, &ierror);
  if (ierror != 0) return 3;
  cntc_getcontactforces(&ire, &icp, &fn, &fx, &fy, &mz);
  cntc_getnumelements(&ire, &icp, &mx, &my);
  cntc_getgriddiscretization(&ire, &icp, &dx, &dy);
  npot = mx * my;
  pn = (double *)malloc(3 * npot * sizeof(double));
  if (npot != 441 || pn == NULL) return 4;
  px = pn + npot;
  py = px + npot;
  cntc_gettractions(&ire, &icp, &npot, pn, px, py);
  for (i = 0; i < npot; i++) sum += px[i] * dx * dy;
  free(pn);
  cntc_finalize(&ire);
  printf("%.3f %.3f\n", fn, fx);
  return fabs(fn - force) > 1e-6 * force || fabs(sum - fx) > 1e-6 * force || fx > -0.2 * force ? 5 : 0;
}
