/* Loops in C for a few elements in contact and for the wheel above them, of all kinds of processors that this one can be, against
 * their definition, and against each other */
#include "elastic/sum_loops.c"
#include "normal/factor_loops.c"
#include "wheelrail/wheel_loops.c"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Largest matrix, and first dimension of its array; largest window */
enum { LARGEST = 45, STRIDE = 48, SIDE = 31 };

static int failures = 0;

static void check(int condition, const char *what, int n) {
  if (condition) return;
  failures++;
  printf("FAILED %s: size %d\n", what, n);
}

static double any_number(void) { return 2.0 * rand() / RAND_MAX - 1.0; }

/* Loops for one kind of processor */
typedef struct {
  void (*forward)(int, int, const double *, double *);
  void (*backward)(int, int, const double *, double *);
  int (*factorize)(int, int, double *, double *);
  void (*remove)(int, int, int, double *, double *, double *);
  int (*append)(int, int, double *, double *, double *, const double *);
  double (*violation)(int, double, const double *, const double *, const double *);
  int (*box)(int, int, const double *, int *);
  void (*displace)(int, int, const int *, const double *, int, const double *, double *);
  int (*meet)(int, const double *, const double *, const double *, double, const double *, const double *, const double *, double, double,
              int, const double *, int *, double *, double *);
  void (*spread)(const double *, const double *, int, double *, double *);
} loops;

static const loops anywhere = {forward_anywhere, backward_anywhere, factorize_anywhere, remove_anywhere, append_anywhere,
                               violation_anywhere, box_anywhere, displace_anywhere, meet_anywhere, spread_anywhere};

/* Largest difference of the product of a factor with its transpose from the matrix of some of the rows */
static double miss(const double *factor, int n, double matrix[LARGEST][LARGEST], const int *rows) {
  double worst = 0.0;
  for (int i = 0; i < n; i++)
    for (int j = 0; j <= i; j++) {
      double sum = -matrix[rows[i]][rows[j]];
      for (int k = 0; k <= j; k++) sum += factor[i + STRIDE * k] * factor[j + STRIDE * k];
      worst = fmax(worst, isnan(sum) ? INFINITY : fabs(sum));
    }
  return worst;
}

/* A positive definite matrix, its factor, also after some rows were removed and appended again, and a linear system; numbers outside
 * of the triangle must not be used */
