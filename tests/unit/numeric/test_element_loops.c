/* Loops in C over vectors, elements and spectra, of all kinds of processors that this one can be, against their definition, and
 * against each other; those between transforms have test_lines.c */
#include "elastic/sum_loops.c"
#include "normal/gradient_loops.c"
#include "numeric/vectors.c"
#include "patch/field_loops.c"
#include "subsurface/pack_products.c"
#include "tangential/slip_loops.c"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Longest vector, and numbers of a buffer: two components, and one more that must stay as it is */
enum { LONGEST = 19, ROOM = 2 * LONGEST + 1, FIELDS = 7 };

/* Fields of two components, flags, sums; data that a loop may change come first */
typedef struct {
  double a[ROOM], b[ROOM], c[ROOM], sums[4];
} buffers;

static double from[FIELDS][ROOM], creep[2], r, factor;
static int contact[LONGEST];

enum { INNER, ADD, INNER_FOUR, ADD_FOUR, SMALLEST, LARGEST, FARTHEST, SUBTRACT, MARK, RANGES, GAP_SUMS, RESIDUALS, CHOOSE_FREE, FREE_SUMS, PROJECT, TURN, GO_ALONG, SLIP_RESIDUAL, STEP, LINEARISE,
       PROJECT_CHANGE, JACOBIAN, JOIN, COLUMN, KINDS };

static double any_number(void) { return 2.0 * rand() / RAND_MAX - 1.0; }

/* States of elements as numbers, of which every other one was exterior (0) before, every third one in slip (2) */
static int marked(int (*mark)(int, int, int, const double *, double *, double *, int *), int n, const double *pn, buffers *z) {
  int division[LONGEST], touching;
  for (int k = 0; k < n; k++) division[k] = k % 2 == 0 ? 0 : k % 3 == 0 ? 2 : 1;
  touching = mark(n, 0, 1, pn, z->a, z->b, division);
  for (int k = 0; k < n; k++) z->c[k] = division[k];
  return touching;
}

/* Range of positive numbers of a row, and of another one without any */
static void find_range(void (*ranges)(int, int, const double *, int, int *), int n, const double *a, buffers *z) {
  double rows[2 * LONGEST] = {0.0};
  int found[6] = {-1, -1, -1, -1, -1, -1};
  for (int k = 0; k < n; k++) {
    rows[k] = a[k] > 0.5 ? a[k] : 0.0;
    rows[n + k] = -fabs(a[k]);
  }
  ranges(n, 2, rows, 3, found);
  for (int k = 0; k < 6; k++) z->c[k] = found[k];
}

