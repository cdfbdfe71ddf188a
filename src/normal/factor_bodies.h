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

/* Solve with the lower triangle, by blocks of rows */
TARGET static void OF(forward)(int n, int stride, const double *lower, double *x) {
  enum { block = 16 };
  for (int i = 0; i < n; i += block) {
    const int rows = n - i < block ? n - i : block;
    OF(subtract_product)(rows, i, stride, lower + i, x, x + i);
    for (int j = 0; j < rows; j++) {
      const double *column = lower + i + (long)(i + j) * stride;
      x[i + j] /= column[j];
      for (int k = j + 1; k < rows; k++) x[i + k] -= x[i + j] * column[k];
    }
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

/* Factorise the columns from `first` on; 0 if a pivot is not positive */
TARGET static int OF(factorize)(int n, int first, int stride, double *a, double *row) {
  for (int j = first; j < n; j++) {
    double *column = a + (long)j * stride;
    for (int k = 0; k < j; k++) row[k] = a[j + (long)k * stride];
    OF(subtract_product)(n - j, j, stride, a + j, row, column + j);
    if (!(column[j] > 0.0)) return 0;
    const double scale = 1.0 / sqrt(column[j]);
    for (int i = j; i < n; i++) column[i] *= scale;
  }
  return 1;
}
