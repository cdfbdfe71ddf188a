/* Sums and inner products of long vectors, described in vectors.f90; lanes.h explains why they are in C */
#include "../base/lanes.h"

double contact_vectors_inner(int n, const double *a, const double *b);
void contact_vectors_add(int n, double factor, const double *a, double *b);
void contact_vectors_inner_four(int n, int stride, const double *a, const double *b, double *sums);
void contact_vectors_add_four(int n, int stride, const double *factor, const double *a, double *b);
double contact_vectors_smallest(int n, const double *a);
double contact_vectors_largest(int n, const double *a);
double contact_vectors_farthest(int n, const double *a, const double *b);

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

double contact_vectors_smallest(int n, const double *a) { return CALL(smallest, n, a); }

double contact_vectors_largest(int n, const double *a) { return CALL(largest, n, a); }

double contact_vectors_farthest(int n, const double *a, const double *b) { return CALL(farthest, n, a, b); }
