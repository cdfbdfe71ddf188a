/* A vehicle of four wheelsets on a straight track: one call of the library per wheel and time step.
 *
 * usage: vehicle FOLDER_OF_PROFILES [--check] [--derivatives] [--simplified] [--calls FILE] [STEPS]
 *
 * --simplified uses the tractions of Fastsim and FaStrip, with pressures of the full theory, of KPEC and of ANALYN.
 * --derivatives requests the derivatives of the forces after each call, and reports their time with that of the call.
 *
 * Prints the distribution of the processor time of calls, with the goals of doc/validation/performance.md, and their requests to
 * the heap. --calls writes a line for every call to a file, for vehicle_calls.py. --check tests what does not depend
 * on the machine: forces depend on the previous calls only within the tolerance, they are smooth, no call fails, and none of the
 * calls of a result element after its first 50 requests memory from the system. */
#define _POSIX_C_SOURCE 200809L
#include <caddon_flags.h>
#include <contact.h>
#include <contact_addon.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { wheels = 8, sweep = 80 };
static const double pi = 3.14159265358979323846, radius = 460.0, speed = 25000.0, usual_eps = 1e-5, load = 62500.0;
static double eps = 1e-5;
static const int whole = -1, zero = 0;
static const char *folder;
/* M and B of all set-ups: theory of the tractions and of the pressures */
static int theory = 0, pressures = 0;
static int failures = 0;
static FILE *calls;
long bench_allocations(void);

static void check(int condition, const char *what, double value) {
  if (condition) return;
  failures++;
  printf("FAILED %s: %g\n", what, value);
}

/* Position and velocity of a wheelset [mm, rad, s] */
typedef struct {
  double y, yaw, roll, vy, vyaw, vpitch, fz;
} position;

static double seconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void profile(int ire, const char *name) {
  char path[1000];
  int length, numbers[3] = {-1, 0, 0};
  const int three = 3, two = 2;
  double reals[2] = {1.0, 0.0};
  snprintf(path, sizeof path, "%s/%s", folder, name);
  length = (int)strlen(path);
  cntc_setprofileinputfname(&ire, path, &length, &three, numbers, &two, reals);
}

