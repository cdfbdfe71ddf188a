/* Loops of factor_loops.c, for one kind of processor; see lanes.h. Matrices are stored by columns, `stride` numbers
 * apart */

/* y := y - a t for `rows` rows and `columns` columns; rows in groups whose sums stay in registers */
TARGET static void OF(subtract_product)(int rows, int columns, int stride, const double *a, const double *t, double *y) {
  int i = 0;
  for (; i + 15 < rows; i += 16) {
    four y0 = READ_FOUR(y + i), y1 = READ_FOUR(y + i + 4), y2 = READ_FOUR(y + i + 8), y3 = READ_FOUR(y + i + 12);
    const double *column = a + i;
    for (int k = 0; k < columns; k++, column += stride) {
      const four factor = {t[k], t[k], t[k], t[k]};
      y0 -= factor * READ_FOUR(column);
      y1 -= factor * READ_FOUR(column + 4);
      y2 -= factor * READ_FOUR(column + 8);
      y3 -= factor * READ_FOUR(column + 12);
    }
    FOUR(y + i) = y0;
    FOUR(y + i + 4) = y1;
    FOUR(y + i + 8) = y2;
    FOUR(y + i + 12) = y3;
  }
  for (; i + 3 < rows; i += 4) {
    four sum = READ_FOUR(y + i);
    const double *column = a + i;
    for (int k = 0; k < columns; k++, column += stride) sum -= t[k] * READ_FOUR(column);
    FOUR(y + i) = sum;
  }
  for (; i < rows; i++) {
    double sum = y[i];
    const double *column = a + i;
    for (int k = 0; k < columns; k++, column += stride) sum -= t[k] * *column;
    y[i] = sum;
  }
}

/* Solve with the lower triangle, four columns at a time */
TARGET static void OF(forward)(int n, int stride, const double *lower, double *x) {
  int j = 0;
  for (; j + 3 < n; j += 4) {
    const double *c0 = lower + (long)j * stride, *c1 = c0 + stride, *c2 = c1 + stride, *c3 = c2 + stride;
    const double x0 = x[j] / c0[j], x1 = (x[j + 1] - c0[j + 1] * x0) / c1[j + 1];
    const double x2 = (x[j + 2] - c0[j + 2] * x0 - c1[j + 2] * x1) / c2[j + 2];
    const double x3 = (x[j + 3] - c0[j + 3] * x0 - c1[j + 3] * x1 - c2[j + 3] * x2) / c3[j + 3];
    x[j] = x0;
    x[j + 1] = x1;
    x[j + 2] = x2;
    x[j + 3] = x3;
    const four f0 = {x0, x0, x0, x0}, f1 = {x1, x1, x1, x1}, f2 = {x2, x2, x2, x2}, f3 = {x3, x3, x3, x3};
    int i = j + 4;
    for (; i + 7 < n; i += 8) {
      four y = READ_FOUR(x + i), z = READ_FOUR(x + i + 4);
      y -= f0 * READ_FOUR(c0 + i);
      z -= f0 * READ_FOUR(c0 + i + 4);
      y -= f1 * READ_FOUR(c1 + i);
      z -= f1 * READ_FOUR(c1 + i + 4);
      y -= f2 * READ_FOUR(c2 + i);
      z -= f2 * READ_FOUR(c2 + i + 4);
      y -= f3 * READ_FOUR(c3 + i);
      z -= f3 * READ_FOUR(c3 + i + 4);
      FOUR(x + i) = y;
      FOUR(x + i + 4) = z;
    }
    for (; i + 3 < n; i += 4)
      FOUR(x + i) = READ_FOUR(x + i) - f0 * READ_FOUR(c0 + i) - f1 * READ_FOUR(c1 + i) - f2 * READ_FOUR(c2 + i) - f3 * READ_FOUR(c3 + i);
    for (; i < n; i++) x[i] = x[i] - x0 * c0[i] - x1 * c1[i] - x2 * c2[i] - x3 * c3[i];
  }
  for (; j < n; j++) {
    const double *column = lower + (long)j * stride;
    x[j] /= column[j];
    for (int i = j + 1; i < n; i++) x[i] -= x[j] * column[i];
  }
}

