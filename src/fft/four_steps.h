/* Steps of the transforms of four_lines.c, for one kind of processor: OF(name) is the name of a function in that version, TARGET its attribute.
 *
 * The buffers have eight numbers per position: the real parts of four lines, then their imaginary parts. */
#define INLINE TARGET static inline __attribute__((always_inline))

INLINE void OF(read)(const double *x, size_t i, number *a) {
  a->re = READ_FOUR(x + 8 * i);
  a->im = READ_FOUR(x + 8 * i + 4);
}

INLINE void OF(write)(double *x, size_t i, const number *a) {
  FOUR(x + 8 * i) = a->re;
  FOUR(x + 8 * i + 4) = a->im;
}

/* Sum in place of a, difference in place of b */
INLINE void OF(sum_and_difference)(number *a, number *b) {
  const number x = *a, y = *b;
  a->re = x.re + y.re;
  a->im = x.im + y.im;
  b->re = x.re - y.re;
  b->im = x.im - y.im;
}

/* a - i b in place of a, a + i b in place of b */
INLINE void OF(quarter_turns)(number *a, number *b) {
  const number x = *a, y = *b;
  a->re = x.re + y.im;
  a->im = x.im - y.re;
  b->re = x.re - y.im;
  b->im = x.im + y.re;
}

INLINE void OF(turn)(number *a, const double *w) {
  const number x = *a;
  a->re = x.re * w[0] - x.im * w[1];
  a->im = x.re * w[1] + x.im * w[0];
}

/* Transforms of 2 to 8 numbers in place. The first `given` may differ from zero, at least half of them */
INLINE void OF(two_numbers)(number *a, const int given) {
  if (given < 2) a[1] = a[0];
  else OF(sum_and_difference)(a, a + 1);
}

INLINE void OF(three_numbers)(number *a) {
  const double half_root_3 = 0.86602540378443864676;
  number m = a[0];
  OF(sum_and_difference)(a + 1, a + 2);
  m.re -= 0.5 * a[1].re;
  m.im -= 0.5 * a[1].im;
  a[0].re += a[1].re;
  a[0].im += a[1].im;
  a[1] = m;
  a[2].re *= half_root_3;
  a[2].im *= half_root_3;
  OF(quarter_turns)(a + 1, a + 2);
}

INLINE void OF(four_numbers)(number *a, const int given) {
  number b[4] = {a[0], a[1], a[0], a[1]};
  if (given > 2) {
    b[2] = a[2];
    b[3] = a[3];
    OF(sum_and_difference)(b, b + 2);
    OF(sum_and_difference)(b + 1, b + 3);
  }
  OF(sum_and_difference)(b, b + 1);
  OF(quarter_turns)(b + 2, b + 3);
  a[0] = b[0];
  a[1] = b[2];
  a[2] = b[1];
  a[3] = b[3];
}

INLINE void OF(five_numbers)(number *a, const int given) {
  /* cosines and sines of 72 and 144 degrees */
  const double c1 = 0.30901699437494742410, c2 = -0.80901699437494742410, s1 = 0.95105651629515357212, s2 = 0.58778525229247312917;
  number b[4] = {a[1], a[2], a[2], a[1]}, m1, m2, n1, n2;
  if (given > 3) {
    b[2] = a[3];
    b[3] = a[4];
    OF(sum_and_difference)(b, b + 3);
    OF(sum_and_difference)(b + 1, b + 2);
  }
  m1.re = a[0].re + c1 * b[0].re + c2 * b[1].re;
  m1.im = a[0].im + c1 * b[0].im + c2 * b[1].im;
  m2.re = a[0].re + c2 * b[0].re + c1 * b[1].re;
  m2.im = a[0].im + c2 * b[0].im + c1 * b[1].im;
  n1.re = s1 * b[3].re + s2 * b[2].re;
  n1.im = s1 * b[3].im + s2 * b[2].im;
  n2.re = s2 * b[3].re - s1 * b[2].re;
  n2.im = s2 * b[3].im - s1 * b[2].im;
  a[0].re += b[0].re + b[1].re;
  a[0].im += b[0].im + b[1].im;
  OF(quarter_turns)(&m1, &n1);
  OF(quarter_turns)(&m2, &n2);
  a[1] = m1;
  a[2] = m2;
  a[3] = n2;
  a[4] = n1;
}

INLINE void OF(seven_numbers)(number *a) {
  /* cosines and sines of sevenths of a circle */
  const double c1 = 0.62348980185873353053, c2 = -0.22252093395631440429, c3 = -0.90096886790241912624;
  const double s1 = 0.78183148246802980871, s2 = 0.97492791218182360702, s3 = 0.43388373911755812048;
  const double c[3][3] = {{c1, c2, c3}, {c2, c3, c1}, {c3, c1, c2}}, s[3][3] = {{s1, s2, s3}, {s2, -s3, -s1}, {s3, -s1, s2}};
  const number first = a[0];
  for (int k = 1; k < 4; k++) {
    OF(sum_and_difference)(a + k, a + 7 - k);
    a[0].re += a[k].re;
    a[0].im += a[k].im;
  }
  {
    number m[3], n[3];
    for (int j = 0; j < 3; j++) {
      m[j].re = first.re + c[j][0] * a[1].re + c[j][1] * a[2].re + c[j][2] * a[3].re;
      m[j].im = first.im + c[j][0] * a[1].im + c[j][1] * a[2].im + c[j][2] * a[3].im;
      n[j].re = s[j][0] * a[6].re + s[j][1] * a[5].re + s[j][2] * a[4].re;
      n[j].im = s[j][0] * a[6].im + s[j][1] * a[5].im + s[j][2] * a[4].im;
    }
    for (int j = 0; j < 3; j++) {
      OF(quarter_turns)(m + j, n + j);
      a[j + 1] = m[j];
      a[6 - j] = n[j];
    }
  }
}

