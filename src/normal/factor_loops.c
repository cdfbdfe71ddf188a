/* Cholesky factorisation of a few elements and substitution, described in factor_loops.f90; lanes.h explains why they are in C */
#include "../base/lanes.h"

void contact_factor_forward(int n, int stride, const double *lower, double *x);
void contact_factor_backward(int n, int stride, const double *lower, double *x);
int contact_factor_factorize(int n, int first, int stride, double *a, double *row);

#define LOOPS "../normal/factor_bodies.h"
#include "../base/twice.h"

void contact_factor_forward(int n, int stride, const double *lower, double *x) { CALL(forward, n, stride, lower, x); }

void contact_factor_backward(int n, int stride, const double *lower, double *x) { CALL(backward, n, stride, lower, x); }

int contact_factor_factorize(int n, int first, int stride, double *a, double *row) {
  return CALL(factorize, n, first, stride, a, row);
}
