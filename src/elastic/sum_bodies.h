/* Loops of sum_loops.c, for one kind of processor; see lanes.h */

/* Displacements of 4*groups elements of a row, the last four of which may overlap the others. Each element adds all pressures in
 * the same order. See `displace` */
TARGET static inline __attribute__((always_inline)) void OF(some)(const int groups, int start, int end, int mx, int my, const int *ranges,
                                                                  const double *own, int stride, int iy, const double *p,
                                                                  double *u) {
  four sum[6];
  int at[6];
  for (int g = 0; g < groups; g++) {
    sum[g] = (four){0.0};
    at[g] = start + 4 * g < end - 4 ? start + 4 * g : end - 4;
  }
  for (int l = 0; l < my; l++) {
    const double *row = own + (long)(l > iy ? l - iy : iy - l) * stride, *here = p + (long)l * mx;
#pragma GCC unroll 2
    for (int k = ranges[4 * l]; k < ranges[4 * l + 1]; k++)
      for (int g = 0; g < groups; g++) sum[g] += here[k] * READ_FOUR(row + at[g] - k);
  }
  for (int g = 0; g < groups; g++) FOUR(u + at[g]) = sum[g];
}

/* Displacements of a range of elements in each row due to a range of pressures in each row: `ranges` has the bounds of both. `own`
 * is the coefficient of an element on itself in a table that is even in both directions, with rows of `stride` numbers */
TARGET static void OF(displace)(int mx, int my, const int *ranges, const double *own, int stride, const double *p, double *u) {
  enum { most = 6 };
  for (int iy = 0; iy < my; iy++) {
    double *row = u + (long)iy * mx;
    const int from = ranges[4 * iy + 2], to = ranges[4 * iy + 3], groups = (to - from + 3) / 4;
    if (to <= from) continue;
    if (to - from < 4) {
      for (int ix = from; ix < to; ix++) {
        double sum = 0.0;
        for (int l = 0; l < my; l++) {
          const double *c = own + (long)(l > iy ? l - iy : iy - l) * stride + ix;
          for (int k = ranges[4 * l]; k < ranges[4 * l + 1]; k++) sum += p[(long)l * mx + k] * c[-k];
        }
        row[ix] = sum;
      }
      continue;
    }
    /* in parts of nearly equal size */
    const int parts = (groups + most - 1) / most, each = (groups + parts - 1) / parts;
    for (int g = 0; g < groups; g += each) {
      const int n = groups - g < each ? groups - g : each, start = from + 4 * g;
      switch (n) {
      case 1: OF(some)(1, start, to, mx, my, ranges, own, stride, iy, p, row); break;
      case 2: OF(some)(2, start, to, mx, my, ranges, own, stride, iy, p, row); break;
      case 3: OF(some)(3, start, to, mx, my, ranges, own, stride, iy, p, row); break;
      case 4: OF(some)(4, start, to, mx, my, ranges, own, stride, iy, p, row); break;
      case 5: OF(some)(5, start, to, mx, my, ranges, own, stride, iy, p, row); break;
      default: OF(some)(most, start, to, mx, my, ranges, own, stride, iy, p, row);
      }
    }
  }
}

/* Elements before and up to the end of the range of positive numbers in each row, 0 if there are none */
TARGET static void OF(ranges)(int mx, int my, const double *a, int stride, int *ranges) {
  for (int iy = 0; iy < my; iy++, a += mx, ranges += stride) {
    int before = 0, end = mx;
    while (end >= 4) {
      const four_masks positive = READ_FOUR(a + end - 4) > 0.0;
      if ((positive[0] | positive[1] | positive[2] | positive[3]) != 0) break;
      end -= 4;
    }
    while (end > 0 && !(a[end - 1] > 0.0)) end--;
    while (before + 4 < end) {
      const four_masks positive = READ_FOUR(a + before) > 0.0;
      if ((positive[0] | positive[1] | positive[2] | positive[3]) != 0) break;
      before += 4;
    }
    while (before < end && !(a[before] > 0.0)) before++;
    ranges[0] = before;
    ranges[1] = end;
  }
}
