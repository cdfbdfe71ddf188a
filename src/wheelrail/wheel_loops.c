/* Points of a wheel over a row of elements, described in wheel_loops.f90; lanes.h explains why they are in C */
#include "../base/lanes.h"

void contact_wheel_meet(const double *piece, const double *y, const double *z, double radius, const double *base, const double *axis,
                       const double *along, double near, double tolerance, int most_steps, const double *x, double *place, double *n,
                        int *found);
void contact_wheel_spread(const double *p, int n, double *values);

#define LOOPS "../wheelrail/wheel_bodies.h"
#include "../base/twice.h"

void contact_wheel_meet(const double *piece, const double *y, const double *z, double radius, const double *base, const double *axis,
                       const double *along, double near, double tolerance, int most_steps, const double *x, double *place, double *n,
                        int *found) {
  *found = CALL(meet, piece, y, z, radius, base, axis, along, near, tolerance, most_steps, x, place, n);
}

void contact_wheel_spread(const double *p, int n, double *values) { CALL(spread, p, n, values); }
