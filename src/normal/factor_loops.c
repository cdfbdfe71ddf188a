/* Cholesky factorisation of a few elements, its changes, and substitution, described in factor_loops.f90; lanes.h explains why they are in C */
#include "../base/lanes.h"

void contact_factor_box(int mx, int my, const double *p, int *n, int *box);
void contact_factor_forward(int n, int stride, const double *lower, double *x);
void contact_factor_backward(int n, int stride, const double *lower, double *x);
int contact_factor_factorize(int n, int stride, double *a, double *row);
void contact_factor_remove(int n, int removed, int stride, double *a, double *v, double *w);
int contact_factor_append(int n, int stride, double *a, double *row, double *w, const double *b);
double contact_factor_violation(int n, double pen, const double *h, const double *u, const double *p);

#define LOOPS "../normal/factor_bodies.h"
#include "../base/twice.h"

void contact_factor_box(int mx, int my, const double *p, int *n, int *box) { *n = CALL(box, mx, my, p, box); }

void contact_factor_forward(int n, int stride, const double *lower, double *x) { CALL(forward, n, stride, lower, x); }

void contact_factor_backward(int n, int stride, const double *lower, double *x) { CALL(backward, n, stride, lower, x); }

int contact_factor_factorize(int n, int stride, double *a, double *row) { return CALL(factorize, n, stride, a, row); }

void contact_factor_remove(int n, int removed, int stride, double *a, double *v, double *w) {
  CALL(remove, n, removed - 1, stride, a, v, w);
}

int contact_factor_append(int n, int stride, double *a, double *row, double *w, const double *b) {
  return CALL(append, n, stride, a, row, w, b);
}

double contact_factor_violation(int n, double pen, const double *h, const double *u, const double *p) {
  return CALL(violation, n, pen, h, u, p);
}
