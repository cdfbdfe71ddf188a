/* Points of a wheel over a row of elements, described in wheel_loops.f90; lanes.h explains why they are in C */
#include "../base/lanes.h"

void contact_wheel_meet(int pieces, const double *ends, const double *cy, const double *cz, double radius, const double *base,
                        const double *axis, const double *along, double near, double tolerance, int most_steps, const double *x,
                        int *piece, double *place, double *n, int *found);
void contact_wheel_spread(const double *powers, const double *node, int n, double *values, double *last);
void contact_wheel_nodes(int n, const double *y, const double *z, const double *lean, const double *origin, const double *axes,
                         double radius, double furthest, double roller, double lowest, double start, double per_step, int points, double *x,
                         double *across, double *height, int *below);
void contact_wheel_locus(int n, const double *target, const double *rail, const int *piece, int pieces, const double *ends,
                         const double *cy, const double *cz, const double *origin, const double *axes, double radius, double furthest,
                         double roller, double lowest, double steepest, double accuracy, double tolerance, int most_steps, const double *place,
                         double *x, double *z, int *found);

#define LOOPS "../wheelrail/wheel_bodies.h"
#include "../base/twice.h"

void contact_wheel_meet(int pieces, const double *ends, const double *cy, const double *cz, double radius, const double *base,
                        const double *axis, const double *along, double near, double tolerance, int most_steps, const double *x,
                        int *piece, double *place, double *n, int *found) {
  *found = CALL(meet, pieces, ends, cy, cz, radius, base, axis, along, near, tolerance, most_steps, x, piece, place, n);
}

void contact_wheel_spread(const double *powers, const double *node, int n, double *values, double *last) {
  CALL(spread, powers, node, n, values, last);
}

void contact_wheel_nodes(int n, const double *y, const double *z, const double *lean, const double *origin, const double *axes,
                         double radius, double furthest, double roller, double lowest, double start, double per_step, int points, double *x,
                         double *across, double *height, int *below) {
  CALL(nodes, n, y, z, lean, origin, axes, radius, furthest, roller, lowest, start, per_step, points, x, across, height, below);
}

void contact_wheel_locus(int n, const double *target, const double *rail, const int *piece, int pieces, const double *ends,
                         const double *cy, const double *cz, const double *origin, const double *axes, double radius, double furthest,
                         double roller, double lowest, double steepest, double accuracy, double tolerance, int most_steps, const double *place,
                         double *x, double *z, int *found) {
  CALL(locus, n, target, rail, piece, pieces, ends, cy, cz, origin, axes, radius, furthest, roller, lowest, steepest, accuracy, tolerance,
       most_steps, place, x, z, found);
}
