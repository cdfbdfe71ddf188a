/* Products of the spectra of responses and of tractions, described in response_packs.f90; lanes.h explains why they are in C */
#include "../base/lanes.h"

void contact_pack_product(int n, int half, const double *factor, double other_half, const int *flags, const double *traction, double *product);

/* As EACH_TWICE, in reverse order */
#define EACH_TWICE_BACK(at) __builtin_shufflevector(*(const two *)(at), *(const two *)(at), 1, 1, 0, 0)

#define LOOPS "../subsurface/pack_bodies.h"
#include "../base/twice.h"

void contact_pack_product(int n, int half, const double *factor, double other_half, const int *flags, const double *traction, double *product) {
  CALL(column, n, half, factor, other_half, flags[0], flags[1], traction, product);
}
