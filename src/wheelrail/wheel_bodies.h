/* Loops of wheel_loops.c, for one kind of processor; see lanes.h */

/* One coefficient of the pieces of four points */
#define OF_PIECES(c, k, power) ((four){(c)[4 * (k)[0] + (power)], (c)[4 * (k)[1] + (power)], (c)[4 * (k)[2] + (power)], (c)[4 * (k)[3] + (power)]})

/* Coefficients of the pieces on which four points lie */
typedef struct {
  int piece[4];
  four start, end, y0, y1, y2, y3, z0, z1, z2, z3;
} OF(four_pieces);

/* Find the pieces of four positions, each starting from that of the one before; `near` is the first estimate. False beyond the ends of
 * the profile */
TARGET static inline int OF(find_pieces)(const double *place, int near, int pieces, const double *ends, const double *cy,
                                         const double *cz, OF(four_pieces) *at) {
  int k = near;
  for (int lane = 0; lane < 4; lane++) {
    if (!(place[lane] >= ends[0] && place[lane] <= ends[pieces])) return 0;
    while (place[lane] > ends[k + 1]) k++;
    while (place[lane] < ends[k]) k--;
    at->piece[lane] = k;
    at->start[lane] = ends[k];
    at->end[lane] = ends[k + 1];
  }
  const int *of = at->piece;
  at->y0 = OF_PIECES(cy, of, 0);
  at->y1 = OF_PIECES(cy, of, 1);
  at->y2 = OF_PIECES(cy, of, 2);
  at->y3 = OF_PIECES(cy, of, 3);
  at->z0 = OF_PIECES(cz, of, 0);
  at->z1 = OF_PIECES(cz, of, 1);
  at->z2 = OF_PIECES(cz, of, 2);
  at->z3 = OF_PIECES(cz, of, 3);
  return 1;
}

/* Newton's method for eight points of a row at once; 1 if all are found, otherwise nothing is changed but the piece */
TARGET static int OF(meet)(int pieces, const double *ends, const double *cy, const double *cz, double radius, const double *base,
                           const double *axis, const double *along, double near, double tolerance, int most_steps, const double *x,
                           int *piece, double *place, double *n) {
  const double k1 = along[0], k2 = along[1], k3 = along[2];
  four p[2], h[2];
  OF(four_pieces) at[2];
  for (int g = 0; g < 2; g++) {
    p[g] = READ_FOUR(place + 4 * g);
    h[g] = READ_FOUR(n + 4 * g);
    if (!OF(find_pieces)((const double *)(p + g), g == 0 ? *piece - 1 : at[0].piece[3], pieces, ends, cy, cz, at + g)) return 0;
  }
  *piece = at[0].piece[0] + 1;
  for (int step = 0; step < most_steps; step++) {
    four_masks solved = {-1, -1, -1, -1}, inside = solved, fits = solved;
    for (int g = 0; g < 2; g++) {
      const OF(four_pieces) *c = at + g;
      const four xg = READ_FOUR(x + 4 * g), t = p[g] - c->start;
      const four q1 = base[0] + axis[0] * xg + k1 * h[g], q2 = base[1] + axis[1] * xg + k2 * h[g];
      const four q3 = base[2] + axis[2] * xg + k3 * h[g], r = radius + c->z0 + t * (c->z1 + t * (c->z2 + t * c->z3));
      const four y_s = c->y1 + t * (2.0 * c->y2 + t * 3.0 * c->y3), z_s = c->z1 + t * (2.0 * c->z2 + t * 3.0 * c->z3);
      const four depth = ROOTS(r * r - q1 * q1);
      const four f1 = q2 - (c->y0 + t * (c->y1 + t * (c->y2 + t * c->y3))), f2 = q3 + radius - depth;
      const four j21 = -r * z_s / depth, j22 = k3 + q1 * k1 / depth, det = -y_s * j22 - k2 * j21;
      /* steps of position and height */
      const four dp = (f1 * j22 - k2 * f2) / det, dh = (-y_s * f2 - f1 * j21) / det;
      fits &= (MAGNITUDES(q1) <= near * r) & (MAGNITUDES(det) > 0.0);
      p[g] -= dp;
      h[g] -= dh;
      solved &= MAGNITUDES(dp) + MAGNITUDES(dh) <= tolerance;
      inside &= (p[g] >= c->start) & (p[g] <= c->end);
    }
    if (!ALL_OF(fits)) return 0;
    if (!ALL_OF(inside)) {
      for (int g = 0; g < 2; g++)
        if (!OF(find_pieces)((const double *)(p + g), at[g].piece[0], pieces, ends, cy, cz, at + g)) return 0;
    }
    if (!ALL_OF(solved)) continue;
    for (int g = 0; g < 2; g++) {
      FOUR(place + 4 * g) = p[g];
      FOUR(n + 4 * g) = h[g];
    }
    return 1;
  }
  return 0;
}