INLINE void OF(eight_numbers)(number *a, const int given) {
  const double half_root_2 = 0.70710678118654752440;
  number even[4] = {a[0], a[2], a[4], a[6]}, odd[4] = {a[1], a[3], a[5], a[7]}, turned;
  OF(four_numbers)(even, (given + 1) / 2);
  OF(four_numbers)(odd, given / 2);
  turned.re = (odd[1].re + odd[1].im) * half_root_2;
  turned.im = (odd[1].im - odd[1].re) * half_root_2;
  odd[1] = turned;
  turned.re = (odd[3].im - odd[3].re) * half_root_2;
  turned.im = -(odd[3].re + odd[3].im) * half_root_2;
  odd[3] = turned;
  OF(sum_and_difference)(even, odd);
  OF(sum_and_difference)(even + 1, odd + 1);
  OF(quarter_turns)(even + 2, odd + 2);
  OF(sum_and_difference)(even + 3, odd + 3);
  for (int k = 0; k < 4; k++) {
    a[k] = even[k];
    a[k + 4] = odd[k];
  }
}

/* Transform of r numbers */
INLINE void OF(numbers)(const int r, number *a, const int given) {
  switch (r) {
    case 2: OF(two_numbers)(a, given); break;
    case 3: OF(three_numbers)(a); break;
    case 4: OF(four_numbers)(a, given); break;
    case 5: OF(five_numbers)(a, given); break;
    case 7: OF(seven_numbers)(a); break;
    default: OF(eight_numbers)(a, given); break;
  }
}

/* One step of a transform of `blocks` sequences of n numbers, for positions `start` to `end` of n/r, in place or from one array to
 * another. Forward each sequence is divided into r sequences of n/r numbers, back they are united. Only the first `few` of r
 * numbers may differ from zero on entry, or are needed on exit of a step back; the last step back exchanges real and imaginary
 * parts. w has r - 1 factors for each position */
INLINE void OF(step)(const int r, const int way, int n, int blocks, int start, int end, const double *w, const double *from,
                     double *to, const int few) {
  const size_t m = (size_t)(n / r);
  w += 2 * (size_t)(r - 1) * (size_t)start;
  for (size_t p = (size_t)start; p < (size_t)end; p++, w += 2 * (r - 1))
    for (int b = 0; b < blocks; b++) {
      const size_t here = p + (size_t)n * (size_t)b;
      const int given = way == FORWARD ? few : r, wanted = way == FORWARD ? r : few;
      number a[LARGEST];
      for (int k = 0; k < given; k++) OF(read)(from, here + m * k, a + k);
      for (int k = given; k < r; k++) a[k].re = a[k].im = (four){0.0, 0.0, 0.0, 0.0};
      /* all factors are 1 where sequences have one number */
      if (way != FORWARD && m > 1)
        for (int k = 1; k < r; k++) OF(turn)(a + k, w + 2 * (k - 1));
      OF(numbers)(r, a, given);
      if (way == FORWARD && m > 1)
        for (int k = 1; k < r; k++) OF(turn)(a + k, w + 2 * (k - 1));
      for (int k = 0; k < wanted; k++) {
        const number parts = {way == LAST_BACK ? a[k].im : a[k].re, way == LAST_BACK ? a[k].re : a[k].im};
        OF(write)(to, here + m * k, &parts);
      }
    }
}

/* The same for any factor r of a length, by its definition, with the powers of the root of unity of order r and workspace for r
 * numbers */
TARGET static void OF(any_step)(int r, int way, int n, int blocks, const double *w, const double *roots, double *x, double *y) {
  const size_t m = (size_t)(n / r);
  for (size_t p = 0; p < m; p++, w += 2 * (r - 1))
    for (int b = 0; b < blocks; b++) {
      double *here = x + 8 * (p + (size_t)n * b);
      number a, sum;
      for (int k = 0; k < r; k++) {
        OF(read)(here, m * k, &a);
        if (way != FORWARD && k > 0) OF(turn)(&a, w + 2 * (k - 1));
        OF(write)(y, k, &a);
      }
      for (int j = 0; j < r; j++) {
        OF(read)(y, 0, &sum);
        for (int k = 1; k < r; k++) {
          OF(read)(y, k, &a);
          OF(turn)(&a, roots + 2 * (j * k % r));
          sum.re += a.re;
          sum.im += a.im;
        }
        if (way == FORWARD && j > 0) OF(turn)(&sum, w + 2 * (j - 1));
        OF(write)(here, m * j, &sum);
      }
    }
}