#define LOOPS(processor) \
  static void try_##processor(int kind, int n, buffers *z) { \
    double **f = (double *[FIELDS]){from[0], from[1], from[2], from[3], from[4], from[5], from[6]}; \
    switch (kind) { \
      case INNER: z->sums[0] = inner_##processor(n, f[0], f[1]); break; \
      case ADD: add_##processor(n, factor, f[0], z->a); break; \
      case INNER_FOUR: inner_four_##processor(n, ROOM, f[0], f[4], z->sums); break; \
      case ADD_FOUR: add_four_##processor(n, ROOM, f[4], f[0], z->a); break; \
      case SMALLEST: z->sums[0] = smallest_##processor(n, f[0]); break; \
      case LARGEST: z->sums[0] = largest_##processor(n, f[0]); break; \
      case FARTHEST: z->sums[0] = farthest_##processor(n, f[0], f[1]); break; \
      case SUBTRACT: subtract_##processor(n, factor, 0.5, z->a); break; \
      case MARK: z->sums[0] = marked(mark_##processor, n, f[2], z); break; \
      case RANGES: find_range(ranges_##processor, n, f[2], z); break; \
      case GAP_SUMS: gap_sums_##processor(n, f[0], f[1], f[2], z->sums); break; \
      case RESIDUALS: z->sums[0] = residuals_##processor(n, r, f[0], f[1], f[2], z->a); break; \
      case CHOOSE_FREE: choose_free_##processor(n, f[2], f[0], 0.5, z->a, z->b); break; \
      case FREE_SUMS: free_sums_##processor(n, f[3], f[0], z->sums); break; \
      case PROJECT: project_##processor(n, f[3], r, z->a, f[0], f[1], z->sums); break; \
      case TURN: turn_##processor(n, factor, f[0], f[1], z->a, z->b); break; \
      case GO_ALONG: z->sums[0] = go_along_##processor(n, factor, f[0], z->a); break; \
      case SLIP_RESIDUAL: residual_##processor(n, n, contact, f[4], f[0], f[1], r, z->sums); break; \
      case STEP: step_##processor(n, n, contact, f[4], factor, f[0], f[1], z->a); break; \
      case LINEARISE: linearise_##processor(n, n, contact, f[4], f[0], f[1], r, z->a, z->b, z->c); break; \
      case PROJECT_CHANGE: project_change_##processor(n, n, f[3], f[5], z->a); break; \
      case JACOBIAN: jacobian_##processor(n, n, f[2], f[5], f[0], f[1], r, creep, z->a); break; \
      case JOIN: join_##processor(n, n, f[2], f[5], f[0], f[1], r, z->a); break; \
      default: column_##processor(n, n / 2 + 1, f[0], factor, contact[0], contact[1], f[1], z->a); break; \
    } \
  }
LOOPS(anywhere)
#ifdef __x86_64__
LOOPS(avx2)
#endif

/* P: vectors reduced to the bound; their remaining length */
static double share_of(double x, double y, double bound) {
  const double length = hypot(x, y);
  return length > bound ? bound / length : 1.0;
}

/* Element k by the definition; sums are added up */
static void define_pressures(int kind, int k, buffers *z) {
  const double h = from[0][k], u = from[1][k], p = from[2][k], gap = r - h - u;
  const int is_free = from[3][k] > 0.0;
  switch (kind) {
    case INNER: z->sums[0] += h * u; break;
    case ADD: z->a[k] += factor * h; break;
    case INNER_FOUR:
      for (int f = 0; f < 4; f++) z->sums[f] += from[f][k] * from[4][k];
      break;
    case ADD_FOUR:
      for (int f = 0; f < 4; f++) z->a[k] += from[4][f] * from[f][k];
      break;
    case GAP_SUMS:
      z->sums[0] += p > 0.0 ? h + u : 0.0;
      z->sums[1] += p > 0.0;
      break;
    case RESIDUALS:
      z->a[k] = p > 0.0 || gap > 0.0 ? gap : 0.0;
      z->sums[0] = fmax(z->sums[0], fabs(z->a[k]));
      break;
    case CHOOSE_FREE:
      z->a[k] = (p > 0.0 || z->b[k] > 0.0) && h < 0.5;
      if (z->a[k] == 0.0) z->b[k] = 0.0;
      break;
    case FREE_SUMS:
      z->sums[0] += is_free ? h : 0.0;
      z->sums[1] += is_free;
      break;
    case PROJECT:
      z->a[k] = is_free ? z->a[k] - r : 0.0;
      z->sums[0] += z->a[k] * h;
      z->sums[1] += z->a[k] * u;
      break;
    case TURN:
      z->a[k] = h + factor * z->a[k];
      z->b[k] = u;
      break;
    default:
      z->a[k] += factor * h;
      z->sums[0] = fmin(z->sums[0], z->a[k]);
      z->a[k] = fmax(z->a[k], 0.0);
      break;
  }
}

/* The same of tractions; n elements in all */
static void define_tractions(int kind, int n, int k, buffers *z) {
  const double px = from[0][k], py = from[0][n + k], sx = from[1][k], sy = from[1][n + k], g = from[4][k];
  const double nx = from[5][k], ny = from[5][n + k], w = kind == PROJECT_CHANGE ? from[3][k] : from[2][k];
  const double zx = px - r * sx, zy = py - r * sy, share = share_of(zx, zy, g), slides = contact[k] && g > 0.0 && share < 1.0;
  const double x = px + factor * sx, y = py + factor * sy, vx = px - r * (sx + creep[0]), vy = py - r * (sy + creep[1]);
  const double ux = z->a[k], uy = z->a[n + k], along = nx * ux + ny * uy;
  switch (kind) {
    case SLIP_RESIDUAL:
      z->sums[0] += contact[k] ? pow(px - share * zx, 2) + pow(py - share * zy, 2) : 0.0;
      z->sums[1] += contact[k] ? g * g : 0.0;
      break;
    case STEP:
      z->a[k] = contact[k] ? share_of(x, y, g) * x : 0.0;
      z->a[n + k] = contact[k] ? share_of(x, y, g) * y : 0.0;
      break;
    case LINEARISE:
      z->a[k] = contact[k] && g > 0.0 ? share : 0.0;
      z->b[k] = slides ? zx / hypot(zx, zy) : 0.0;
      z->b[n + k] = slides ? zy / hypot(zx, zy) : 0.0;
      z->c[k] = contact[k] ? px - share * zx : 0.0;
      z->c[n + k] = contact[k] ? py - share * zy : 0.0;
      break;
    case PROJECT_CHANGE:
      z->a[k] = w * (ux - nx * along);
      z->a[n + k] = w * (uy - ny * along);
      break;
    case JACOBIAN:
      z->a[k] = px - w * (vx - nx * (nx * vx + ny * vy));
      z->a[n + k] = py - w * (vy - ny * (nx * vx + ny * vy));
      break;
    default:
      z->a[k] = w * (ux - nx * along) / r + px - sx;
      z->a[n + k] = w * (uy - ny * along) / r + py - sy;
      break;
  }
}

/* Extrema, states and ranges of n elements */
static void define_fields(int kind, int n, buffers *z) {
  int before = 0, end = n;
  z->sums[0] = kind == SMALLEST ? INFINITY : kind == LARGEST ? -INFINITY : kind == FARTHEST || kind == MARK ? 0.0 : z->sums[0];
  for (int k = 0; k < n; k++) {
    if (kind == SMALLEST) z->sums[0] = fmin(z->sums[0], from[0][k]);
    if (kind == LARGEST) z->sums[0] = fmax(z->sums[0], from[0][k]);
    if (kind == FARTHEST) z->sums[0] = fmax(z->sums[0], fabs(from[0][k] - from[1][k]));
    if (kind == SUBTRACT && z->a[k] < 0.5) z->a[k] -= factor;
    if (kind != MARK) continue;
    z->c[k] = from[2][k] > 0.0 ? (k % 2 == 0 || k % 3 != 0 ? 1.0 : 2.0) : 0.0;
    z->sums[0] += from[2][k] > 0.0;
    if (!(from[2][k] > 0.0)) z->a[k] = z->b[k] = 0.0;
  }
  if (kind != RANGES) return;
  while (end > 0 && from[2][end - 1] <= 0.5) end--;
  while (before < end && from[2][before] <= 0.5) before++;
  for (int k = 0; k < 6; k++) z->c[k] = k == 0 ? before : k == 1 ? end : k == 2 || k == 5 ? -1.0 : 0.0;
}

static void define(int kind, int n, buffers *z) {
  if (kind >= SMALLEST && kind <= RANGES) {
    define_fields(kind, n, z);
    return;
  }
  for (int k = 0; k < n; k++) {
    if (kind == COLUMN) {
      const double f = k <= n / 2 ? from[0][k] : factor * from[0][n - k], re = f * from[1][2 * k], im = f * from[1][2 * k + 1];
      z->a[2 * k] = (contact[1] ? z->a[2 * k] : 0.0) + (contact[0] ? -im : re);
      z->a[2 * k + 1] = (contact[1] ? z->a[2 * k + 1] : 0.0) + (contact[0] ? re : im);
    } else if (kind < SLIP_RESIDUAL) {
      define_pressures(kind, k, z);
    } else {
      define_tractions(kind, n, k, z);
    }
  }
}

static int differences(const buffers *found, const buffers *right) {
  const double *f = found->a, *g = right->a;
  int wrong = 0;
  for (size_t k = 0; k < sizeof *found / sizeof *f; k++) wrong += !(fabs(f[k] - g[k]) <= 1e-13);
  return wrong;
}

/* Numbers of both signs, zeros among the pressures and the bounds, and weights that are 0 or 1 */
static void fill(buffers *start) {
  double *all = start->a;
  for (size_t k = 0; k < sizeof *start / sizeof *all; k++) all[k] = any_number();
  for (int f = 0; f < FIELDS; f++)
    for (int k = 0; k < ROOM; k++) from[f][k] = any_number();
  for (int k = 0; k < ROOM; k++) {
    if (rand() % 3 == 0) from[2][k] = 0.0;
    from[3][k] = rand() % 2;
    from[4][k] = rand() % 4 == 0 ? 0.0 : fabs(from[4][k]);
  }
  for (int k = 0; k < LONGEST; k++) contact[k] = rand() % 4 != 0;
  r = any_number() + 2.0;
  factor = any_number();
  creep[0] = any_number();
  creep[1] = any_number();
  for (int f = 0; f < 4; f++) start->sums[f] = 0.0;
}

int main(void) {
  int wrong = 0, unlike = 0, tried = 0, wide = 0;
#ifdef __x86_64__
  wide = __builtin_cpu_supports("avx2");
#endif
  for (int repeat = 0; repeat < 20; repeat++)
    for (int n = 1; n < LONGEST; n++)
      for (int kind = 0; kind < KINDS; kind++) {
        buffers start, right, found;
        int these;
        fill(&start);
        right = found = start;
        define(kind, n, &right);
        try_anywhere(kind, n, &found);
        these = differences(&found, &right);
        if (these > 0) printf("loop %d, %d numbers: %d wrong\n", kind, n, these);
        wrong += these;
        tried++;
#ifdef __x86_64__
        if (wide) {
          buffers other = start;
          try_avx2(kind, n, &other);
          these = memcmp(&other, &found, sizeof found) != 0;
          if (these > 0) printf("loop %d, %d numbers: other with AVX2\n", kind, n);
          unlike += these;
        }
#endif
      }
  /* NaN is not ignored */
  for (int k = 0; k < LONGEST; k++) {
    buffers z;
    memset(&z, 0, sizeof z);
    memset(from, 0, sizeof from);
    from[1][k] = NAN;
    from[2][k] = 1.0;
    try_anywhere(RESIDUALS, LONGEST, &z);
    if (z.sums[0] <= 1e300) wrong++;
  }
  /* but no extremum */
  for (int k = 0; k < LONGEST; k++) {
    double a[LONGEST] = {0.0};
    a[k] = NAN;
    if (smallest_anywhere(LONGEST, a) != 0.0 || largest_anywhere(LONGEST, a) != 0.0) wrong++;
  }
  printf("%d loops, %d wrong numbers, %d other with AVX2%s\n", tried, wrong, unlike, wide ? "" : ", which is not here");
  return wrong != 0 || unlike != 0;
}