/* Solve with the transposed lower triangle, four rows at a time */
TARGET static void OF(backward)(int n, int stride, const double *lower, double *x) {
  int end = n;
  for (; end > 3; end -= 4) {
    const double *c0 = lower + (long)(end - 4) * stride, *c1 = c0 + stride, *c2 = c1 + stride, *c3 = c2 + stride;
    four s0 = {0.0}, s1 = {0.0}, s2 = {0.0}, s3 = {0.0};
    int i = end;
    for (; i + 3 < n; i += 4) {
      const four known = READ_FOUR(x + i);
      s0 += READ_FOUR(c0 + i) * known;
      s1 += READ_FOUR(c1 + i) * known;
      s2 += READ_FOUR(c2 + i) * known;
      s3 += READ_FOUR(c3 + i) * known;
    }
    double sum[4] = {SUM_OF(s0), SUM_OF(s1), SUM_OF(s2), SUM_OF(s3)};
    for (; i < n; i++) {
      sum[0] += c0[i] * x[i];
      sum[1] += c1[i] * x[i];
      sum[2] += c2[i] * x[i];
      sum[3] += c3[i] * x[i];
    }
    double *y = x + end - 4;
    const double *d0 = c0 + end - 4, *d1 = c1 + end - 4, *d2 = c2 + end - 4, *d3 = c3 + end - 4;
    y[3] = (y[3] - sum[3]) / d3[3];
    y[2] = (y[2] - sum[2] - d2[3] * y[3]) / d2[2];
    y[1] = (y[1] - sum[1] - d1[3] * y[3] - d1[2] * y[2]) / d1[1];
    y[0] = (y[0] - sum[0] - d0[3] * y[3] - d0[2] * y[2] - d0[1] * y[1]) / d0[0];
  }
  for (int j = end - 1; j >= 0; j--) {
    const double *column = lower + (long)j * stride;
    double sum = x[j];
    for (int i = j + 1; i < n; i++) sum -= column[i] * x[i];
    x[j] = sum / column[j];
  }
}

/* Factorise; 0 if a pivot is not positive */
TARGET static int OF(factorize)(int n, int stride, double *a, double *row) {
  for (int j = 0; j < n; j++) {
    double *column = a + (long)j * stride;
    for (int k = 0; k < j; k++) row[k] = a[j + (long)k * stride];
    OF(subtract_product)(n - j, j, stride, a + j, row, column + j);
    if (!(column[j] > 0.0)) return 0;
    const double scale = 1.0 / sqrt(column[j]);
    for (int i = j; i < n; i++) column[i] *= scale;
  }
  return 1;
}

/* Remove a row and column of the matrix from its factor of n rows. Those behind it move up, and rotations put the removed column
 * into their triangle, and into the solutions w of L w = b for two right-hand sides. Workspace: n numbers */
TARGET static void OF(remove)(int n, int removed, int stride, double *a, double *v, double *w) {
  const int rest = n - removed - 1;
  double *one = w + removed, *other = w + stride + removed, left = *one, right = *other;
  for (int i = 0; i < rest; i++) v[i] = a[removed + 1 + i + (long)removed * stride];
  for (int j = 0; j < removed; j++) {
    double *column = a + removed + (long)j * stride;
    int i = 0;
    for (; i + 3 < rest; i += 4) FOUR(column + i) = READ_FOUR(column + i + 1);
    for (; i < rest; i++) column[i] = column[i + 1];
  }
  for (int j = 0; j < rest; j++) {
    double *to = a + removed + j + (long)(removed + j) * stride, *y = v + j;
    const double *from = to + 1 + stride, diagonal = sqrt(from[0] * from[0] + y[0] * y[0]);
    const double c = from[0] / diagonal, s = y[0] / diagonal, first = one[j + 1], second = other[j + 1];
    const four cc = {c, c, c, c}, ss = {s, s, s, s};
    int i = 1;
    to[0] = diagonal;
    one[j] = c * first + s * left;
    left = c * left - s * first;
    other[j] = c * second + s * right;
    right = c * right - s * second;
    for (; i + 3 < rest - j; i += 4) {
      const four l = READ_FOUR(from + i), x = READ_FOUR(y + i);
      FOUR(to + i) = cc * l + ss * x;
      FOUR(y + i) = cc * x - ss * l;
    }
    for (; i < rest - j; i++) {
      const double l = from[i], x = y[i];
      to[i] = c * l + s * x;
      y[i] = c * x - s * l;
    }
  }
}