/* The polynomial of degree 7 through the values at eight nodes, at points from -1 to 1 at even distances: `powers` are the coefficients
 * of the powers for a unit value at each node. `last` are the magnitudes of the coefficients of the two highest powers */
TARGET static void OF(spread)(const double *powers, const double *node, int n, double *values, double *last) {
  four low = {0.0, 0.0, 0.0, 0.0}, high = low;
  for (int k = 0; k < 8; k++) {
    low += node[k] * READ_FOUR(powers + 8 * k);
    high += node[k] * READ_FOUR(powers + 8 * k + 4);
  }
  const double p[8] = {low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]}, step = 2.0 / (n - 1);
  last[0] = fabs(p[6]);
  last[1] = fabs(p[7]);
  int i = 0;
  for (; i + 3 < n; i += 4) {
    const four t = (four){i, i + 1, i + 2, i + 3} * step - 1.0;
    FOUR(values + i) = p[0] + t * (p[1] + t * (p[2] + t * (p[3] + t * (p[4] + t * (p[5] + t * (p[6] + t * p[7]))))));
  }
  for (; i < n; i++) {
    const double t = i * step - 1.0;
    values[i] = p[0] + t * (p[1] + t * (p[2] + t * (p[3] + t * (p[4] + t * (p[5] + t * (p[6] + t * p[7]))))));
  }
}

/* The next longitudinal position of the locus in its iteration on a roller, whose surface falls along the track: from the position
 * before, with the depth below the axle there, slope times radius of the wheel, and radius of the roller below. `lowest` is the least height
 * above the axle of the roller */
TARGET static inline void OF(along_roller)(const four *before, const four *depth, const four *local, const four *lean, const four *below,
                                           double radius, double roller, double lowest, const double *origin, const double *axes,
                                           four *along) {
  const four zero = {0.0, 0.0, 0.0, 0.0}, least = zero + lowest, tiny = zero + 1e-300, drop = *depth - radius;
  const four x = origin[0] + (axes[0] * *before + axes[3] * *local + axes[6] * drop);
  const four over_axle = roller - (origin[2] + (axes[2] * *before + axes[5] * *local + axes[8] * drop));
  const four square = *below * *below - x * x, fall = x / ROOTS(CHOOSE(square > tiny, square, tiny));
  const four next =
      ((axes[3] + fall * axes[5]) * *lean - (axes[6] + fall * axes[8]) * *depth) / (axes[0] + fall * axes[2]);
  *along = *before + (next - *before) / (1.0 + *depth / CHOOSE(over_axle > least, over_axle, least));
}

/* The locus at the nodes of a profile, a multiple of four, by the first step of its iteration, two on a roller; the number of mesh points that are not
 * beyond each of them. `roller` is the radius of a roller, 0 on a track */
TARGET static void OF(nodes)(int n, const double *y, const double *z, const double *lean, const double *origin, const double *axes,
                             double radius, double furthest, double roller, double lowest, double start, double per_step, int points, double *x,
                             double *across, double *height, int *below) {
  const four zero = {0.0, 0.0, 0.0, 0.0}, most = zero + furthest * radius, last = zero + (double)points;
  for (int i = 0; i < n; i += 4) {
    const four r = radius + READ_FOUR(z + i), local = READ_FOUR(y + i);
    four along = r * (axes[3] * READ_FOUR(lean + i) - axes[6]) / axes[0];
    if (roller > 0.0) {
      const four slope = r * READ_FOUR(lean + i), top = zero + roller;
      OF(along_roller)(&zero, &r, &local, &slope, &top, radius, roller, lowest, origin, axes, &along);
      // steep pieces of a yawed wheel are beyond its ends
      const four before = CHOOSE(along > most, most, CHOOSE(along < -most, -most, along)), deep = ROOTS(r * r - before * before);
      OF(along_roller)(&before, &deep, &local, &slope, &top, radius, roller, lowest, origin, axes, &along);
    }
    along = CHOOSE(along > most, most, CHOOSE(along < -most, -most, along));
    const four drop = ROOTS(r * r - along * along) - radius, place = origin[1] + (axes[1] * along + axes[4] * local + axes[7] * drop);
    FOUR(x + i) = origin[0] + (axes[0] * along + axes[3] * local + axes[6] * drop);
    FOUR(across + i) = place;
    FOUR(height + i) = origin[2] + (axes[2] * along + axes[5] * local + axes[8] * drop);
    const four count = WHERE(place >= start, (place - start) * per_step + 1.0);
    *(four_flags *)(below + i) = __builtin_convertvector(CHOOSE(count > last, last, count), four_flags);
  }
}

