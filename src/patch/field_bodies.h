/* Loops of field_loops.c, for one kind of processor; see lanes.h */

/* Overlap of the surfaces: the distance minus the approach, except in excluded elements */
TARGET static void OF(subtract)(int n, double approach, double excluded, double *h) {
  const four step = {approach, approach, approach, approach};
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four here = READ_FOUR(h + k);
    FOUR(h + k) = here - WHERE(here < excluded, step);
  }
  for (; k < n; k++) h[k] = h[k] - (h[k] < excluded ? approach : 0.0);
}

/* States by the pressures: elements without pressure are exterior, without tractions; others that were exterior are in adhesion */
TARGET static int OF(mark)(int n, int exterior, int adhesion, const double *pn, double *px, double *py, int *division) {
  four_flags count = {0, 0, 0, 0};
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four_masks touches = READ_FOUR(pn + k) > 0.0;
    const four_flags flags = __builtin_convertvector(touches, four_flags), state = *(four_flags *)(division + k);
    const four_flags was_exterior = state == exterior;
    *(four_flags *)(division + k) = (flags & ((was_exterior & adhesion) | (~was_exterior & state))) | (~flags & exterior);
    FOUR(px + k) = WHERE(touches, READ_FOUR(px + k));
    FOUR(py + k) = WHERE(touches, READ_FOUR(py + k));
    count -= flags;
  }
  int sum = count[0] + count[1] + count[2] + count[3];
  for (; k < n; k++) {
    if (pn[k] > 0.0) {
      sum++;
      if (division[k] == exterior) division[k] = adhesion;
    } else {
      division[k] = exterior;
      px[k] = 0.0;
      py[k] = 0.0;
    }
  }
  return sum;
}