/* A wheel on the left or on the right rail; P selects what a case continues */
static void set_up(int ire, int left, double side, int p) {
  const int one = 1, two = 2, four = 4, five = 5, seven = 7, nine = 9, three = 3, eleven = 11, type = -1;
  const int flags[] = {CNTC_if_units, CNTC_ic_config, CNTC_ic_tang, CNTC_ic_pvtime,
                       CNTC_ic_norm,  CNTC_ic_output, CNTC_ic_flow, CNTC_ic_discns, CNTC_ic_bound};
  const int values[] = {CNTC_un_cntc, left ? 0 : 1, 3, p, 1, 0, 0, 2, pressures}, limits[] = {999, 100, 30, 1};
  /* additional input of simplified theory: no reduction of slopes */
  const double steel[] = {0.28, 0.28, 82000.0, 82000.0, 1.0, 0.125, 1.0}, coulomb[] = {0.35, 0.35}, no_offset = 0.0, step = 1.0;
  const double grid[] = {side, side, pi / 2, 8.0, 4.0}, set[] = {1360.0, -70.0, radius};
  const double track[] = {14.0, 0.0, 1435.0, 0.025, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  int version, error;
  cntc_initialize(&ire, &one, &version, &error, " ", &one);
  cntc_setflags(&ire, &whole, &nine, flags, values);
  cntc_setmaterialparameters(&ire, &whole, &theory, theory == 0 ? &four : &seven, steel);
  cntc_setfrictionmethod(&ire, &whole, &zero, &two, coulomb);
  cntc_setsolverflags(&ire, &whole, &zero, &four, limits, &one, &eps);
  cntc_setpotcontact(&ire, &whole, &type, &five, grid);
  cntc_setrollingstepsize(&ire, &whole, &no_offset, &step);
  cntc_settrackdimensions(&ire, &three, &eleven, track);
  cntc_setwheelsetdimensions(&ire, &three, &three, set);
  profile(ire, "60E1.prr");
  profile(ire, "S1002.prw");
}

/* One call: FX, FY, FZ, MX, MY, MZ on the rail */
static int step(int ire, position at, double *force) {
  const int flags = 2, six = 6, length = 24;
  const double place[] = {0.0, at.y, 0.0, at.roll, at.yaw, 0.0}, rate[] = {speed, at.vy, 0.0, 0.0, at.vyaw, at.vpitch};
  double values[24] = {0};
  int error = -1;
  cntc_setwheelsetposition(&ire, &flags, &six, place);
  cntc_setwheelsetvelocity(&ire, &flags, &six, rate);
  cntc_setverticalforce(&ire, &at.fz);
  cntc_calculate(&ire, &whole, &error);
  cntc_getglobalforces(&ire, &whole, &length, values);
  memcpy(force, values, 6 * sizeof(double));
  return error;
}

/* Hunting up to flange contact, on an uneven track, with loads that alternate between the wheels; 1 ms per step */
static position on_the_way(int wheel, int k) {
  const double t = 1e-3 * k, w = 2 * pi * 1.3, late = 0.9 * (wheel / 2), a = 4.9, b = 0.0021;
  position at;
  at.y = 0.6 + a * sin(w * t + late) + 0.25 * sin(2 * pi * 9.0 * t + late);
  at.vy = a * w * cos(w * t + late) + 0.25 * 2 * pi * 9.0 * cos(2 * pi * 9.0 * t + late);
  at.yaw = b * cos(w * t + late);
  at.vyaw = -b * w * sin(w * t + late);
  at.roll = 2e-4 * sin(w * t + late);
  at.vpitch = -speed / radius * (1.0 + 8e-4 * sin(2 * pi * 1.7 * t + wheel));
  at.fz = load + 9000.0 * sin(2 * pi * 2.5 * t + 0.7 * wheel);
  return at;
}

static int compare(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return x < y ? -1 : x > y;
}

/* Compare a measured value with its goal [ms]; 0: no goal */
static void judge(double measured, double goal) {
  if (goal > 0.0) printf(" %g: %s |", goal, measured <= goal ? "met" : "MISSED");
  else printf(" |");
}

/* Requests to the heap in the second half of the calls of a run: number of calls; mean, median and 99 % of the requests */
typedef struct {
  int n;
  double mean, median, most;
} request_count;

static request_count count_requests(double *each, int n) {
  request_count count = {n, 0.0, 0.0, 0.0};
  int k;
  for (k = 0; k < n; k++) count.mean += each[k] / n;
  qsort(each, (size_t)n, sizeof(double), compare);
  count.median = each[n / 2];
  count.most = each[99 * n / 100];
  return count;
}

/* All wheels, all steps: distribution of the time of calls [ms], with goals for the median, for 99 % and for the largest */
static void drive(double side, int steps, const double *goal) {
  double *time = malloc(sizeof(double) * (size_t)(wheels * steps)), force[6], sum = 0.0, from;
  double *requests = malloc(sizeof(double) * (size_t)(wheels * steps));
  int k, wheel, n = wheels * steps, unsolved = 0, missed = 0;
  request_count count;
  long before;
  if (time == NULL || requests == NULL) exit(1);
  for (wheel = 0; wheel < wheels; wheel++) set_up(wheel + 1, wheel % 2, side, 2);
  for (k = 0; k < steps; k++)
    for (wheel = 0; wheel < wheels; wheel++) {
      before = bench_allocations();
      from = seconds();
      unsolved += step(wheel + 1, on_the_way(wheel, k), force) != 0;
      time[wheels * k + wheel] = 1e3 * (seconds() - from);
      requests[wheels * k + wheel] = (double)(bench_allocations() - before);
      if (calls != NULL)
        fprintf(calls, "%g %d %d %.5f %.15g %.15g %.15g\n", side, wheel, k, time[wheels * k + wheel], force[0], force[1], force[2]);
      missed += fabs(force[2] / on_the_way(wheel, k).fz - 1.0) > eps;
    }
  /* tractions of simplified theory jump when elements enter the contact: some forces cannot be reached */
  if (theory == 0) check(unsolved + missed == 0, "calls that fail, or miss the vertical force", unsolved + missed);
  else if (missed > 0) printf("%d calls miss the vertical force by more than EPS, %d of them end so\n", missed, unsolved);
  for (wheel = 1; wheel <= wheels; wheel++) cntc_finalize(&wheel);
  for (k = 0; k < n; k++) sum += time[k];
  qsort(time, (size_t)n, sizeof(double), compare);
  printf("| %.1f | %d | %.2f | %.2f | %.2f | %.2f | %.2f |", side, n, sum / n, time[n / 2], time[9 * n / 10], time[99 * n / 100],
         time[n - 1]);
  judge(time[n / 2], goal[0]);
  judge(time[99 * n / 100], goal[1]);
  judge(time[n - 1], goal[2]);
  count = count_requests(requests + n / 2, n - n / 2);
  if (bench_allocations() < 0) printf(" unknown | |\n");
  else printf(" %.2f | %.0f |\n", count.mean, count.most);
  free(time);
  free(requests);
}

/* A wheel with starting values from the previous step, and without */
static void compare_with_fresh(int wheel, double side, int from, int steps, int p) {
  double force[6], fresh[6], worst = 0.0;
  int k, i;
  set_up(1, 1, side, p);
  for (k = from; k < from + steps; k++) {
    step(1, on_the_way(wheel, k), force);
    if ((k - from) % 4 != 3) continue;
    set_up(2, 1, side, 2);
    step(2, on_the_way(wheel, k), fresh);
    for (i = 0; i < 3; i++) worst = fmax(worst, fabs(force[i] - fresh[i]) / fresh[2]);
    i = 2;
    cntc_finalize(&i);
  }
  i = 1;
  cntc_finalize(&i);
  printf("M = %d, B = %d, DX = %.1f, P = %d: forces with and without a past differ by %.1e FZ\n", theory, pressures, side, p, worst);
  check(worst <= 0.5 * eps, "forces depend on the past", worst);
}

/* A kind of calculation whose requests are counted: member of the list below */
typedef struct {
  const char *name;
  double side;
  int steps, tang, theory, pressures, norm, search, roller, law, heat, jacobian, order, inclined;
  /* Mean position and width of the random walk [mm]; cant [rad]; distances at which patches are combined and separated [mm] */
  double y, width, cant, combine, separate;
} kind;

static const kind kinds[] = {
    {"full theory, 1.0 mm", 1.0, 400, 3, 0, 0, 1, 2, 0, 0, 0, 0, 1, 0, 1.2, 4.8, 0.025, 4.0, 8.0},
    {"full theory, 0.5 mm", 0.5, 200, 3, 0, 0, 1, 2, 0, 0, 0, 0, 1, 0, 1.2, 4.8, 0.025, 4.0, 8.0},
    {"flange, second order, derivatives", 1.0, 150, 3, 0, 0, 1, 2, 0, 0, 0, 1, 2, 0, 5.5, 1.2, 0.025, 4.0, 8.0},
    {"one and two patches", 1.0, 150, 3, 0, 0, 1, 2, 0, 0, 0, 0, 1, 0, 6.0, 0.4, 0.05, 0.5, 1.0},
    {"shifts", 1.0, 100, 1, 0, 0, 1, 2, 0, 0, 0, 0, 1, 0, 1.2, 4.8, 0.025, 4.0, 8.0},
    {"transient rolling", 1.0, 150, 2, 0, 0, 1, 2, 0, 0, 0, 0, 1, 0, 1.2, 4.8, 0.025, 4.0, 8.0},
    {"no tractions", 1.0, 100, 0, 0, 0, 1, 2, 0, 0, 0, 0, 1, 0, 1.2, 4.8, 0.025, 4.0, 8.0},
    {"Fastsim, KPEC", 1.0, 150, 3, 3, 5, 1, 2, 0, 0, 0, 0, 1, 0, 1.2, 4.8, 0.025, 4.0, 8.0},
    {"FaStrip, ANALYN", 1.0, 150, 3, 5, 6, 1, 2, 0, 0, 0, 0, 1, 0, 1.2, 4.8, 0.025, 4.0, 8.0},
    {"Fastsim", 1.0, 150, 3, 3, 0, 1, 2, 0, 0, 0, 0, 1, 0, 1.2, 4.8, 0.025, 4.0, 8.0},
    {"height prescribed", 1.0, 150, 3, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 1.2, 0.3, 0.025, 4.0, 8.0},
    {"rollers", 1.0, 150, 3, 0, 0, 1, 2, 1, 0, 0, 0, 1, 0, 1.2, 4.8, 0.0, 4.0, 8.0},
    {"slip of each element", 1.0, 100, 3, 0, 0, 1, 3, 0, 0, 0, 0, 1, 0, 1.2, 4.8, 0.025, 4.0, 8.0},
    {"curved reference, inclined coefficients", 1.0, 70, 3, 0, 0, 1, 4, 0, 0, 0, 0, 1, 1, 1.2, 4.8, 0.025, 4.0, 8.0},
    {"search along the locus", 1.0, 100, 3, 0, 0, 1, 5, 0, 0, 0, 0, 1, 0, 1.2, 4.8, 0.025, 4.0, 8.0},
    {"falling friction, temperatures", 1.0, 100, 3, 0, 0, 1, 2, 0, 2, 1, 0, 1, 0, 1.2, 4.8, 0.025, 4.0, 8.0},
};

/* Uniform numbers between -1 and 1, the same on all machines */
static double uniform(void) {
  static unsigned long long state = 20261127ULL;
  state = state*6364136223846793005ULL + 1442695040888963407ULL;
  return (double)(state >> 11)/4503599627370496.0 - 1.0;
}

/* Requests to the system of a wheel on a random walk, from the first call after `first_calls` on: none in any call */
static void judge_requests(const kind *this) {
  enum { first_calls = 50 };
  const int one = 1, seven = 7, nine = 9, five = 5, eleven = 11, three = 3, type = -1;
  const double heat[] = {20.0, 450.0, 0.05, 7.85e-6, 20.0, 450.0, 0.05, 7.85e-6, 1.0};
  const double falling[] = {0.2, 0.15, 300.0, 0.0, 1.0, 0.01, 1.0};
  const double grid[] = {this->side, this->side, pi / 2, this->separate, this->combine};
  const double track[] = {14.0, 0.0, 1435.0, this->cant, this->roller ? 500.0 : 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const int flags[] = {CNTC_ic_config, CNTC_ic_tang,   CNTC_ic_discns, CNTC_own_order,
                       CNTC_ic_inflcf, CNTC_ic_ifmeth, CNTC_ic_ifvari};
  const int values[] = {this->roller ? 5 : 1, this->tang, this->search, this->order, 4, 1, 4};
  const int position_flag = 2, six = 6, length = 24;
  double at[6] = {0.0, this->y, 0.0, 0.0, 0.001, 0.0}, rate[6] = {this->roller ? speed / 500.0 : speed, 0.0, 0.0, 0.0, 0.0, 0.0};
  double force[24], fz = load, height = 0.0, slip = 1.0005, drift = 0.0;
  double jacobian[CONTACT_JACOBIAN_ROWS * CONTACT_JACOBIAN_COLUMNS];
  int k, error, patches, most = 0, late = 0, failed = 0, state;
  long before, requests = 0;
  if (bench_allocations() < 0) return;
  theory = this->theory;
  pressures = this->pressures;
  set_up(1, 0, this->side, 2);
  theory = pressures = 0;
  cntc_setflags(&one, &whole, this->inclined ? &seven : &(const int){4}, flags, values);
  cntc_setpotcontact(&one, &whole, &type, &five, grid);
  cntc_settrackdimensions(&one, &three, &eleven, track);
  if (this->law != 0) cntc_setfrictionmethod(&one, &whole, &this->law, &seven, falling);
  if (this->heat) cntc_settemperaturedata(&one, &whole, &three, &nine, heat);
  for (k = 0; k < first_calls + this->steps; k++) {
    drift = 0.9 * drift + 0.02 * uniform();
    if (fabs(at[1] + drift - this->y) > this->width) drift = -drift;
    at[1] += drift;
    at[3] = 0.98 * at[3] + 2e-5 * uniform();
    at[4] = 0.98 * at[4] + 4e-4 * uniform();
    fz = load + 0.95 * (fz - load) + 5000.0 * uniform();
    slip = 1.0003 + 0.98 * (slip - 1.0003) + 1e-4 * uniform();
    rate[1] = 1000.0 * drift;
    rate[5] = -slip * speed / radius;
    at[2] = 0.0;
    before = bench_allocations();
    if (this->norm == 0 && k > 1) {
      at[2] = height + 0.02 * uniform();
      cntc_setflags(&one, &whole, &one, (const int[]){CNTC_ic_norm}, &zero);
    }
    cntc_setwheelsetposition(&one, &position_flag, &six, at);
    cntc_setwheelsetvelocity(&one, &position_flag, &six, rate);
    if (this->norm == 1 || k <= 1) cntc_setverticalforce(&one, &fz);
    cntc_calculate(&one, &whole, &error);
    cntc_getglobalforces(&one, &whole, &length, force);
    cntc_getnumcontactpatches(&one, &patches);
    if (k <= 1) {
      double now[6];
      cntc_getwheelsetposition(&one, &six, now);
      height = now[2];
    }
    if (this->jacobian) {
      state = contact_wheel_rail_jacobian(one, jacobian, (int)(sizeof jacobian / sizeof jacobian[0]), NULL, 0);
      check(state == CONTACT_DERIVATIVE_EXACT || state == CONTACT_DERIVATIVE_ONE_SIDED, "there are no derivatives at step", k);
    }
    failed += error != 0 && this->theory == 0;
    if (patches > most) most = patches;
    if (k < first_calls || bench_allocations() == before) continue;
    late++;
    requests += bench_allocations() - before;
  }
  cntc_finalize(&one);
  printf("%-40s %3d calls after the first %d, up to %d patches: %d with requests to the system, %ld requests\n", this->name,
         this->steps, first_calls, most, late, requests);
  check(late == 0, "calls with requests to the system", late);
  check(failed == 0, "calls that fail", failed);
  if (this->combine < 1.0) check(most > 1, "patches of a walk with two of them", most);
}

/* The same for the cases of an example that are solved again and again as a batch */
static void judge_batch(const char *example) {
  enum { first_calls = 5, calls_in_all = 15, rows = 200, columns = 100, cases = 30, letters = 20000, reason_length = 100 };
  static char text[letters], reasons[cases][reason_length];
  static double values[rows][columns];
  static int places[rows][2], states[cases][2];
  char path[1000], message[200];
  contact_batch_job job = {0};
  contact_batch *batch = contact_batch_open(1, 0.0);
  FILE *file;
  int k, late = 0, failed = batch == NULL;
  long before, requests = 0;
  size_t n;
  if (bench_allocations() < 0) return;
  snprintf(path, sizeof path, "%s/../%s", folder, example);
  file = fopen(path, "r");
  check(file != NULL, example, 0.0);
  if (file == NULL || batch == NULL) return;
  n = fread(text, 1, letters - 1, file);
  text[n] = 0;
  fclose(file);
  snprintf(path, sizeof path, "%s/..", folder);
  job.text = text;
  job.folder = path;
  job.room_rows = rows;
  job.room_columns = columns;
  job.room_cases = cases;
  job.values = values[0];
  job.places = places[0];
  job.states = states[0];
  job.reasons = reasons[0];
  job.reason_length = reason_length;
  for (k = 0; k < calls_in_all; k++) {
    before = bench_allocations();
    failed += contact_batch_solve(batch, &job, message, sizeof message) != 0 || job.rows < 1;
    if (k < first_calls || bench_allocations() == before) continue;
    late++;
    requests += bench_allocations() - before;
  }
  contact_batch_close(batch);
  printf("%s as a batch: %d calls with requests to the system, %ld requests\n", example, late, requests);
  check(late == 0, "calls with requests to the system", late);
  check(failed == 0, "calls that fail", failed);
}

/* Residual of a least-squares cubic through the values of a sweep, root of the mean square */
static double noise(const double *f) {
  double a[4][5] = {{0}}, p[4] = {1.0, 0.0, 0.0, 0.0}, sum = 0.0, t, v, factor;
  int i, j, k, r;
  for (i = 0; i < sweep; i++) {
    t = 2.0 * i / (sweep - 1) - 1.0;
    for (j = 1; j < 4; j++) p[j] = p[j - 1] * t;
    for (j = 0; j < 4; j++) {
      for (k = 0; k < 4; k++) a[j][k] += p[j] * p[k];
      a[j][4] += p[j] * (f[i] - f[0]);
    }
  }
  for (j = 0; j < 4; j++)
    for (r = 0; r < 4; r++) {
      if (r == j) continue;
      factor = a[r][j] / a[j][j];
      for (k = j; k < 5; k++) a[r][k] -= factor * a[j][k];
    }
  for (i = 0; i < sweep; i++) {
    t = 2.0 * i / (sweep - 1) - 1.0;
    for (v = 0.0, j = 3; j >= 0; j--) v = v * t + a[j][4] / a[j][j];
    sum += (f[i] - f[0] - v) * (f[i] - f[0] - v);
  }
  return sqrt(sum / sweep);
}

/* Totals of small lateral steps, as in an implicit integrator: FX, FY, FZ and MZ by position */
static void pass_slowly(double side, double y0, double tolerance, double f[4][sweep]) {
  static const int which[4] = {0, 1, 2, 5};
  double force[6];
  position at = on_the_way(0, 0);
  int i, j;
  eps = tolerance;
  set_up(1, 1, side, 2);
  eps = usual_eps;
  at.vy = at.vyaw = at.roll = 0.0;
  at.yaw = 0.002;
  at.fz = load;
  for (i = -2; i < sweep; i++) {
    at.y = y0 + 1e-4 * i;
    step(1, at, force);
    for (j = 0; j < 4; j++)
      if (i >= 0) f[j][i] = force[which[j]];
  }
  i = 1;
  cntc_finalize(&i);
}

/* Noise of FX, FY, FZ, and MZ over 1 mm, of what the tolerance adds to the solution; where no element enters or leaves the
   contact or the adhesion area, also of the solution itself, which has a kink there for any tolerance */
static void judge_smoothness(double side, double y0, int kinks) {
  static const char *name[4] = {"FX", "FY", "FZ", "MZ"};
  double f[4][sweep], exact[4][sweep], of_all, of_tolerance;
  int i, j;
  pass_slowly(side, y0, usual_eps, f);
  pass_slowly(side, y0, 1e-9, exact);
  printf("DX = %.1f, y = %.2f, noise over FZ, and of what the tolerance adds:", side, y0);
  for (j = 0; j < 4; j++) {
    of_all = noise(f[j]) / load;
    for (i = 0; i < sweep; i++) f[j][i] -= exact[j][i];
    of_tolerance = noise(f[j]) / load;
    printf(" %s %.1e %.1e", name[j], of_all, of_tolerance);
    check(of_tolerance <= 1e-6, "noise relative to FZ due to the tolerance", of_tolerance);
    if (!kinks) check(of_all <= 1e-6, "noise relative to FZ", of_all);
  }
  printf("\n");
}

/* The same run with the derivatives of the forces: their time compared with that of the calls, some of which are at a discontinuity */
static void differentiate(double side, int steps) {
  double *time = malloc(sizeof(double) * (size_t)(2 * wheels * steps)), force[6], from, sum[2] = {0.0, 0.0};
  double values[CONTACT_JACOBIAN_ROWS * CONTACT_JACOBIAN_COLUMNS];
  int k, wheel, n = wheels * steps, kinks = 0, i, state;
  if (time == NULL) exit(1);
  for (wheel = 0; wheel < wheels; wheel++) set_up(wheel + 1, wheel % 2, side, 2);
  for (k = 0; k < steps; k++)
    for (wheel = 0; wheel < wheels; wheel++) {
      from = seconds();
      check(step(wheel + 1, on_the_way(wheel, k), force) == 0, "a call fails at step", k);
      time[wheels * k + wheel] = 1e3 * (seconds() - from);
      from = seconds();
      state = contact_wheel_rail_jacobian(wheel + 1, values, (int)(sizeof values / sizeof values[0]), NULL, 0);
      time[n + wheels * k + wheel] = 1e3 * (seconds() - from);
      check(state == CONTACT_DERIVATIVE_EXACT || state == CONTACT_DERIVATIVE_ONE_SIDED, "there are no derivatives at step", k);
      kinks += state == CONTACT_DERIVATIVE_ONE_SIDED;
    }
  for (wheel = 1; wheel <= wheels; wheel++) cntc_finalize(&wheel);
  for (i = 0; i < 2; i++) {
    for (k = 0; k < n; k++) sum[i] += time[i * n + k];
    qsort(time + i * n, (size_t)n, sizeof(double), compare);
  }
  printf("| %.1f | %d | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %d |\n", side, n, sum[0] / n, time[n / 2], sum[1] / n,
         time[n + n / 2], time[n + 99 * n / 100], (sum[0] + sum[1]) / sum[0], kinks);
  free(time);
}

/* The loop with simplified theory; goal: 0.15 ms */
static void simplify(int steps) {
  const int theories[] = {3, 5}, methods[] = {0, 5, 6};
  int i, k;
  for (i = 0; i < 2; i++)
    for (k = 0; k < 3; k++) {
      theory = theories[i];
      pressures = methods[k];
      printf("M = %d, B = %d\n", theory, pressures);
      drive(1.0, steps, (const double[]){0.15, 0.0, 0.0});
    }
}

int main(int count, char **word) {
  static const double places[] = {-0.9, 0.0, 3.0, 4.6, 6.0};
  int version, error, steps = 500, judges = 0, derivatives = 0, simplified = 0, i;
  if (count < 2) return 2;
  folder = word[1];
  for (i = 2; i < count; i++) {
    if (strcmp(word[i], "--check") == 0) judges = 1;
    else if (strcmp(word[i], "--derivatives") == 0) derivatives = 1;
    else if (strcmp(word[i], "--simplified") == 0) simplified = 1;
    else if (strcmp(word[i], "--calls") == 0 && i + 1 < count) calls = fopen(word[++i], "w");
    else steps = atoi(word[i]);
  }
  if (steps < 1) return 2;
  cntc_initializefirst(&version, &error, &zero, " ", " ", "vehicle", (const int[]){1}, (const int[]){1}, (const int[]){7});
  cntc_setglobalflags((const int[]){2}, (const int[]){CNTC_if_idebug, CNTC_if_openmp}, (const int[]){0, 1});
  if (judges) {
    for (i = 0; i < (int)(sizeof kinds / sizeof kinds[0]); i++) judge_requests(&kinds[i]);
    judge_batch("carter2d.toml");
    judge_batch("single_wheel.toml");
    compare_with_fresh(0, 1.0, 0, 60, 2);
    compare_with_fresh(0, 1.0, 100, 24, 0);
    compare_with_fresh(0, 0.5, 150, 16, 2);
    judge_smoothness(1.0, 1.3, 0);
    judge_smoothness(0.5, 1.3, 0);
    judge_smoothness(0.5, 5.3, 0);
    for (i = 0; i < (int)(sizeof places / sizeof places[0]); i++) {
      judge_smoothness(1.0, places[i], 1);
      judge_smoothness(0.5, places[i], 1);
    }
    theory = 3;
    compare_with_fresh(0, 1.0, 0, 60, 2);
    pressures = 5;
    compare_with_fresh(0, 1.0, 0, 60, 2);
    pressures = 6;
    compare_with_fresh(0, 1.0, 0, 24, 2);
    /* the force is reached at two heights in step 63 */
    theory = 5;
    pressures = 0;
    compare_with_fresh(6, 1.0, 40, 24, 2);
    pressures = 5;
    compare_with_fresh(6, 1.0, 40, 24, 2);
    pressures = 6;
    compare_with_fresh(6, 1.0, 40, 24, 2);
  } else if (simplified) {
    simplify(steps);
  } else if (derivatives) {
    printf("| DX = DS, mm | calls | call: mean, ms | median | derivatives: mean | median | 99 %% | both/call | one-sided |\n"
           "|---|---|---|---|---|---|---|---|---|\n");
    differentiate(1.0, steps);
    differentiate(0.5, steps);
  } else {
    printf("| DX = DS, mm | calls | mean, ms | median | 90 %% | 99 %% | largest | goal: median | 99 %% | largest | requests to the heap: mean | 99 %% |\n"
           "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    drive(1.0, steps, (const double[]){0.6, 1.0, 3.0});
    drive(0.5, steps, (const double[]){2.5, 4.0, 0.0});
  }
  if (calls != NULL && fclose(calls) != 0) failures++;
  return failures > 0;
}
