/* Displacements as direct sums over the pressures, described in pressure_sums.f90; lanes.h explains why they are in C */
#include "../base/lanes.h"

void contact_sums_displace(int mx, int my, const int *ranges, int nx, int ny, const double *nn, const double *p, double *u);
void contact_sums_ranges(int mx, int my, const double *a, int first, int *ranges);

#define LOOPS "../elastic/sum_bodies.h"
#include "../base/twice.h"

void contact_sums_displace(int mx, int my, const int *ranges, int nx, int ny, const double *nn, const double *p, double *u) {
  CALL(displace, mx, my, ranges, nn + nx + (long)ny * (2 * nx + 1), 2 * nx + 1, p, u);
}

void contact_sums_ranges(int mx, int my, const double *a, int first, int *ranges) { CALL(ranges, mx, my, a, 4, ranges + first); }
