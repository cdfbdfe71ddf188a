/* Loops of lines.c for one kind of processor: OF(name) is the name of a function in that version, TARGET its attribute.
 *
 * Two complex numbers are processed at once. Each loop ends with the remaining one of an odd number. */

/* Products of two spectra with a symmetric 2 by 2 block, then with a scalar unless turn is null */
TARGET static void OF(block)(int n, const double *xx, const double *yy, const double *xy, const double *turn, double *a, double *b) {
  const double re = turn ? turn[0] : 1.0, im = turn ? turn[1] : 0.0;
  const four along = {re, re, re, re}, across = {-im, im, -im, im};
  int k = 0;
  for (; k + 1 < n; k += 2) {
    const four x = EACH_TWICE(xx + k), y = EACH_TWICE(yy + k), w = EACH_TWICE(xy + k);
    const four here = FOUR(a + 2 * k), there = FOUR(b + 2 * k);
    four first = x * here + w * there, second = w * here + y * there;
    if (turn) {
      first = along * first + across * PARTS_SWAPPED(first);
      second = along * second + across * PARTS_SWAPPED(second);
    }
    FOUR(a + 2 * k) = first;
    FOUR(b + 2 * k) = second;
  }
  if (k == n) return;
  for (int i = 2 * k; i < 2 * k + 2; i++) {
    const double here = a[i], there = b[i];
    a[i] = xx[k] * here + xy[k] * there;
    b[i] = xy[k] * here + yy[k] * there;
  }
  if (!turn) return;
  turn_number(re, im, a + 2 * k);
  turn_number(re, im, b + 2 * k);
}

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

/* Twice the transforms of two rows, from that of the first + i times the second; both values of a frequency are adjacent */
TARGET static void OF(apart)(int px, const double *z, size_t stride, double *both) {
  int k = 1;
  for (; k + 1 <= px / 2; k += 2) {
    const four here = FOUR(z + 2 * k), there = NUMBERS_SWAPPED(FOUR(z + 2 * (px - k - 1)));
    const four first = here + conjugate * there, second = PARTS_SWAPPED(there) + conjugate * PARTS_SWAPPED(here);
    FOUR(both + stride * k) = FIRST_OF_BOTH(first, second);
    FOUR(both + stride * (k + 1)) = SECOND_OF_BOTH(first, second);
  }
  if (k > px / 2) return;
  {
    const double *here = z + 2 * k, *there = z + 2 * (px - k);
    double *to = both + stride * k;
    to[0] = here[0] + there[0];
    to[1] = here[1] - there[1];
    to[2] = there[1] + here[1];
    to[3] = there[0] - here[0];
  }
}

/* Transform of the first row + i times the second, from the adjacent values of both */
TARGET static void OF(together)(int px, size_t stride, const double *both, double *z) {
  const int n = (px + 1) / 2;
  int k = 1;
  for (; k + 1 < n; k += 2) {
    const four a = FOUR(both + stride * k), b = FOUR(both + stride * (k + 1));
    const four first = FIRST_OF_BOTH(a, b), second = PARTS_SWAPPED(SECOND_OF_BOTH(a, b));
    FOUR(z + 2 * k) = first - conjugate * second;
    FOUR(z + 2 * (px - k - 1)) = NUMBERS_SWAPPED(conjugate * first + second);
  }
  if (k >= n) return;
  {
    const double *from = both + stride * k;
    z[2 * k] = from[0] - from[3];
    z[2 * k + 1] = from[1] + from[2];
    z[2 * (px - k)] = from[0] + from[3];
    z[2 * (px - k) + 1] = from[2] - from[1];
  }
}
