/* Sums and inner products of long vectors; vectors.f90 tells what, lanes.h why in C */
#include "../base/lanes.h"

double contact_vectors_inner(int n, const double *a, const double *b);
void contact_vectors_add(int n, double factor, const double *a, double *b);

#define OF(name) name##_anywhere
#define TARGET
#include "vector_loops.h"

#ifdef __x86_64__
#define OF(name) name##_avx2
#define TARGET FOR_AVX2
#include "vector_loops.h"
#endif

double contact_vectors_inner(int n, const double *a, const double *b) { return CALL(inner, n, a, b); }

void contact_vectors_add(int n, double factor, const double *a, double *b) { CALL(add, n, factor, a, b); }
