/* Points of a wheel over a row of elements, described in wheel_loops.f90; lanes.h explains why they are in C */
#include "../base/lanes.h"

void contact_wheel_meet(const double *piece, const double *y, const double *z, double radius, const double *base, const double *axis,
                       const double *along, double near, double tolerance, int most_steps, const double *x, double *place, double *n,
                        int *found);
void contact_wheel_spread(const double *p, int n, double *values);
void contact_wheel_nodes(int n, const double *y, const double *z, const double *lean, const double *origin, const double *axes,
                         double radius, double furthest, double start, double per_step, int points, double *x, double *across,
                         double *height, int *below);
void contact_wheel_locus(int n, const double *target, const int *piece, const double *ends, const double *cy, const double *cz,
                         const double *origin, const double *axes, double radius, double furthest, double steepest, double accuracy,
                         double tolerance, int most_steps, const double *place, double *x, double *z, int *found);

#define LOOPS "../wheelrail/wheel_bodies.h"
#include "../base/twice.h"

void contact_wheel_meet(const double *piece, const double *y, const double *z, double radius, const double *base, const double *axis,
                       const double *along, double near, double tolerance, int most_steps, const double *x, double *place, double *n,
                        int *found) {
  *found = CALL(meet, piece, y, z, radius, base, axis, along, near, tolerance, most_steps, x, place, n);
}

void contact_wheel_spread(const double *p, int n, double *values) { CALL(spread, p, n, values); }

void contact_wheel_nodes(int n, const double *y, const double *z, const double *lean, const double *origin, const double *axes,
                         double radius, double furthest, double start, double per_step, int points, double *x, double *across,
                         double *height, int *below) {
  CALL(nodes, n, y, z, lean, origin, axes, radius, furthest, start, per_step, points, x, across, height, below);
}

void contact_wheel_locus(int n, const double *target, const int *piece, const double *ends, const double *cy, const double *cz,
                         const double *origin, const double *axes, double radius, double furthest, double steepest, double accuracy,
                         double tolerance, int most_steps, const double *place, double *x, double *z, int *found) {
  CALL(locus, n, target, piece, ends, cy, cz, origin, axes, radius, furthest, steepest, accuracy, tolerance, most_steps, place, x, z,
       found);
}
