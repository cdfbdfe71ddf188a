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

/* Product of a spectrum with a scalar */
TARGET static void OF(turn)(int n, const double *turn, double *a) {
  const four along = {turn[0], turn[0], turn[0], turn[0]}, across = {-turn[1], turn[1], -turn[1], turn[1]};
  int k = 0;
  for (; k + 1 < n; k += 2) {
    const four here = FOUR(a + 2 * k);
    FOUR(a + 2 * k) = along * here + across * PARTS_SWAPPED(here);
  }
  if (k < n) turn_number(turn[0], turn[1], a + 2 * k);
}

/* Frequencies x and their opposites y, these in reversed order, of two fields in one transform, times a symmetric block */
TARGET static void OF(opposites)(int n, const double *mean, const double *half, const double *mixed, double *x, double *y) {
  int k = 0;
  for (; k + 1 < n; k += 2) {
    double *back = y + 2 * (n - 2 - k);
    const four s = EACH_TWICE(mean + k), d = EACH_TWICE(half + k), w = EACH_TWICE(mixed + k);
    const four here = FOUR(x + 2 * k), there = NUMBERS_SWAPPED(FOUR(back));
    FOUR(x + 2 * k) = s * here + d * (conjugate * there) + w * PARTS_SWAPPED(there);
    FOUR(back) = NUMBERS_SWAPPED(s * there + d * (conjugate * here) + w * PARTS_SWAPPED(here));
  }
  if (k == n) return;
  {
    const double here[2] = {x[2 * k], x[2 * k + 1]}, there[2] = {y[0], y[1]};
    x[2 * k] = mean[k] * here[0] + half[k] * there[0] + mixed[k] * there[1];
    x[2 * k + 1] = mean[k] * here[1] - half[k] * there[1] + mixed[k] * there[0];
    y[0] = mean[k] * there[0] + half[k] * here[0] + mixed[k] * here[1];
    y[1] = mean[k] * there[1] - half[k] * here[1] + mixed[k] * here[0];
  }
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
