/* Products of two real fields on a small window with kernels, for one kind of processor; after four_bodies.h
 *
 * The fields are real and imaginary part of one complex field. Its columns are transformed together with those of opposite
 * frequencies, which a product needs, and stay in the cache in between. Columns are stored four at once, with the rows one after
 * the other. */
#define INLINE TARGET static inline __attribute__((always_inline))

/* Four rows of both fields, from row iy on; the last one takes the place of missing ones */
TARGET static void OF(read_pair)(int mx, int my, int iy, const double *fields, double *x) {
  const double *at[2][4];
  int ix = 0;
  for (int f = 0; f < 2; f++)
    for (int l = 0; l < 4; l++) at[f][l] = fields + (size_t)mx * (size_t)((iy + l < my ? iy + l : my - 1) + f * my);
  for (; ix + 4 <= mx; ix += 4)
    for (int f = 0; f < 2; f++) {
      four v[4];
      OF(across)(at[f], v);
      for (int k = 0; k < 4; k++) FOUR(x + 8 * (size_t)(ix + k) + 4 * f) = v[k];
      for (int l = 0; l < 4; l++) at[f][l] += 4;
    }
  for (int rest = 0; ix < mx; ix++, rest++)
    for (int f = 0; f < 2; f++)
      for (int l = 0; l < 4; l++) x[8 * (size_t)ix + 4 * f + l] = at[f][l][rest];
}

/* Replace mx numbers of four lines by the differences with the previous ones, times a factor: one number more */
TARGET static void OF(take_differences)(int mx, double factor, double *x) {
  number last = {{0.0}, {0.0}};
  for (int ix = 0; ix <= mx; ix++) {
    number here = {{0.0}, {0.0}}, change;
    if (ix < mx) OF(read)(x, (size_t)ix, &here);
    change.re = factor * (here.re - last.re);
    change.im = factor * (here.im - last.im);
    OF(write)(x, (size_t)ix, &change);
    last = here;
  }
}

/* The reverse of read_pair, without the rows that are missing */
TARGET static void OF(write_pair)(int mx, int my, int iy, const double *x, double *fields) {
  double *at[2][4];
  int ix = 0;
  const int rows = my - iy < 4 ? my - iy : 4;
  for (int f = 0; f < 2; f++)
    for (int l = 0; l < rows; l++) at[f][l] = fields + (size_t)mx * (size_t)(iy + l + f * my);
  if (rows == 4)
    for (; ix + 4 <= mx; ix += 4)
      for (int f = 0; f < 2; f++) {
        four v[4];
        for (int k = 0; k < 4; k++) v[k] = READ_FOUR(x + 8 * (size_t)(ix + k) + 4 * f);
        OF(along)(v, at[f]);
        for (int l = 0; l < 4; l++) at[f][l] += 4;
      }
  for (int rest = 0; ix < mx; ix++, rest++)
    for (int f = 0; f < 2; f++)
      for (int l = 0; l < rows; l++) at[f][l][rest] = x[8 * (size_t)ix + 4 * f + l];
}

/* Transformed rows to the columns, `stride` numbers from four columns to the next; places are those of their frequencies, -1 for
 * columns that are missing */
TARGET static void OF(spread_pair)(const int *places, int count, size_t stride, const double *z, double *half) {
  for (int k = 0; k < count; k += 4, half += stride)
    for (int part = 0; part < 2; part++) {
      double *at[4];
      four v[4];
      for (int j = 0; j < 4; j++) {
        const int place = places[k + j] < 0 ? 0 : places[k + j];
        v[j] = READ_FOUR(z + 8 * (size_t)place + 4 * part);
        at[j] = half + 8 * j + 4 * part;
      }
      OF(along)(v, at);
    }
}

/* The reverse, with real and imaginary parts exchanged */
TARGET static void OF(collect_pair)(const int *places, int count, size_t stride, const double *half, double *z) {
  for (int k = 0; k < count; k += 4, half += stride)
    for (int part = 0; part < 2; part++) {
      const double *at[4];
      four v[4];
      for (int j = 0; j < 4; j++) at[j] = half + 8 * j + 4 * part;
      OF(across)(at, v);
      for (int j = 0; j < 4; j++)
        if (places[k + j] >= 0) FOUR(z + 8 * (size_t)places[k + j] + 4 * (1 - part)) = v[j];
    }
}

/* Frequencies of two numbers that are opposite, times a block, with real and imaginary parts exchanged; see paired.f90 */
INLINE void OF(multiply_opposites)(four mean, four difference, four mixed, double *x, double *y) {
  const number here = {READ_FOUR(x), READ_FOUR(x + 4)}, there = {READ_FOUR(y), READ_FOUR(y + 4)};
  FOUR(x) = mean * here.im - difference * there.im + mixed * there.re;
  FOUR(x + 4) = mean * here.re + difference * there.re + mixed * there.im;
  FOUR(y) = mean * there.im - difference * here.im + mixed * here.re;
  FOUR(y + 4) = mean * there.re + difference * here.re + mixed * here.im;
}

/* Numbers k to k + 3 of four columns of spectra of n rows; those that are missing are not defined */
INLINE void OF(read_four_columns)(const double *spectrum, const size_t *starts, int n, int k, four *v) {
  const double *at[4];
  for (int l = 0; l < 4; l++) at[l] = spectrum + starts[l] + k;
  if (k + 4 <= n) OF(across)(at, v);
  else
    for (int j = 0; j < n - k; j++) v[j] = (four){at[0][j], at[1][j], at[2][j], at[3][j]};
}

