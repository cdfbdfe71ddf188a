/* Loops over the elements of a window, used by conjugate gradients between two products; described in gradient_loops.f90. lanes.h
 * explains why they are in C */
#include "../base/lanes.h"

void contact_gradient_gap_sums(int n, const double *h, const double *u, const double *p, double *total);
double contact_gradient_residuals(int n, double pen, const double *h, const double *u, const double *p, double *r);
void contact_gradient_choose_free(int n, const double *p, const double *h, double highest, double *free, double *r);
void contact_gradient_free_sums(int n, const double *free, const double *v, double *total);
void contact_gradient_project(int n, const double *free, double mean, double *v, const double *r, const double *s, double *products);
void contact_gradient_turn(int n, double beta, const double *z, const double *r, double *d, double *previous);
double contact_gradient_go_along(int n, double alpha, const double *d, double *p);

#define LOOPS "../normal/gradient_bodies.h"
#include "../base/twice.h"

void contact_gradient_gap_sums(int n, const double *h, const double *u, const double *p, double *total) {
  CALL(gap_sums, n, h, u, p, total);
}

double contact_gradient_residuals(int n, double pen, const double *h, const double *u, const double *p, double *r) {
  return CALL(residuals, n, pen, h, u, p, r);
}

void contact_gradient_choose_free(int n, const double *p, const double *h, double highest, double *free, double *r) {
  CALL(choose_free, n, p, h, highest, free, r);
}

void contact_gradient_free_sums(int n, const double *free, const double *v, double *total) { CALL(free_sums, n, free, v, total); }

void contact_gradient_project(int n, const double *free, double mean, double *v, const double *r, const double *s, double *products) {
  CALL(project, n, free, mean, v, r, s, products);
}

void contact_gradient_turn(int n, double beta, const double *z, const double *r, double *d, double *previous) {
  CALL(turn, n, beta, z, r, d, previous);
}

double contact_gradient_go_along(int n, double alpha, const double *d, double *p) { return CALL(go_along, n, alpha, d, p); }
