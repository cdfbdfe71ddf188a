/* Transforms of rows and columns of four_lines.c, for one kind of processor; after four_steps.h */

/* Four numbers, from each of four lines: two vectors of the first numbers, two of the second ones */
INLINE void OF(across)(const double *const *at, four *v) {
  const four a = BOTH(at[0], at[2]), b = BOTH(at[1], at[3]), c = BOTH(at[0] + 2, at[2] + 2), d = BOTH(at[1] + 2, at[3] + 2);
  v[0] = FIRST_OF_PAIRS(a, b);
  v[1] = SECOND_OF_PAIRS(a, b);
  v[2] = FIRST_OF_PAIRS(c, d);
  v[3] = SECOND_OF_PAIRS(c, d);
}

/* The reverse */
INLINE void OF(along)(const four *v, double *const *at) {
  const four a = FIRST_OF_PAIRS(v[0], v[1]), b = SECOND_OF_PAIRS(v[0], v[1]);
  const four c = FIRST_OF_PAIRS(v[2], v[3]), d = SECOND_OF_PAIRS(v[2], v[3]);
  PAIR(at[0]) = LOWER(a);
  PAIR(at[1]) = LOWER(b);
  PAIR(at[2]) = UPPER(a);
  PAIR(at[3]) = UPPER(b);
  PAIR(at[0] + 2) = LOWER(c);
  PAIR(at[1] + 2) = LOWER(d);
  PAIR(at[2] + 2) = UPPER(c);
  PAIR(at[3] + 2) = UPPER(d);
}

/* Half of up to eight rows of mx numbers, as real and imaginary parts of four lines */
TARGET static void OF(read_rows)(int mx, int rows, const double *field, double *x) {
  int ix = 0;
  if (rows == ROWS)
    for (; ix + 4 <= mx; ix += 4)
      for (int part = 0; part < 2; part++) {
        const double *at[4];
        four v[4];
        for (int l = 0; l < 4; l++) at[l] = field + (size_t)mx * (2 * l + part) + ix;
        OF(across)(at, v);
        for (int k = 0; k < 4; k++) FOUR(x + 8 * (size_t)(ix + k) + 4 * part) = 0.5 * v[k];
      }
  for (; ix < mx; ix++)
    for (int row = 0; row < ROWS; row++)
      x[8 * (size_t)ix + 4 * (row % 2) + row / 2] = row < rows ? 0.5 * field[(size_t)mx * row + ix] : 0.0;
}

/* The reverse, without the factor */
TARGET static void OF(write_rows)(int mx, int rows, const double *x, double *field) {
  int ix = 0;
  if (rows == ROWS)
    for (; ix + 4 <= mx; ix += 4)
      for (int part = 0; part < 2; part++) {
        double *at[4];
        four v[4];
        for (int l = 0; l < 4; l++) at[l] = field + (size_t)mx * (2 * l + part) + ix;
        for (int k = 0; k < 4; k++) v[k] = READ_FOUR(x + 8 * (size_t)(ix + k) + 4 * part);
        OF(along)(v, at);
      }
  for (; ix < mx; ix++)
    for (int row = 0; row < rows; row++) field[(size_t)mx * row + ix] = x[8 * (size_t)ix + 4 * (row % 2) + row / 2];
}

/* Transforms of up to eight rows, from those of pairs of rows with half the values. For each row there are the real parts of four
 * frequencies, and their imaginary parts; the next four frequencies are `stride` numbers further on */
TARGET static void OF(separate)(const int *positions, int px, int rows, size_t stride, const double *z, double *half) {
  double spare[16];
  for (int k = 0; k <= px / 2; k += 4, half += stride) {
    /* real and imaginary parts of the first and of the second rows */
    four v[4][4] = {{{0.0}}};
    for (int j = 0; j < 4 && k + j <= px / 2; j++) {
      number here, there;
      OF(read)(z, positions[k + j], &here);
      OF(read)(z, positions[k + j > 0 ? px - k - j : 0], &there);
      v[0][j] = here.re + there.re;
      v[1][j] = here.im - there.im;
      v[2][j] = here.im + there.im;
      v[3][j] = there.re - here.re;
    }
    for (int part = 0; part < 4; part++) {
      double *at[4];
      for (int l = 0; l < 4; l++) at[l] = (2 * l + part / 2 < rows ? half + 16 * l : spare) + 4 * part;
      OF(along)(v[part], at);
    }
  }
}