/* Steps with constant factors */
#define STEPS(way)                                                                                     \
  switch (r) {                                                                                         \
    case 2: OF(step)(2, way, n, blocks, 0, n / 2, w, x, x, 2); break;                                  \
    case 3: OF(step)(3, way, n, blocks, 0, n / 3, w, x, x, 3); break;                                  \
    case 4: OF(step)(4, way, n, blocks, 0, n / 4, w, x, x, 4); break;                                  \
    case 5: OF(step)(5, way, n, blocks, 0, n / 5, w, x, x, 5); break;                                  \
    case 7: OF(step)(7, way, n, blocks, 0, n / 7, w, x, x, 7); break;                                  \
    case 8: OF(step)(8, way, n, blocks, 0, n / 8, w, x, x, 8); break;                                  \
    default: OF(any_step)(r, way, n, blocks, w, w + 2 * (size_t)(r - 1) * (size_t)(n / r), x, y);      \
  }

TARGET static void OF(step_forward)(int r, int n, int blocks, const double *w, double *x, double *y) { STEPS(FORWARD) }

TARGET static void OF(step_back)(int r, int n, int blocks, const double *w, double *x, double *y) { STEPS(BACK) }
#undef STEPS

/* First or last step of a line of which at most half is given or requested: `few` of r numbers up to some position, and one
 * number less from there on */
#define HALF_STEP(r, few, way)                                                 \
  case r: {                                                                    \
    const int border = part - (few - 1) * (n / r);                             \
    OF(step)(r, way, n, 1, 0, border, w, from, to, few);                       \
    OF(step)(r, way, n, 1, border, n / r, w, from, to, few - 1);               \
    return 1;                                                                  \
  }
#define HALF_STEPS(way)                                                        \
  switch (r) {                                                                 \
    HALF_STEP(3, 2, way)                                                       \
    HALF_STEP(4, 2, way)                                                       \
    HALF_STEP(5, 3, way)                                                       \
    HALF_STEP(8, 4, way)                                                       \
    default: return 0;                                                         \
  }

/* Returns 0 without transforming unless all numbers but the last of the few are complete */
#define IS_HALF(r, n, part) ((r) > 0 && 2 * (part) <= (n) && (part) >= ((r) - 1) / 2 * ((n) / (r)))

TARGET static int OF(half_step_forward)(int r, int n, int part, const double *w, const double *from, double *to) {
  if (!IS_HALF(r, n, part)) return 0;
  HALF_STEPS(FORWARD)
}

TARGET static int OF(half_step_back)(int r, int n, int part, const double *w, const double *from, double *to) {
  if (!IS_HALF(r, n, part)) return 0;
  HALF_STEPS(LAST_BACK)
}
#undef HALF_STEP
#undef HALF_STEPS
#undef IS_HALF

/* Transform the first `used` numbers of four lines, which are followed by zeros, from one array to another or in place. Frequencies
 * are permuted. The parts of the first step are finished one after the other, because they fit into the cache */
TARGET static void OF(transform)(const line_plan *plan, const double *from, double *x, double *y, int used) {
  const int n = plan->steps->n, first = plan->steps->radices[0];
  if (!OF(half_step_forward)(first, n, used, plan->factors, from, x)) {
    if (from != x) memcpy(x, from, 8 * sizeof(double) * (size_t)used);
    memset(x + 8 * (size_t)used, 0, 8 * sizeof(double) * (size_t)(n - used));
    if (first == 0) return;
    OF(step_forward)(first, n, 1, plan->factors, x, y);
  }
  for (int part = 0; part < first; part++) {
    double *here = x + 8 * (size_t)part * (size_t)(n / first);
    for (int k = 1, length = n / first, blocks = 1; plan->steps->radices[k] > 0; k++) {
      const int r = plan->steps->radices[k];
      OF(step_forward)(r, length, blocks, plan->factors + plan->steps->starts[k], here, y);
      length /= r;
      blocks *= r;
    }
  }
}

/* The same back: from permuted positions in x, with real and imaginary parts exchanged, to the first `wanted` results */
TARGET static void OF(transform_back)(const line_plan *plan, double *x, double *to, double *y, int wanted) {
  const int n = plan->steps->n, first = plan->steps->radices[0];
  for (int part = 0; part < first; part++) {
    double *here = x + 8 * (size_t)part * (size_t)(n / first);
    for (int k = plan->steps->count - 1, length = 1, blocks = n / first; k > 0; k--) {
      const int r = plan->steps->radices[k];
      length *= r;
      blocks /= r;
      OF(step_back)(r, length, blocks, plan->factors + plan->steps->starts[k], here, y);
    }
  }
  if (OF(half_step_back)(first, n, wanted, plan->factors, x, to)) return;
  if (first > 0) OF(step_back)(first, n, 1, plan->factors, x, y);
  for (int k = 0; k < wanted; k++) {
    number a, b;
    OF(read)(x, k, &a);
    b.re = a.im;
    b.im = a.re;
    OF(write)(to, k, &b);
  }
}
