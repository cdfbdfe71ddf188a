/* The simple loop of library calls with which studies are compared: a creep table, one thread; prints processor time per case.
 * usage: loop CASES ELEMENTS [FIRST LAST]: computes cases FIRST to LAST, from 0, so that several processes share them */
#include <caddon_flags.h>
#include <contact_addon.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define INT(value) (&(const int){value})
#define REAL(value) (&(const double){value})
#define INTS(...) ((const int[]){__VA_ARGS__})
#define REALS(...) ((const double[]){__VA_ARGS__})

int main(int argc, char **argv) {
  const int cases = argc > 1 ? atoi(argv[1]) : 1000, one = 1;
  const double n = argc > 2 ? atof(argv[2]) : 19.0;
  const int first = argc > 3 ? atoi(argv[3]) : 0, last = argc > 4 ? atoi(argv[4]) : cases - 1;
  double sum = 0.0;
  int version, error = 0;
  cntc_initialize(&one, INT(3), &version, &error, " ", INT(1));
  if (error != 0) return 1;
  cntc_setflags(&one, &one, INT(5), INTS(CNTC_if_units, CNTC_ic_tang, CNTC_ic_output, CNTC_ic_flow, CNTC_own_order),
                INTS(CNTC_un_cntc, 3, 0, 0, 2));
  cntc_setmaterialparameters(&one, &one, INT(0), INT(4), REALS(0.28, 0.28, 82000.0, 82000.0));
  cntc_setfrictionmethod(&one, &one, INT(0), INT(2), REALS(0.3, 0.3));
  cntc_setreferencevelocity(&one, &one, REAL(30000.0));
  cntc_setrollingstepsize(&one, &one, REAL(0.0), REAL(1.0));
  cntc_sethertzcontact(&one, &one, INT(-3), INT(5), REALS(n, n, 6.0, 5.0, 1.3));
  cntc_setnormalforce(&one, &one, REAL(70000.0));
  const clock_t begin = clock();
  for (int k = first; k <= last; k++) {
    double fn, fx, fy, mz;
    /* as the study: xi fastest, 100 x 100 x the rest */
    const double xi = -0.01 + 0.02 * (k % 100) / 99.0, eta = -0.01 + 0.02 * (k / 100 % 100) / 99.0;
    const double phi = cases > 10000 ? -0.001 + 0.002 * (k / 10000) / (cases / 10000 - 1.0) : 0.0;
    cntc_setcreepages(&one, &one, &xi, &eta, &phi);
    cntc_calculate(&one, &one, &error);
    if (error < 0) return 1;
    cntc_getcontactforces(&one, &one, &fn, &fx, &fy, &mz);
    sum += fx * fx + fy * fy;
  }
  printf("loop: %.2f us a case, sum %.17g\n", 1e6 * (double)(clock() - begin) / CLOCKS_PER_SEC / (last - first + 1), sum);
  cntc_finalize(&one);
  return 0;
}