/* The reverse, of rows with real values, with real and imaginary parts exchanged */
TARGET static void OF(put_together)(const int *positions, int px, int rows, size_t stride, const double *half, double *z) {
  static const double zeros[16] = {0.0};
  for (int k = 0; k <= px / 2; k += 4, half += stride) {
    four v[4][4];
    for (int part = 0; part < 4; part++) {
      const double *at[4];
      for (int l = 0; l < 4; l++) at[l] = (2 * l + part / 2 < rows ? half + 16 * l : zeros) + 4 * part;
      OF(across)(at, v[part]);
    }
    for (int j = 0; j < 4 && k + j <= px / 2; j++) {
      number here, there;
      if (k + j == 0 || 2 * (k + j) == px) {
        here.re = v[2][j];
        here.im = v[0][j];
      } else {
        here.re = v[1][j] + v[2][j];
        here.im = v[0][j] - v[3][j];
        there.re = v[2][j] - v[1][j];
        there.im = v[0][j] + v[3][j];
        OF(write)(z, positions[px - k - j], &there);
      }
      OF(write)(z, positions[k + j], &here);
    }
  }
}

/* Up to four columns of n complex numbers of a spectrum, with real and imaginary parts exchanged, to the positions of the
 * frequencies; a missing column is replaced by the first one */
TARGET static void OF(read_columns)(const int *positions, int n, int columns, const double *spectrum, double *x) {
  const double *at[4];
  for (int l = 0; l < 4; l++) at[l] = spectrum + 2 * (size_t)n * (size_t)(l < columns ? l : 0);
  for (int k = 0; k < n; k += 2) {
    four v[4] = {{0.0}};
    if (k + 1 < n) OF(across)(at, v);
    else
      for (int part = 0; part < 2; part++) v[part] = (four){at[0][part], at[1][part], at[2][part], at[3][part]};
    for (int j = k; j < k + 2 && j < n; j++) {
      const number a = {v[2 * (j - k) + 1], v[2 * (j - k)]};
      OF(write)(x, positions[j], &a);
    }
    for (int l = 0; l < 4; l++) at[l] += 4;
  }
}

/* Up to four columns of a spectrum, from the positions of the frequencies */
TARGET static void OF(write_columns)(const int *positions, int n, int columns, const double *x, double *spectrum) {
  double *at[4];
  for (int l = 0; l < 4; l++) at[l] = spectrum + 2 * (size_t)n * (size_t)l;
  for (int k = 0; k < n; k += 2) {
    four v[4] = {{0.0}};
    for (int j = k; j < k + 2 && j < n; j++) {
      number a;
      OF(read)(x, positions[j], &a);
      v[2 * (j - k)] = a.re;
      v[2 * (j - k) + 1] = a.im;
    }
    if (columns == 4 && k + 1 < n) OF(along)(v, at);
    else
      for (int l = 0; l < columns; l++)
        for (int i = 0; i < 4 && k + i / 2 < n; i++) at[l][i] = v[i][l];
    for (int l = 0; l < 4; l++) at[l] += 4;
  }
}

/* Numbers k to k + 3 of four columns of a real spectrum of n rows; those that are missing are not defined */
INLINE void OF(read_spectrum)(int n, int columns, int k, const double *spectrum, four *v) {
  const double *at[4];
  for (int l = 0; l < 4; l++) at[l] = spectrum + (size_t)n * (l < columns ? l : 0) + k;
  if (k + 4 <= n) OF(across)(at, v);
  else
    for (int j = 0; j < n - k; j++) v[j] = (four){at[0][j], at[1][j], at[2][j], at[3][j]};
}

/* Products of four columns with a real spectrum; on exit real and imaginary parts are exchanged */
TARGET static void OF(multiply_one)(const int *positions, int n, int columns, const double *xx, double *x) {
  for (int k = 0; k < n; k += 4) {
    four v[4];
    OF(read_spectrum)(n, columns, k, xx, v);
    for (int j = 0; j < 4 && k + j < n; j++) {
      number a, b;
      OF(read)(x, positions[k + j], &a);
      b.re = v[j] * a.im;
      b.im = v[j] * a.re;
      OF(write)(x, positions[k + j], &b);
    }
  }
}