static void try_factor(const loops *kind, int n, double *factor, double *x) {
  static double matrix[LARGEST][LARGEST], row[LARGEST], b[LARGEST];
  static int rows[LARGEST];
  static double sides[LARGEST][2], w[2 * STRIDE];
  double worst = 0.0;
  srand((unsigned)n);
  for (int i = 0; i < STRIDE * LARGEST; i++) factor[i] = NAN;
  for (int i = 0; i < 2 * LARGEST; i++) sides[i / 2][i % 2] = any_number();
  for (int i = 0; i < n; i++) {
    rows[i] = i;
    for (int j = 0; j <= i; j++) {
      matrix[i][j] = matrix[j][i] = i == j ? n + 1.0 : any_number();
      factor[i + STRIDE * j] = matrix[i][j];
    }
  }
  check(kind->factorize(n, STRIDE, factor, row), "a positive definite matrix has a factor", n);
  check(miss(factor, n, matrix, rows) <= 1e-13 * (n + 1), "the product of the factors is the matrix", n);
  for (int r = 0; r < 2; r++) {
    for (int i = 0; i < n; i++) w[r * STRIDE + i] = sides[i][r];
    kind->forward(n, STRIDE, factor, w + r * STRIDE);
  }
  for (int round = 0; round < 3; round++) {
    /* the first, the last and some other row */
    const int removed = round == 0 ? 0 : round == 1 ? n - 1 : rand() % n, again = rows[removed];
    kind->remove(n, removed, STRIDE, factor, row, w);
    memmove(rows + removed, rows + removed + 1, sizeof(int) * (size_t)(n - 1 - removed));
    check(miss(factor, n - 1, matrix, rows) <= 1e-13 * (n + 1), "the factor without a row is that of the other ones", n);
    rows[n - 1] = again;
    for (int i = 0; i < n; i++) row[i] = matrix[again][rows[i]];
    check(kind->append(n - 1, STRIDE, factor, row, w, sides[again]), "a row can be appended", n);
    check(miss(factor, n, matrix, rows) <= 1e-13 * (n + 1), "the factor with this row is that of all rows", n);
    for (int i = 0; i < n; i++)
      for (int r = 0; r < 2; r++) {
        double sum = -sides[rows[i]][r];
        for (int k = 0; k <= i; k++) sum += factor[i + STRIDE * k] * w[r * STRIDE + k];
        worst = fmax(worst, fabs(sum));
      }
    check(worst <= 1e-13 * (n + 1), "the solutions follow the factor", n);
  }
  for (int i = 0; i < n; i++) row[i] = matrix[rows[0]][rows[i]];
  if (n < LARGEST) {
    row[n] = matrix[rows[0]][rows[0]] - 1.0;
    check(!kind->append(n, STRIDE, factor, row, w, sides[0]), "no row is appended that makes the matrix indefinite", n);
  }
  for (int i = 0; i < n; i++) x[i] = b[i] = any_number();
  x[n] = 7.0;
  kind->forward(n, STRIDE, factor, x);
  kind->backward(n, STRIDE, factor, x);
  worst = 0.0;
  for (int i = 0; i < n; i++) {
    double sum = -b[i];
    for (int j = 0; j < n; j++) sum += matrix[rows[i]][rows[j]] * x[j];
    worst = fmax(worst, fabs(sum));
  }
  check(worst <= 1e-13 * (n + 1), "the solution satisfies the equations", n);
  check(x[n] == 7.0, "nothing is written beyond the solution", n);
}

/* A matrix that is not positive definite */
static void try_indefinite(const loops *kind) {
  double a[9] = {1.0, 2.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}, row[3];
  check(!kind->factorize(3, 3, a, row), "an indefinite matrix has no factor", 3);
  a[0] = NAN;
  check(!kind->factorize(3, 3, a, row), "nor has one that is not a number", 3);
}

/* The window around the positive numbers of a field */
static void try_box(const loops *kind, int mx, int my) {
  static double p[SIDE * SIDE];
  int box[4], first[2] = {mx + 1, my + 1}, last[2] = {0, 0}, n = 0;
  srand((unsigned)(SIDE * mx + my));
  for (int k = 0; k < mx * my; k++) {
    p[k] = rand() % 20 == 0 ? 1.0 + any_number() : 0.0;
    if (!(p[k] > 0.0)) continue;
    const int at[2] = {k % mx + 1, k / mx + 1};
    n++;
    for (int i = 0; i < 2; i++) {
      if (at[i] < first[i]) first[i] = at[i];
      if (at[i] > last[i]) last[i] = at[i];
    }
  }
  check(kind->box(mx, my, p, box) == n, "positive numbers are counted", mx);
  check(box[0] == first[0] && box[1] == last[0] && box[2] == first[1] && box[3] == last[1], "they are in the window", mx);
}

/* Violations of the contact conditions; displacements that must not be used are not numbers */
static void try_violation(const loops *kind, int n) {
  static double h[SIDE * SIDE], u[SIDE * SIDE], p[SIDE * SIDE];
  double worst = 0.0;
  srand((unsigned)n);
  for (int k = 0; k < n; k++) {
    h[k] = any_number();
    p[k] = rand() % 3 == 0 ? 1.0 + any_number() : 0.0;
    u[k] = p[k] > 0.0 || h[k] < 0.3 ? any_number() : NAN;
    const double r = 0.3 - h[k] - u[k];
    if (p[k] > 0.0) worst = fmax(worst, fabs(r));
    else if (h[k] < 0.3) worst = fmax(worst, r);
  }
  check(kind->violation(n, 0.3, h, u, p) == worst, "the largest violation is found", n);
}