/* Points of the locus at given lateral positions, each on its piece, by Newton's method. `roller` is the radius of a roller, 0 on a
 * track, and `rail` the height of its profile at these positions */
TARGET static void OF(locus)(int n, const double *target, const double *rail, const int *piece, int pieces, const double *ends,
                             const double *cy, const double *cz, const double *origin, const double *axes, double radius,
                             double furthest, double roller, double lowest, double steepest, double accuracy, double tolerance, int most_steps,
                             const double *place, double *x, double *z, int *found) {
  const four zero = {0.0, 0.0, 0.0, 0.0}, most = zero + furthest * radius, steep = zero + steepest;
  for (int i = 0; i < n; i += 4) {
    int k[4];
    four aim, t, length, top;
    for (int lane = 0; lane < 4; lane++) {
      const int point = i + lane < n ? i + lane : n - 1;
      k[lane] = (piece[point] < pieces ? piece[point] : pieces) - 1;
      aim[lane] = target[point];
      top[lane] = rail[point];
      t[lane] = place[point];
      length[lane] = ends[k[lane] + 1] - ends[k[lane]];
    }
    const four y0 = OF_PIECES(cy, k, 0), y1 = OF_PIECES(cy, k, 1), y2 = OF_PIECES(cy, k, 2), y3 = OF_PIECES(cy, k, 3);
    const four z0 = OF_PIECES(cz, k, 0), z1 = OF_PIECES(cz, k, 1), z2 = OF_PIECES(cz, k, 2), z3 = OF_PIECES(cz, k, 3);
    four_masks solved = {0, 0, 0, 0};
    four along = zero, in_track[2] = {zero, zero};
    for (int step = 0; step < most_steps; step++) {
      const four local = y0 + t * (y1 + t * (y2 + t * y3)), r = radius + z0 + t * (z1 + t * (z2 + t * z3));
      const four y_s = y1 + t * (2.0 * y2 + t * 3.0 * y3), z_s = z1 + t * (2.0 * z2 + t * 3.0 * z3);
      const four before = along, lean = r * (z_s / CHOOSE(y_s < steep, y_s, steep));
      if (roller > 0.0) {
        const four deep = ROOTS(r * r - before * before), below = roller - top;
        OF(along_roller)(&before, &deep, &local, &lean, &below, radius, roller, lowest, origin, axes, &along);
      } else
        along = (axes[3] * lean - axes[6] * ROOTS(r * r - before * before)) / axes[0];
      along = CHOOSE(along > most, most, CHOOSE(along < -most, -most, along));
      const four depth = ROOTS(r * r - along * along), drop = depth - radius;
      const four miss = origin[1] + (axes[1] * along + axes[4] * local + axes[7] * drop) - aim;
      in_track[0] = origin[0] + (axes[0] * along + axes[3] * local + axes[6] * drop);
      in_track[1] = origin[2] + (axes[2] * along + axes[5] * local + axes[8] * drop);
      solved = (MAGNITUDES(miss) <= accuracy) & (MAGNITUDES(along - before) <= tolerance * radius) & (t >= 0.0) & (t <= length);
      if (ALL_OF(solved)) break;
      /* the position along the track changes little: by the square of the yaw angle */
      t -= miss / (axes[4] * y_s + axes[7] * r * z_s / depth);
    }
    for (int lane = 0; lane < 4 && i + lane < n; lane++) {
      x[i + lane] = in_track[0][lane];
      z[i + lane] = in_track[1][lane];
      found[i + lane] = solved[lane] != 0;
    }
  }
}
#undef OF_PIECES