/* Products of four columns of two fields with a symmetric 2 by 2 block, then with a complex scalar for each column; the same on
 * exit */
TARGET static void OF(multiply_two)(const int *positions, int n, int columns, const double *const *block, const double *turn,
                                    double *x, double *y) {
  number t = {{1.0, 1.0, 1.0, 1.0}, {0.0, 0.0, 0.0, 0.0}};
  if (turn)
    for (int l = 0; l < columns; l++) {
      t.re[l] = turn[2 * l];
      t.im[l] = turn[2 * l + 1];
    }
  for (int k = 0; k < n; k += 4) {
    four v[4], w[4], u[4];
    OF(read_spectrum)(n, columns, k, block[0], v);
    OF(read_spectrum)(n, columns, k, block[1], w);
    OF(read_spectrum)(n, columns, k, block[2], u);
    for (int j = 0; j < 4 && k + j < n; j++) {
      const int at = positions[k + j];
      number a, b, p, q;
      OF(read)(x, at, &a);
      OF(read)(y, at, &b);
      p.im = v[j] * a.re + u[j] * b.re;
      p.re = v[j] * a.im + u[j] * b.im;
      q.im = u[j] * a.re + w[j] * b.re;
      q.re = u[j] * a.im + w[j] * b.im;
      if (turn) {
        const number first = p, second = q;
        p.im = t.re * first.im - t.im * first.re;
        p.re = t.re * first.re + t.im * first.im;
        q.im = t.re * second.im - t.im * second.re;
        q.re = t.re * second.re + t.im * second.im;
      }
      OF(write)(x, at, &p);
      OF(write)(y, at, &q);
    }
  }
}

/* See four_lines.f90 */
TARGET static void OF(rows_forward)(const line_plan *plan, int mx, int rows, int all, const double *field, double *half,
                                    double *work) {
  const int px = plan->steps->n;
  OF(read_rows)(mx, rows, field, work);
  OF(transform)(plan, work, work, work + 8 * (size_t)px, mx);
  OF(separate)(plan->positions, px, rows, 8 * (size_t)all, work, half);
}

TARGET static void OF(rows_backward)(const line_plan *plan, int mx, int rows, int all, const double *half, double *field,
                                     double *work) {
  const int px = plan->steps->n;
  OF(put_together)(plan->positions, px, rows, 8 * (size_t)all, half, work);
  OF(transform_back)(plan, work, work, work + 8 * (size_t)px, mx);
  OF(write_rows)(mx, rows, work, field);
}

TARGET static void OF(columns_forward)(const line_plan *plan, int my, int columns, const double *half, double *spectrum,
                                       double *work) {
  const int py = plan->steps->n;
  OF(transform)(plan, half, work, work + 8 * (size_t)py, my);
  OF(write_columns)(plan->positions, py, columns, work, spectrum);
}

TARGET static void OF(columns_backward)(const line_plan *plan, int my, int columns, const double *spectrum, double *half,
                                        double *work) {
  const int py = plan->steps->n;
  OF(read_columns)(plan->positions, py, columns, spectrum, work);
  OF(transform_back)(plan, work, half, work + 8 * (size_t)py, my);
}

TARGET static void OF(columns_one)(const line_plan *plan, int my, int columns, const double *xx, double *half, double *work) {
  const int py = plan->steps->n;
  OF(transform)(plan, half, work, work + 8 * (size_t)py, my);
  OF(multiply_one)(plan->positions, py, columns, xx, work);
  OF(transform_back)(plan, work, half, work + 8 * (size_t)py, my);
}

TARGET static void OF(columns_two)(const line_plan *plan, int my, int columns, const double *const *block, const double *turn,
                                   double *half, double *work) {
  const int py = plan->steps->n;
  double *const field[2] = {work, work + 8 * (size_t)py}, *rest = work + 16 * (size_t)py;
  for (int f = 0; f < 2; f++) OF(transform)(plan, half + 8 * (size_t)my * f, field[f], rest, my);
  OF(multiply_two)(plan->positions, py, columns, block, turn, field[0], field[1]);
  for (int f = 0; f < 2; f++) OF(transform_back)(plan, field[f], half + 8 * (size_t)my * f, rest, my);
}
#undef INLINE
