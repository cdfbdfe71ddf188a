/* Loops of lines.c for one kind of processor: OF(name) is the name of a function in that version, TARGET its attribute.
 *
 * Two complex numbers are processed at once. Each loop ends with the remaining one of an odd number. */

/* Product of a complex spectrum and a real one */
TARGET static void OF(one)(int n, const double *xx, double *a) {
  int k = 0;
  for (; k + 1 < n; k += 2) FOUR(a + 2 * k) *= EACH_TWICE(xx + k);
  if (k == n) return;
  a[2 * k] *= xx[k];
  a[2 * k + 1] *= xx[k];
}

/* Transform of two real lines, the first + i times the second, times a symmetric block that is even */
TARGET static void OF(pair)(int px, const double *xx, const double *yy, const double *xy, double *z) {
  const int n = (px + 1) / 2;
  int k = 1;
  multiply_pair(xx[0], yy[0], xy[0], z, z);
  if (px % 2 == 0) multiply_pair(xx[px / 2], yy[px / 2], xy[px / 2], z + px, z + px);
  for (; k + 1 < n; k += 2) {
    double *back = z + 2 * (px - k - 1);
    const four x = EACH_TWICE(xx + k), y = EACH_TWICE(yy + k), w = EACH_TWICE(xy + k);
    const four s = 0.5 * (x + y), d = 0.5 * (x - y);
    const four here = FOUR(z + 2 * k), there = NUMBERS_SWAPPED(FOUR(back));
    FOUR(z + 2 * k) = s * here + (d * (conjugate * there) + w * PARTS_SWAPPED(there));
    FOUR(back) = NUMBERS_SWAPPED(s * there + (d * (conjugate * here) + w * PARTS_SWAPPED(here)));
  }
  if (k < n) multiply_pair(xx[k], yy[k], xy[k], z + 2 * k, z + 2 * (px - k));
}

/* Product of such a transform and that of another real line, of which one half is given */
TARGET static void OF(turn_pair)(int px, const double *factor, double *z) {
  const int n = (px + 1) / 2;
  int k = 1;
  turn_number(factor[0], factor[1], z);
  if (px % 2 == 0) turn_number(factor[px], factor[px + 1], z + px);
  for (; k + 1 < n; k += 2) {
    double *back = z + 2 * (px - k - 1);
    const four f = FOUR(factor + 2 * k), re = REAL_PARTS(f), im = conjugate * IMAGINARY_PARTS(f);
    const four here = FOUR(z + 2 * k), there = NUMBERS_SWAPPED(FOUR(back));
    FOUR(z + 2 * k) = re * here - im * PARTS_SWAPPED(here);
    FOUR(back) = NUMBERS_SWAPPED(re * there + im * PARTS_SWAPPED(there));
  }
  if (k == n) return;
  turn_number(factor[2 * k], factor[2 * k + 1], z + 2 * k);
  turn_number(factor[2 * k], -factor[2 * k + 1], z + 2 * (px - k));
}