/* Displacements in a window of mx by my elements with random ranges */
static void try_sums(const loops *kind, int mx, int my, double *u) {
  static double nn[(2 * SIDE + 1) * (2 * SIDE + 1)], p[SIDE * SIDE];
  int ranges[4 * SIDE];
  const int stride = 2 * mx + 1;
  double worst = 0.0;
  srand((unsigned)(SIDE * mx + my));
  for (int l = 0; l <= my; l++)
    for (int k = 0; k <= mx; k++) {
      const double value = any_number();
      for (int sign = 0; sign < 4; sign++) nn[mx + (sign % 2 ? k : -k) + stride * (my + (sign / 2 ? l : -l))] = value;
    }
  for (int l = 0; l < my; l++)
    for (int part = 0; part < 2; part++) {
      const int a = rand() % (mx + 1), b = rand() % (mx + 1);
      ranges[4 * l + 2 * part] = a < b ? a : b;
      ranges[4 * l + 2 * part + 1] = a < b ? b : a;
    }
  for (int k = 0; k < mx * my; k++) {
    p[k] = any_number();
    u[k] = 7.0;
  }
  kind->displace(mx, my, ranges, nn + mx + stride * my, stride, p, u);
  for (int iy = 0; iy < my; iy++)
    for (int ix = 0; ix < mx; ix++) {
      double sum = 0.0;
      if (ix < ranges[4 * iy + 2] || ix >= ranges[4 * iy + 3]) sum = 7.0;
      else
        for (int l = 0; l < my; l++)
          for (int k = ranges[4 * l]; k < ranges[4 * l + 1]; k++) sum += p[k + mx * l] * nn[mx + ix - k + stride * (my + iy - l)];
      worst = fmax(worst, fabs(sum - u[ix + mx * iy]));
    }
  check(worst <= 1e-12, "displacements are sums over the pressures, in their range only", mx);
}

/* Coefficients of a cubic after a shift of its argument */
static void shift(const double *c, double by, double *shifted) {
  shifted[0] = c[0] + by * (c[1] + by * (c[2] + by * c[3]));
  shifted[1] = c[1] + by * (2.0 * c[2] + by * 3.0 * c[3]);
  shifted[2] = c[2] + by * 3.0 * c[3];
  shifted[3] = c[3];
}

/* Eight points of a wheel with a curved profile, seen from a rolled and yawed plane; the profile is one cubic, given as three pieces */
static void try_points(const loops *kind, double *place, double *n) {
  const double y[4] = {3.0, -0.98, 1e-3, -1e-4}, z[4] = {0.2, 0.05, -4e-3, 2e-4}, radius = 460.0;
  const double base[3] = {0.4, 1.5, 0.1}, axis[3] = {0.99995, 0.01, 0.0}, along[3] = {0.0, -0.05, 0.99875};
  const double x[8] = {-9.0, -6.5, -4.0, -1.5, 1.0, 3.5, 6.0, 8.5};
  double ends[4] = {10.0, 11.4, 11.7, 14.0}, cy[3][4], cz[3][4], worst = 0.0;
  int piece = 1;
  for (int k = 0; k < 3; k++) {
    shift(y, ends[k] - ends[0], cy[k]);
    shift(z, ends[k] - ends[0], cz[k]);
  }
  for (int k = 0; k < 8; k++) {
    place[k] = 11.5;
    n[k] = 0.0;
  }
  check(kind->meet(3, ends, cy[0], cz[0], radius, base, axis, along, 0.5, 4.6e-6, 6, x, &piece, place, n), "points of the wheel are found", 8);
  for (int k = 0; k < 8; k++) {
    const double t = place[k] - ends[0], r = radius + z[0] + t * (z[1] + t * (z[2] + t * z[3]));
    double q[3];
    for (int i = 0; i < 3; i++) q[i] = base[i] + axis[i] * x[k] + along[i] * n[k];
    worst = fmax(worst, fabs(q[1] - (y[0] + t * (y[1] + t * (y[2] + t * y[3])))));
    worst = fmax(worst, fabs(hypot(q[0], q[2] + radius) - r));
  }
  check(worst <= 1e-9, "they are on the wheel", 8);
  double before[2][8];
  memcpy(before[0], place, sizeof before[0]);
  memcpy(before[1], n, sizeof before[1]);
  check(piece >= 1 && piece <= 3 && place[0] >= ends[piece - 1] && place[0] <= ends[piece], "the piece is that of the first point", piece);
  ends[3] = fmin(place[0], place[7]) - 1e-3;
  check(!kind->meet(3, ends, cy[0], cz[0], radius, base, axis, along, 0.5, 4.6e-6, 6, x, &piece, place, n),
        "points beyond the profile are not found", 8);
  check(!memcmp(before[0], place, sizeof before[0]) && !memcmp(before[1], n, sizeof before[1]), "and are not changed", 8);
}

