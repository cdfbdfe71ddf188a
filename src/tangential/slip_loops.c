/* Loops over the elements of a window for Newton's method for friction, described in slip_loops.f90; lanes.h explains why they are
 * in C.
 *
 * In fields of two components the second one follows the first after `stride` numbers. */
#include "../base/lanes.h"

void contact_slip_residual(int n, int stride, const int *contact, const double *bound, const double *p, const double *slip, double r, double *sums);
void contact_slip_step(int n, int stride, const int *contact, const double *bound, double alpha, const double *p, const double *d, double *out);
void contact_slip_linearise(int n, int stride, const int *contact, const double *bound, const double *p, const double *slip, double r, double *weight,
                            double *direction, double *residual);
void contact_slip_project(int n, int stride, const double *weight, const double *direction, double *v);
void contact_slip_jacobian(int n, int stride, const double *weight, const double *direction, const double *dp, const double *change, double r,
                           const double *creep, double *out);
void contact_slip_join(int n, int stride, const double *weight, const double *direction, const double *v, const double *projected, double r, double *u);

#define LOOPS "../tangential/slip_bodies.h"
#include "../base/twice.h"

void contact_slip_residual(int n, int stride, const int *contact, const double *bound, const double *p, const double *slip, double r, double *sums) {
  CALL(residual, n, stride, contact, bound, p, slip, r, sums);
}

void contact_slip_step(int n, int stride, const int *contact, const double *bound, double alpha, const double *p, const double *d, double *out) {
  CALL(step, n, stride, contact, bound, alpha, p, d, out);
}

void contact_slip_linearise(int n, int stride, const int *contact, const double *bound, const double *p, const double *slip, double r, double *weight,
                            double *direction, double *residual) {
  CALL(linearise, n, stride, contact, bound, p, slip, r, weight, direction, residual);
}

void contact_slip_project(int n, int stride, const double *weight, const double *direction, double *v) { CALL(project_change, n, stride, weight, direction, v); }

void contact_slip_jacobian(int n, int stride, const double *weight, const double *direction, const double *dp, const double *change, double r,
                           const double *creep, double *out) {
  CALL(jacobian, n, stride, weight, direction, dp, change, r, creep, out);
}

void contact_slip_join(int n, int stride, const double *weight, const double *direction, const double *v, const double *projected, double r, double *u) {
  CALL(join, n, stride, weight, direction, v, projected, r, u);
}
