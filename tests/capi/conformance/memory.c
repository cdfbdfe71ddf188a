/* Many identical cases with implicit initialisation: the same result in each, and constant memory.
 * usage: memory FOLDER_OF_PROFILES */
#include <caddon_flags.h>
#include <contact_addon.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { cases = 150, warm_up = 30, mx = 81, my = 41 };
static int failures = 0;
static const int zero = 0, one = 1, two = 2, four = 4, whole = -1;

static void check(int condition, const char *loop, const char *what) {
  if (condition) return;
  failures++;
  printf("FAILED %s: %s\n", loop, what);
}

/* Resident memory [bytes], 0 if the system does not report it */
static long resident(void) {
  long total = 0, pages = 0;
  FILE *file = fopen("/proc/self/statm", "r");
  if (file == NULL) return 0;
  if (fscanf(file, "%ld %ld", &total, &pages) != 2) pages = 0;
  fclose(file);
  return pages * sysconf(_SC_PAGESIZE);
}

static void calculate(int ire, int icp, const char *loop, double *force) {
  int code = -1;
  double values[24] = {0};
  const int length = 24;
  cntc_calculate(&ire, &icp, &code);
  check(code == 0, loop, "error code");
  if (icp > 0) {
    cntc_getcontactforces(&ire, &icp, &force[0], &force[1], &force[2], &force[3]);
  } else {
    cntc_getglobalforces(&ire, &icp, &length, values);
    memcpy(force, values, 4 * sizeof(double));
  }
}

/* Forces may differ by a tolerance relative to the largest one: in wheel on rail, height and pressures start from the previous
 * ones, to EPS */
static void repeat(int ire, int icp, double tolerance, const char *loop) {
  double first[4], force[4], scale, most = 0.0;
  long before = 0, after;
  int i, k;
  calculate(ire, icp, loop, first);
  scale = fmax(fmax(fabs(first[0]), fabs(first[1])), fabs(first[2]));
  check(fabs(first[0]) + fabs(first[1]) > 1.0, loop, "there is a force");
  for (k = 1; k < cases; k++) {
    if (k == warm_up) before = resident();
    calculate(ire, icp, loop, force);
    for (i = 0; i < 4; i++) most = fmax(most, fabs(force[i] - first[i])/scale);
  }
  after = resident();
  printf("%s: forces differ by %.1e\n", loop, most);
  check(most <= tolerance, loop, "all cases have the same forces");
  check(after - before < 512 * 1024, loop, "memory does not grow");
  printf("%s: %ld kB more in %d cases\n", loop, (after - before) / 1024, cases - warm_up);
}

/* Quadratic distance on a grid that is larger than the contact; with a layer and friction that decreases with slip, or without */
static void basic(int ire, int layer, const char *loop) {
  const int flags[] = {CNTC_if_units, CNTC_ic_tang, CNTC_ic_flow, CNTC_ic_output}, values[] = {CNTC_un_cntc, 3, 0, 0};
  const double material[] = {0.28, 0.28, 82000.0, 82000.0, 100.0, 0.01, 0.0, 0.0};
  const double coulomb[] = {0.3, 0.3}, polach[] = {0.3, 0.6, 0.55e-3};
  const double grid[] = {mx, my, -10.125, -5.125, 0.25, 0.25}, quadratic[] = {1.2e-3, 0.0, 2.4e-3, 0.0, 0.0, 0.0};
  const double approach = 0.02, vx = 0.001, vy = 0.0005, spin = 2e-4, velocity = 30000.0;
  const int three = 3, five = 5, six = 6, eight = 8;

  cntc_setflags(&ire, &one, &four, flags, values);
  if (layer) {
    cntc_setmaterialparameters(&ire, &one, &four, &eight, material);
    cntc_setfrictionmethod(&ire, &one, &five, &three, polach);
  } else {
    cntc_setmaterialparameters(&ire, &one, &zero, &four, material);
    cntc_setfrictionmethod(&ire, &one, &zero, &two, coulomb);
  }
  cntc_setreferencevelocity(&ire, &one, &velocity);
  cntc_setpotcontact(&ire, &one, &one, &six, grid);
  cntc_setundeformeddistc(&ire, &one, &one, &six, quadratic);
  cntc_setpenetration(&ire, &one, &approach);
  cntc_setcreepages(&ire, &one, &vx, &vy, &spin);
  repeat(ire, 1, 0.0, loop);
}

static void set_profile(int ire, const char *folder, const char *file, int kind) {
  char name[1000];
  const double reals[] = {1.0, 0.0};
  const int length = snprintf(name, sizeof name, "%s/%s", folder, file);
  cntc_setprofileinputfname(&ire, name, &length, &one, &kind, &two, reals);
}

static void wheel_on_rail(int ire, const char *folder, const char *loop) {
  const int flags[] = {CNTC_ic_config, CNTC_ic_tang, CNTC_ic_flow, CNTC_ic_output}, values[] = {0, 3, 0, 0};
  const double material[] = {0.28, 0.28, 82000.0, 82000.0}, friction[] = {0.3, 0.3};
  const double grid[] = {0.4, 0.4, 1.5708, 8.0, 4.0}, track[11] = {14.0, 0.0, 1435.0, 0.025};
  const double wheelset[] = {1360.0, -70.0, 460.0}, position[6] = {0.0, 1.0, 0.0, 0.0, 0.0024, 0.0};
  const double velocity[6] = {2000.0, 0.0, 0.0, 0.0, 0.0, -4.34657}, fz = 10000.0, chi = 0.0, step = 1.0;
  const int three = 3, five = 5, six = 6, eleven = 11, minus_one = -1;

  cntc_setflags(&ire, &whole, &four, flags, values);
  cntc_setmaterialparameters(&ire, &whole, &zero, &four, material);
  cntc_setfrictionmethod(&ire, &whole, &zero, &two, friction);
  cntc_setpotcontact(&ire, &whole, &minus_one, &five, grid);
  cntc_setrollingstepsize(&ire, &whole, &chi, &step);
  cntc_settrackdimensions(&ire, &three, &eleven, track);
  cntc_setwheelsetdimensions(&ire, &three, &three, wheelset);
  set_profile(ire, folder, "60E1.prr", 0);
  set_profile(ire, folder, "S1002.prw", 1);
  cntc_setwheelsetposition(&ire, &one, &six, position);
  /* E = 1 is treated as 2 here */
  cntc_setwheelsetvelocity(&ire, &one, &six, velocity);
  cntc_setverticalforce(&ire, &fz);
  repeat(ire, -1, 1e-5, loop);
}

int main(int argc, char **argv) {
  const int flags[] = {CNTC_if_idebug, CNTC_if_openmp}, values[] = {0, 1};
  FILE *file;

  if (argc != 2) return 2;
  cntc_setglobalflags(&two, flags, values);
  basic(7, 0, "Coulomb friction");
  file = fopen("contact_addon.out", "r");
  check(file != NULL, "implicit initialisation", "contact_addon.out exists");
  if (file != NULL) fclose(file);
  basic(8, 1, "layer and falling friction");
  wheel_on_rail(9, argv[1], "wheel on rail");
  cntc_finalizelast();
  printf("memory: %d failed\n", failures);
  return failures != 0;
}