static void try_polynomial(const loops *kind, int n, double *values) {
  double powers[8][8], node[8], p[8] = {0.0}, last[2], worst = 0.0;
  srand((unsigned)n);
  for (int k = 0; k < 8; k++) {
    node[k] = any_number();
    for (int power = 0; power < 8; power++) {
      powers[k][power] = any_number();
      p[power] += node[k] * powers[k][power];
    }
  }
  values[n] = 7.0;
  kind->spread(powers[0], node, n, values, last);
  for (int i = 0; i < n; i++) {
    const double t = 2.0 * i / (n - 1) - 1.0;
    double sum = 0.0;
    for (int k = 0; k < 8; k++) sum += p[k] * pow(t, k);
    worst = fmax(worst, fabs(sum - values[i]));
  }
  check(worst <= 1e-13, "values are those of the polynomial", n);
  check(fabs(last[0] - fabs(p[6])) <= 1e-14 && fabs(last[1] - fabs(p[7])) <= 1e-14, "and so are its last coefficients", n);
  check(values[n] == 7.0, "nothing is written beyond them", n);
}

/* All loops of one kind; their results in one vector */
static int try_all(const loops *kind, double *results) {
  int total = 0;
  static double factor[STRIDE * LARGEST], x[LARGEST + 1], u[SIDE * SIDE], values[SIDE + 1];
  for (int n = 1; n <= LARGEST; n++) {
    try_factor(kind, n, factor, x);
    memcpy(results + total, x, sizeof(double) * (size_t)n);
    total += n;
  }
  try_indefinite(kind);
  for (int mx = 1; mx <= SIDE; mx += 2)
    for (int my = 1; my <= SIDE; my += 7) {
      try_box(kind, mx, my);
      try_violation(kind, mx * my);
      try_sums(kind, mx, my, u);
      memcpy(results + total, u, sizeof(double) * (size_t)(mx * my));
      total += mx * my;
    }
  try_points(kind, results + total, results + total + 8);
  total += 16;
  for (int n = 2; n <= SIDE; n++) {
    try_polynomial(kind, n, values);
    memcpy(results + total, values, sizeof(double) * (size_t)n);
    total += n;
  }
  return total;
}

int main(void) {
  static double results[2][100000];
  const int total = try_all(&anywhere, results[0]);
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) {
    const loops avx2 = {forward_avx2, backward_avx2,  factorize_avx2, remove_avx2, append_avx2,
                        violation_avx2, box_avx2, displace_avx2, meet_avx2, spread_avx2};
    try_all(&avx2, results[1]);
    check(!memcmp(results[0], results[1], sizeof(double) * (size_t)total), "both kinds give identical digits", total);
  }
#endif
  printf("%d numbers\n", total);
  return failures > 0;
}
