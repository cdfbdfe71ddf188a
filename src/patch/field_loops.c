/* Loops over the elements of a patch, described in field_loops.f90; lanes.h explains why they are in C */
#include "../base/lanes.h"

void contact_fields_subtract(int n, double approach, double excluded, double *h);
int contact_fields_mark(int n, int exterior, int adhesion, const double *pn, double *px, double *py, int *division);

#define LOOPS "../patch/field_bodies.h"
#include "../base/twice.h"

void contact_fields_subtract(int n, double approach, double excluded, double *h) { CALL(subtract, n, approach, excluded, h); }

int contact_fields_mark(int n, int exterior, int adhesion, const double *pn, double *px, double *py, int *division) {
  return CALL(mark, n, exterior, adhesion, pn, px, py, division);
}
