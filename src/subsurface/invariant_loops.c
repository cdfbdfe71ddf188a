/* Mean, equivalent and principal stresses of four points at once, described in invariants.f90; lanes.h explains why they are in
 * C */
#include "../base/lanes.h"
#include <float.h>
#include <stddef.h>

/* Entries of a matrix whose largest one is 1: their squares might underflow; a fraction of the machine precision */
#define NEGLIGIBLE 1e-100
#define CONVERGED (0.01 * DBL_EPSILON)
enum { MOST_SWEEPS = 20 };

void contact_stress_invariants(int n, const double *stress, double *mean, double *mises, double *tresca, double *first,
                               double *second, double *third);

#define LOOPS "../subsurface/invariant_bodies.h"
#include "../base/twice.h"

void contact_stress_invariants(int n, const double *stress, double *mean, double *mises, double *tresca, double *first,
                               double *second, double *third) {
  double *const principal[3] = {first, second, third};
  CALL(invariants, n, stress, mean, mises, tresca, principal);
}
