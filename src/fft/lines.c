/* Time-consuming operations on rows and columns between their transforms, described in lines.f90; lanes.h explains why they are in
 * C. Complex numbers are pairs of real ones. */
#include "../base/lanes.h"

#define NUMBERS_SWAPPED(v) __builtin_shufflevector(v, v, 2, 3, 0, 1)
#define REAL_PARTS(v) __builtin_shufflevector(v, v, 0, 0, 2, 2)
#define IMAGINARY_PARTS(v) __builtin_shufflevector(v, v, 1, 1, 3, 3)

static const four conjugate = {1.0, -1.0, 1.0, -1.0};

void contact_lines_one(int n, const double *xx, double *a);
void contact_lines_pair(int px, const double *xx, const double *yy, const double *xy, double *z);
void contact_lines_turn_pair(int px, const double *factor, double *z);

static void turn_number(double re, double im, double *z) {
  const double keep = z[0];
  z[0] = re * keep - im * z[1];
  z[1] = re * z[1] + im * keep;
}

/* Product for one frequency of `pair` and its negative, which may be the same */
static void multiply_pair(double xx, double yy, double xy, double *here, double *there) {
  const double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy);
  const double x[2] = {here[0], here[1]}, y[2] = {there[0], there[1]};
  here[0] = mean * x[0] + (half * y[0] + xy * y[1]);
  here[1] = mean * x[1] + (xy * y[0] - half * y[1]);
  there[0] = mean * y[0] + (half * x[0] + xy * x[1]);
  there[1] = mean * y[1] + (xy * x[0] - half * x[1]);
}

#define LOOPS "../fft/line_loops.h"
#include "../base/twice.h"

void contact_lines_one(int n, const double *xx, double *a) { CALL(one, n, xx, a); }

void contact_lines_pair(int px, const double *xx, const double *yy, const double *xy, double *z) {
  CALL(pair, px, xx, yy, xy, z);
}

void contact_lines_turn_pair(int px, const double *factor, double *z) { CALL(turn_pair, px, factor, z); }
