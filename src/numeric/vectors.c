/* Sums and inner products of long vectors, described in vectors.f90; lanes.h explains why they are in C */
#include "../base/lanes.h"

double contact_vectors_inner(int n, const double *a, const double *b);
void contact_vectors_add(int n, double factor, const double *a, double *b);
void contact_vectors_inner_four(int n, int stride, const double *a, const double *b, double *sums);
void contact_vectors_add_four(int n, int stride, const double *factor, const double *a, double *b);

#define LOOPS "../numeric/vector_loops.h"
#include "../base/twice.h"

double contact_vectors_inner(int n, const double *a, const double *b) { return CALL(inner, n, a, b); }

void contact_vectors_add(int n, double factor, const double *a, double *b) { CALL(add, n, factor, a, b); }

void contact_vectors_inner_four(int n, int stride, const double *a, const double *b, double *sums) {
  CALL(inner_four, n, stride, a, b, sums);
}

void contact_vectors_add_four(int n, int stride, const double *factor, const double *a, double *b) {
  CALL(add_four, n, stride, factor, a, b);
}
