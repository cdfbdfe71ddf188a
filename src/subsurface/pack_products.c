/* Products of the spectra of responses and of tractions; response_packs.f90 tells what, lanes.h why in C */
#include "../base/lanes.h"

void contact_pack_product(int n, int half, const double *factor, double other_half, const int *flags, const double *traction, double *product);

typedef double two __attribute__((vector_size(16), aligned(8), may_alias));

/* Two numbers, each for both parts of a complex one, in their order and in reverse */
#define EACH_TWICE(at) __builtin_shufflevector(*(const two *)(at), *(const two *)(at), 0, 0, 1, 1)
#define EACH_TWICE_BACK(at) __builtin_shufflevector(*(const two *)(at), *(const two *)(at), 1, 1, 0, 0)
#define PARTS_SWAPPED(v) __builtin_shufflevector(v, v, 1, 0, 3, 2)

#define OF(name) name##_anywhere
#define TARGET
#include "pack_bodies.h"

#ifdef __x86_64__
#define OF(name) name##_avx2
#define TARGET FOR_AVX2
#include "pack_bodies.h"
#endif

void contact_pack_product(int n, int half, const double *factor, double other_half, const int *flags, const double *traction, double *product) {
  CALL(column, n, half, factor, other_half, flags[0], flags[1], traction, product);
}
