/* Sums over the nodes around an argument, most of the work of a look-up; called from creep_table.f90.
 *
 * In C, because it is compiled twice: for all processors, and for those with AVX2 and FMA, selected at run time. Both versions
 * agree up to round-off. The vector types are extensions of GCC and Clang. */
#include <stddef.h>
#include <string.h>

/* Nodes along an axis, values of a node, number of values of a row of nodes along z */
enum { ORDER = 4, VALUES = 3, STRETCH = ORDER * VALUES };

/* Data of the sum: coefficients; blocks of nodes along x, y, z, with the number of coefficients before each and its weight;
 * strides in coefficients between nodes along y and along x; functions along x and y, and their slopes, null if not needed */
typedef struct {
  const float *coefficients;
  int blocks;
  const int *start;
  const double *weight;
  ptrdiff_t row, plane;
  const double *x, *y, *slope_x, *slope_y;
} stretches;

void contact_sums_of_nodes(const float *coefficients, int blocks, const int *start, const double *weight, int row, int plane,
                        const double *x, const double *y, double *sums, const double *slope_x, const double *slope_y);

#define SUM sum_by_twos
#define LANES 2
#define WIDENED(v) {(v)[0], (v)[1]}
#include "sums_by_lanes.h"

#ifdef __x86_64__
#define SUM __attribute__((target("avx2,fma"))) sum_by_fours
#define LANES 4
#define WIDENED(v) {(v)[0], (v)[1], (v)[2], (v)[3]}
#include "sums_by_lanes.h"

static int has_fours(void) { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }
#else
static int has_fours(void) { return 0; }
#define sum_by_fours sum_by_twos
#endif

void contact_sums_of_nodes(const float *coefficients, int blocks, const int *start, const double *weight, int row, int plane,
                        const double *x, const double *y, double *sums, const double *slope_x, const double *slope_y) {
  const stretches all = {coefficients, blocks, start, weight, row, plane, x, y, slope_x, slope_y};
  if (has_fours())
    sum_by_fours(&all, sums);
  else
    sum_by_twos(&all, sums);
}
