/* Loops of wheel_loops.c, for one kind of processor; see lanes.h */

/* Newton's method for eight points of a row at once; 1 if all are found on the piece, otherwise nothing is changed */
TARGET static int OF(meet)(const double *piece, const double *y, const double *z, double radius, const double *base, const double *axis,
                           const double *along, double near, double tolerance, int most_steps, const double *x, double *place,
                           double *n) {
  const double first = piece[0], last = piece[1], k1 = along[0], k2 = along[1], k3 = along[2];
  four p[2], h[2], r[2], q1[2], q2[2], q3[2], t[2];
  for (int g = 0; g < 2; g++) {
    p[g] = READ_FOUR(place + 4 * g);
    h[g] = READ_FOUR(n + 4 * g);
  }
  for (int step = 0; step < most_steps; step++) {
    four_masks fits = {-1, -1, -1, -1};
    for (int g = 0; g < 2; g++) {
      const four xg = READ_FOUR(x + 4 * g);
      t[g] = p[g] - first;
      q1[g] = base[0] + axis[0] * xg + k1 * h[g];
      q2[g] = base[1] + axis[1] * xg + k2 * h[g];
      q3[g] = base[2] + axis[2] * xg + k3 * h[g];
      r[g] = radius + z[0] + t[g] * (z[1] + t[g] * (z[2] + t[g] * z[3]));
      fits &= (p[g] >= first) & (p[g] <= last) & (MAGNITUDES(q1[g]) <= near * r[g]);
    }
    if (!ALL_OF(fits)) return 0;
    four_masks solved = {-1, -1, -1, -1};
    for (int g = 0; g < 2; g++) {
      const four y_s = y[1] + t[g] * (2.0 * y[2] + t[g] * 3.0 * y[3]), z_s = z[1] + t[g] * (2.0 * z[2] + t[g] * 3.0 * z[3]);
      const four depth = ROOTS(r[g] * r[g] - q1[g] * q1[g]);
      const four f1 = q2[g] - (y[0] + t[g] * (y[1] + t[g] * (y[2] + t[g] * y[3]))), f2 = q3[g] + radius - depth;
      const four j21 = -r[g] * z_s / depth, j22 = k3 + q1[g] * k1 / depth, det = -y_s * j22 - k2 * j21;
      if (!ALL_OF(MAGNITUDES(det) > 0.0)) return 0;
      /* steps of position and height */
      const four dp = (f1 * j22 - k2 * f2) / det, dh = (-y_s * f2 - f1 * j21) / det;
      p[g] -= dp;
      h[g] -= dh;
      solved &= MAGNITUDES(dp) + MAGNITUDES(dh) <= tolerance * radius;
    }
    if (!ALL_OF(solved)) continue;
    if (!ALL_OF((p[0] >= first) & (p[0] <= last) & (p[1] >= first) & (p[1] <= last))) return 0;
    for (int g = 0; g < 2; g++) {
      FOUR(place + 4 * g) = p[g];
      FOUR(n + 4 * g) = h[g];
    }
    return 1;
  }
  return 0;
}

/* A polynomial of degree 7 at points from -1 to 1 at even distances */
TARGET static void OF(spread)(const double *p, int n, double *values) {
  const double step = 2.0 / (n - 1);
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

/* The locus at the nodes of a profile, a multiple of four, by the first step of its iteration; the number of mesh points that are not
 * beyond each of them */
TARGET static void OF(nodes)(int n, const double *y, const double *z, const double *lean, const double *origin, const double *axes,
                             double radius, double furthest, double start, double per_step, int points, double *x, double *across,
                             double *height, int *below) {
  const four zero = {0.0, 0.0, 0.0, 0.0}, most = zero + furthest * radius, last = zero + (double)points;
  for (int i = 0; i < n; i += 4) {
    const four r = radius + READ_FOUR(z + i), local = READ_FOUR(y + i);
    four along = r * (axes[3] * READ_FOUR(lean + i) - axes[6]) / axes[0];
    along = CHOOSE(along > most, most, CHOOSE(along < -most, -most, along));
    const four drop = ROOTS(r * r - along * along) - radius, place = origin[1] + (axes[1] * along + axes[4] * local + axes[7] * drop);
    FOUR(x + i) = origin[0] + (axes[0] * along + axes[3] * local + axes[6] * drop);
    FOUR(across + i) = place;
    FOUR(height + i) = origin[2] + (axes[2] * along + axes[5] * local + axes[8] * drop);
    const four count = WHERE(place >= start, (place - start) * per_step + 1.0);
    *(four_flags *)(below + i) = __builtin_convertvector(CHOOSE(count > last, last, count), four_flags);
  }
}

/* One coefficient of the pieces of four points */
#define OF_PIECES(c, k, power) ((four){(c)[4 * (k)[0] + (power)], (c)[4 * (k)[1] + (power)], (c)[4 * (k)[2] + (power)], (c)[4 * (k)[3] + (power)]})

/* Points of the locus at given lateral positions, each on its piece, by Newton's method */
TARGET static void OF(locus)(int n, const double *target, const int *piece, const double *ends, const double *cy, const double *cz,
                             const double *origin, const double *axes, double radius, double furthest, double steepest,
                             double accuracy, double tolerance, int most_steps, const double *place, double *x, double *z, int *found) {
  const four zero = {0.0, 0.0, 0.0, 0.0}, most = zero + furthest * radius, steep = zero + steepest;
  for (int i = 0; i < n; i += 4) {
    int k[4];
    four aim, t, length;
    for (int lane = 0; lane < 4; lane++) {
      const int point = i + lane < n ? i + lane : n - 1;
      k[lane] = piece[point] - 1;
      aim[lane] = target[point];
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