/* Append a row to the factor of n rows; 0 if the pivot is not positive. `row` is that of the matrix, with its diagonal, `w` are the
 * solutions of L w = b for two right-hand sides, `b` those of the row */
TARGET static int OF(append)(int n, int stride, double *a, double *row, double *w, const double *b) {
  OF(forward)(n, stride, a, row);
  double pivot = row[n], one = b[0], other = b[1];
  for (int k = 0; k < n; k++) {
    pivot -= row[k] * row[k];
    one -= row[k] * w[k];
    other -= row[k] * w[stride + k];
  }
  if (!(pivot > 0.0)) return 0;
  for (int k = 0; k < n; k++) a[n + (long)k * stride] = row[k];
  pivot = sqrt(pivot);
  a[n + (long)n * stride] = pivot;
  w[n] = one / pivot;
  w[stride + n] = other / pivot;
  return 1;
}

/* Largest violation of the contact conditions, see factor_loops.f90. What is stored where neither condition holds is not used */
TARGET static double OF(violation)(int n, double pen, const double *h, const double *u, const double *p) {
  const four zero = {0.0, 0.0, 0.0, 0.0}, approach = zero + pen;
  four most = zero;
  double worst = 0.0;
  int i = 0;
  for (; i + 3 < n; i += 4) {
    const four open = READ_FOUR(h + i), r = approach - open - READ_FOUR(u + i);
    const four_masks pressed = READ_FOUR(p + i) > 0.0, counts = pressed | ((open < approach) & (r > 0.0));
    const four here = WHERE(counts, MAGNITUDES(r));
    most = CHOOSE(here > most, here, most);
  }
  for (; i < n; i++) {
    const double r = pen - h[i] - u[i];
    if (!(p[i] > 0.0 || (h[i] < pen && r > 0.0))) continue;
    worst = fabs(r) > worst ? fabs(r) : worst;
  }
  for (int lane = 0; lane < 4; lane++) worst = most[lane] > worst ? most[lane] : worst;
  return worst;
}

/* Number of positive numbers of a field; first and last column, first and last row of the window around them, counted from 1 */
TARGET static int OF(box)(int mx, int my, const double *p, int *box) {
  int n = 0, first = mx, last = -1, top = my, bottom = -1;
  for (int iy = 0; iy < my; iy++, p += mx) {
    four_masks counts = {0, 0, 0, 0};
    int here = 0, ix = 0;
    for (; ix + 3 < mx; ix += 4) counts -= READ_FOUR(p + ix) > 0.0;
    for (; ix < mx; ix++) here += p[ix] > 0.0;
    here += (int)(counts[0] + counts[1] + counts[2] + counts[3]);
    if (here == 0) continue;
    n += here;
    if (top > iy) top = iy;
    bottom = iy;
    for (ix = 0; ix < first && !(p[ix] > 0.0); ix++) {}
    first = ix < first ? ix : first;
    for (ix = mx - 1; ix > last && !(p[ix] > 0.0); ix--) {}
    last = ix > last ? ix : last;
  }
  box[0] = first + 1;
  box[1] = last + 1;
  box[2] = top + 1;
  box[3] = bottom + 1;
  return n;
}