/* Four columns and their opposites of n numbers, times a block */
TARGET static void OF(multiply_pair_columns)(const int *positions, int n, const size_t *starts, const double *const *block,
                                             double *x, double *y) {
  for (int k = 0; k <= n / 2; k += 4) {
    four v[3][4];
    for (int i = 0; i < 3; i++) OF(read_four_columns)(block[i], starts, n, k, v[i]);
    for (int j = 0; j < 4 && k + j <= n / 2; j++) {
      const int opposite = k + j == 0 ? 0 : n - k - j;
      const size_t here = 8 * (size_t)positions[k + j], there = 8 * (size_t)positions[opposite];
      OF(multiply_opposites)(v[0][j], v[1][j], v[2][j], x + here, y + there);
      /* the third kernel is odd */
      if (here != there) OF(multiply_opposites)(v[0][j], v[1][j], -v[2][j], x + there, y + here);
    }
  }
}

/* Four columns of n numbers times an even kernel */
TARGET static void OF(multiply_even_columns)(const int *positions, int n, const size_t *starts, const double *kernel, double *x) {
  for (int k = 0; k < n; k += 4) {
    four v[4];
    OF(read_four_columns)(kernel, starts, n, k, v);
    for (int j = 0; j < 4 && k + j < n; j++) {
      number a, b;
      OF(read)(x, (size_t)positions[k + j], &a);
      b.re = v[j] * a.im;
      b.im = v[j] * a.re;
      OF(write)(x, (size_t)positions[k + j], &b);
    }
  }
}

/* One column that is its own opposite: line `lane` of x, times a block; the result goes to y */
TARGET static void OF(multiply_own_column)(const int *positions, int n, size_t start, const double *const *block, int lane,
                                           const double *x, double *y) {
  for (int k = 0; k < n; k++) {
    const double *here = x + 8 * (size_t)positions[k] + lane, *there = x + 8 * (size_t)positions[k == 0 ? 0 : n - k] + lane;
    const double mean = block[0][start + (size_t)k], difference = block[1][start + (size_t)k], mixed = block[2][start + (size_t)k];
    y[2 * k] = mean * here[4] - difference * there[4] + mixed * there[0];
    y[2 * k + 1] = mean * here[0] + difference * there[0] + mixed * there[4];
  }
}

/* Put such a result into its line */
TARGET static void OF(put_own_column)(const int *positions, int n, int lane, const double *y, double *x) {
  for (int k = 0; k < n; k++)
    for (int part = 0; part < 2; part++) x[8 * (size_t)positions[k] + 4 * (size_t)part + (size_t)lane] = y[2 * k + part];
}

/* Product of four columns and their opposites; the first `pairs` are not their own opposites. With a single kernel it is even */
TARGET static void OF(multiply_columns)(const line_plan *plan, int px, int first, int pairs, const double *const *block, double *x,
                                        double *y, double *own) {
  const int n = plan->steps->n, has_own = pairs < 4;
  const size_t middle = (size_t)n * (size_t)(px / 2);
  size_t starts[4];
  for (int l = 0; l < 4; l++) starts[l] = l < pairs ? (size_t)n * (size_t)(first + l) : 0;
  if (block[1] == NULL) {
    OF(multiply_even_columns)(plan->positions, n, starts, block[0], x);
    if (has_own) starts[pairs] = middle;
    OF(multiply_even_columns)(plan->positions, n, starts, block[0], y);
    return;
  }
  if (has_own) {
    OF(multiply_own_column)(plan->positions, n, 0, block, pairs, x, own);
    OF(multiply_own_column)(plan->positions, n, middle, block, pairs, y, own + 2 * (size_t)n);
  }
  OF(multiply_pair_columns)(plan->positions, n, starts, block, x, y);
  if (has_own) {
    OF(put_own_column)(plan->positions, n, pairs, own, x);
    OF(put_own_column)(plan->positions, n, pairs, own + 2 * (size_t)n, y);
  }
}

/* See paired.f90 */
TARGET static void OF(pair)(const line_plan *along_x, const line_plan *along_y, const int *places, int mx, int my, int ahead,
                            const double *const *block, const double *fields, double *products, double *half, double *work) {
  const int px = along_x->steps->n, py = along_y->steps->n, count = 8 * ((px + 6) / 8), given = mx + (ahead != 0);
  const size_t stride = 8 * 4 * (size_t)((my + 3) / 4);
  double *const x = work, *const y = work + 8 * (size_t)(px > py ? px : py), *const rest = y + 8 * (size_t)py;
  /* differences with the next number start one position before the first one: they are moved by one position */
  const int moved = ahead > 0;
  for (int iy = 0; iy < my; iy += 4) {
    OF(read_pair)(mx, my, iy, fields, x);
    if (ahead != 0) OF(take_differences)(mx, ahead > 0 ? -1.0 : 1.0, x);
    OF(transform)(along_x, x, x, y, given);
    OF(spread_pair)(places, count, stride, x, half + 8 * (size_t)iy);
  }
  for (int k = 0; k < count / 2; k += 4) {
    double *const here = half + 2 * stride * (size_t)(k / 4), *const there = here + stride;
    OF(transform)(along_y, here, x, rest, my);
    OF(transform)(along_y, there, y, rest, my);
    OF(multiply_columns)(along_y, px, k + 1, px / 2 - 1 - k < 4 ? px / 2 - 1 - k : 4, block, x, y, rest);
    OF(transform_back)(along_y, x, here, rest, my);
    OF(transform_back)(along_y, y, there, rest, my);
  }
  for (int iy = 0; iy < my; iy += 4) {
    OF(collect_pair)(places, count, stride, half + 8 * (size_t)iy, x);
    OF(transform_back)(along_x, x, x, y, mx + moved);
    OF(write_pair)(mx, my, iy, x + 8 * (size_t)moved, products);
  }
}
#undef INLINE
