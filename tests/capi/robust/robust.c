/* Robustness of calls: codes of wrong calls, many rounds without growth of memory, threads.
 *
 * usage: robust codes | rounds COUNT | threads | messages | pairs FOLDER_OF_PROFILES | turns | mixed FOLDER_OF_PROFILES COUNT */
#define _GNU_SOURCE
#include <caddon_flags.h>
#include <contact.h>
#include <contact_addon.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "pair.h"

/* Exported, but not in a header */
extern void cntc_calculate1(const int *ire, int *ierror);
extern void cntc_calculate3(const int *ire, const int *icp, int *ierror);

static int failed = 0, checks = 0;

static void check(int good, const char *what) {
  checks++;
  if (good) return;
  failed++;
  printf("FAILED %s\n", what);
}

static void same(int got, int expected, const char *what) {
  char text[200];
  snprintf(text, sizeof text, "%s: got %d, expected %d", what, got, expected);
  check(got == expected, text);
}

/* A result element of a module */
static int start(int ire, int module) {
  int version = 0, error = 7, length = 1;
  cntc_initialize(&ire, &module, &version, &error, " ", &length);
  return error;
}

/* Hertzian rolling contact on a grid of n x n elements, without output */
static void set_up(int ire, int icp, int n, double cksi) {
  int zero = 0, two = 2, four = 4, five = 5, hertz = -3, flags = 2, list[2] = {1984, 1985}, none[2] = {0, 0};
  int limits[4] = {999, 30, 30, 1}, one = 1;
  double eps = 1e-6, material[4] = {0.28, 0.28, 82000, 82000}, friction[2] = {0.3, 0.3}, pen = 0.05, spin = 4e-4, lateral = 0.0;
  double geometry[5] = {n, n, 4.25, 7.0, 21.0 / 17.0};
  cntc_setflags(&ire, &icp, &flags, list, none);
  cntc_setmaterialparameters(&ire, &icp, &zero, &four, material);
  cntc_setfrictionmethod(&ire, &icp, &zero, &two, friction);
  cntc_setsolverflags(&ire, &icp, &zero, &four, limits, &one, &eps);
  cntc_sethertzcontact(&ire, &icp, &hertz, &five, geometry);
  cntc_setpenetration(&ire, &icp, &pen);
  cntc_setcreepages(&ire, &icp, &cksi, &lateral, &spin);
}

static int calculate(int ire, int icp) {
  int error = 99;
  cntc_calculate(&ire, &icp, &error);
  return error;
}

static void forces(int ire, int icp, double *f) {
  cntc_getcontactforces(&ire, &icp, f, f + 1, f + 2, f + 3);
}

static int stresses(int ire, int icp) {
  int error = 99;
  subs_calculate(&ire, &icp, &error);
  return error;
}

static int exists(const char *file) { return access(file, F_OK) == 0; }

/* Codes of invalid calls */
static void codes(void) {
  char text[300];
  double pen = 0.1, f[4] = {-1, -2, -3, -4};
  int one = 1, flag = 2000, zero = 0, ire, icp, k;

  /* nothing was initialised: a flag of the library, then a problem that is created implicitly */
  remove("contact_addon.out");
  cntc_setglobalflags(&one, &flag, &zero);
  check(!exists("contact_addon.out"), "a flag alone does not start a run");
  cntc_setpenetration(&one, &one, &pen);
  check(exists("contact_addon.out"), "the first problem starts a run");

  same(start(2, 3), 0, "initialise");
  same(start(2, 3), 0, "initialise again");
  same(start(2, 1), 0, "initialise with another module");
  same(start(0, 3), -31, "element 0");
  same(start(1000, 3), -31, "element 1000");
  same(start(3, 2), -99, "module 2");
  same(start(4, 1), 0, "wheel and rail");

  same(stresses(0, 1), -101, "stresses of element 0");
  same(stresses(1000, 1), -101, "stresses of element 1000");
  same(calculate(2, 0), -104, "patch 0");
  same(calculate(2, 10), -104, "patch 10");
  same(calculate(2, -1), -104, "patch -1 of a contact problem");
  same(stresses(4, 3), -31, "patch 3 of no patches");
  same(calculate(4, 1), -106, "one patch of wheel and rail");
  same(calculate(4, -1), -32, "no profiles");
  ire = 4, icp = 1;
  cntc_calculate3(&ire, &icp, &k);
  same(k, -102, "a contact problem of wheel and rail");
  ire = 2;
  cntc_calculate1(&ire, &k);
  same(k, -103, "wheel and rail of a contact problem");
  same(stresses(2, 1), -99, "stresses before a calculation");
  forces(2, 1, f);
  check(f[0] == -1 && f[3] == -4, "forces before a calculation are left alone");
  same(calculate(2, 1), 0, "the default problem, one element without a border");

  /* the reason is reported */
  set_up(2, 1, 7, 1e-3);
  same(calculate(2, 1), 0, "a good case");
  check(contact_last_error(2, 1, text, sizeof text) == 0 && !*text, "no error after a good case");
  f[0] = NAN;
  ire = 2;
  cntc_setpenetration(&ire, &one, f);
  check(contact_last_error(2, 1, text, sizeof text) == -99 && strstr(text, "not a number"), "not a number is refused");
  check(contact_last_error(2, 1, text, sizeof text) == 0, "a reported error is cleared");
  check(contact_last_error(77, 1, text, 5) == 0 && !*text, "no such element");
  contact_last_error(0, 0, NULL, 0);

  /* at most a hundred elements, in any order */
  for (k = 10; k < 107; k++) same(start(k, 3), 0, "one element more");
  same(start(107, 3), -12, "element 101");
  ire = 10;
  cntc_finalize(&ire);
  same(start(107, 3), 0, "a freed element can be used again");
  cntc_finalizelast();

  /* freeing one element does not affect the others */
  start(1, 3), start(2, 3);
  set_up(1, 1, 7, 1e-3), set_up(2, 1, 7, 2e-3);
  calculate(1, 1), calculate(2, 1);
  forces(2, 1, f);
  pen = f[1];
  cntc_finalize(&one);
  start(3, 3), set_up(3, 1, 7, 5e-4), calculate(3, 1);
  forces(2, 1, f);
  check(f[1] == pen, "the second element has its results");
  same(calculate(2, 1), 0, "and is solved again");
  cntc_finalizelast();
}

/* Resident memory [kB] */
static long resident(void) {
  long total = 0, pages = 0;
  FILE *file = fopen("/proc/self/statm", "r");
  if (!file || fscanf(file, "%ld %ld", &total, &pages) != 2) pages = 0;
  if (file) fclose(file);
  return pages * (sysconf(_SC_PAGESIZE) / 1024);
}

/* Create, solve, read, free, many times: memory is constant after the first tenth */
static void rounds(int count) {
  int k, one = 1, free_points = 9;
  double f[4], x[1] = {0.0}, first = 0.0, growth;
  long before = 0, after;
  for (k = 0; k < count; k++) {
    start(1, 3);
    set_up(1, 1, 7, 1e-3);
    subs_addblock(&one, &one, &one, &free_points, &one, &one, &one, x, x, x);
    same(calculate(1, 1), 0, "round");
    if (k % 100 == 0) same(stresses(1, 1), 0, "stresses");
    forces(1, 1, f);
    if (k == 0) first = f[1];
    check(f[1] == first, "the same force in every round");
    cntc_finalize(&one);
    if (k == count / 10) before = resident();
  }
  after = resident();
  growth = (double)(after - before);
  printf("%d rounds, resident memory %ld kB, then %ld kB\n", count, before, after);
  check(count < 1000 || growth < 500, "memory grows");
}

enum { workers = 4, cases = 25, elements = 15 };
static double alone[workers][cases][4], together[workers][cases][4];

static void solve_all(int worker, double (*list)[4]) {
  int k;
  for (k = 0; k < cases; k++) {
    set_up(worker + 1, 1, elements, 1e-4 * (1 + k + cases * worker));
    if (calculate(worker + 1, 1) != 0) list[k][0] = NAN;
    forces(worker + 1, 1, list[k]);
  }
}

static void *work(void *number) {
  int worker = *(int *)number;
  solve_all(worker, together[worker]);
  return NULL;
}

static _Atomic int is_over;
static int code_of_long;

static void *long_case(void *unused) {
  (void)unused;
  code_of_long = calculate(9, 1);
  is_over = 1;
  return NULL;
}

/* Different problems at the same time give the same results as alone, bit by bit; one problem has one thread */
static void threads(void) {
  pthread_t thread[workers];
  int number[workers], k, most, refused = 0, others = 0, code, ire = 9, round;
  double f[4], once;

  for (k = 0; k < workers; k++) start(k + 1, 3);
  cntc_getmaxnumthreads(&most);
  check(most >= workers, "OMP_NUM_THREADS limits the number of simultaneous calculations");
  for (k = 0; k < workers; k++) solve_all(k, alone[k]);
  for (k = 0; k < workers; k++) cntc_finalize((number[k] = k + 1, &number[k]));
  for (k = 0; k < workers; k++) start(k + 1, 3);
  for (k = 0; k < workers; k++) {
    number[k] = k;
    pthread_create(&thread[k], NULL, work, &number[k]);
  }
  for (k = 0; k < workers; k++) pthread_join(thread[k], NULL);
  check(memcmp(alone, together, sizeof alone) == 0, "results of threads are those of one thread");

  start(9, 3);
  for (round = 0; round < 5 && !refused; round++) {
    set_up(9, 1, 99, 1e-3);
    is_over = 0;
    pthread_create(&thread[0], NULL, long_case, NULL);
    while (!is_over) {
      code = calculate(9, 1);
      if (code == 305) refused++;
      if (code != 305 && code != 0) others++;
      if (code == 305) cntc_finalize(&ire);
    }
    pthread_join(thread[0], NULL);
    if (code_of_long == 305) refused++;
    check(code_of_long == 0 || code_of_long == 305, "the other thread");
  }
  check(refused > 0, "a problem in use is refused with 305");
  same(others, 0, "other codes");
  start(9, 3), start(8, 3);
  set_up(9, 1, 99, 1e-3), set_up(8, 1, 99, 1e-3);
  same(calculate(9, 1), 0, "afterwards it is free");
  forces(9, 1, f);
  once = f[1];
  calculate(8, 1);
  forces(8, 1, f);
  check(f[1] == once, "and solves what another problem solves");
  cntc_finalizelast();
}

/* The same for wheels on rails: each worker has its lateral positions */
enum { places = 3, totals = 24 };
static double pairs_alone[workers][places][totals], pairs_together[workers][places][totals];
static const char *profiles;

static void roll_all(int worker, double (*list)[totals]) {
  const int ire = worker + 1, whole = -1, one = 1, six = 6, length = totals;
  double position[6] = {0.0, 0.0, 0.0, 0.0, 0.002, 0.0};
  start(ire, 1);
  set_up_pair(ire, profiles, 0.8);
  for (int k = 0; k < places; k++) {
    position[1] = 0.5 * worker - 0.7 * k;
    cntc_setwheelsetposition(&ire, &one, &six, position);
    list[k][0] = NAN;
    if (calculate(ire, -1) == 0) cntc_getglobalforces(&ire, &whole, &length, list[k]);
  }
}

static void *roll(void *number) {
  int worker = *(int *)number;
  roll_all(worker, pairs_together[worker]);
  return NULL;
}

static void pairs(void) {
  pthread_t thread[workers];
  int number[workers], k, i;
  for (k = 0; k < workers; k++) roll_all(k, pairs_alone[k]);
  for (k = 0; k < workers; k++)
    for (i = 0; i < places; i++) check(fabs(pairs_alone[k][i][2]) > 1000.0, "the wheel is on the rail");
  for (k = 0; k < workers; k++) cntc_finalize((number[k] = k + 1, &number[k]));
  for (k = 0; k < workers; k++) start(k + 1, 1);
  for (k = 0; k < workers; k++) {
    number[k] = k;
    pthread_create(&thread[k], NULL, roll, &number[k]);
  }
  for (k = 0; k < workers; k++) pthread_join(thread[k], NULL);
  check(memcmp(pairs_alone, pairs_together, sizeof pairs_alone) == 0, "threads roll as one thread does");
  cntc_finalizelast();
}

/* Messages to each worker: one line per wrong call, and per valid one in between */
enum { talkers = 8, tries = 400, text_length = 200 };
typedef char transcript[tries][text_length];
static transcript texts_alone[talkers], texts_together[talkers];

/* Code and text of the last error in a problem */
static void note(int ire, char *text_out) {
  char text[text_length - 12];
  int code = contact_last_error(ire, 1, text, sizeof text);
  snprintf(text_out, text_length, "%d %s", code, text);
}

/* Invalid calls among valid ones; their messages have other numbers and lengths for each worker and attempt */
static void report_all(int worker, transcript texts) {
  int ire = worker + 1, icp = 1, k, n;
  for (k = 0; k < tries; k++) {
    int one = 1, two = 2, flag[2], value[2], codes[1], limits[4] = {0, 0, 0, 0}, hertz = -3;
    int digits = (k + worker) % 9;
    double number = 0.1, list[6] = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0};
    for (n = 7; digits > 0; digits--) n = 10 * n + k % 10;
    switch (k % 8) {
      case 0: /* no such flag, and a valid one */
        flag[0] = 3000 + worker, value[0] = n, flag[1] = 1984, value[1] = 0;
        cntc_setflags(&ire, &icp, &two, flag, value);
        break;
      case 1: /* a value beyond its range */
        flag[0] = 1984, value[0] = -n;
        cntc_setflags(&ire, &icp, &one, flag, value);
        break;
      case 2:
        flag[0] = n;
        cntc_getflags(&ire, &icp, &one, flag, value);
        break;
      case 3:
        codes[0] = n;
        cntc_setmetadata(&ire, &icp, &one, codes, &number);
        break;
      case 4: /* a number of values that the method does not have */
        n = k % 3;
        cntc_sethertzcontact(&ire, &icp, &hertz, &n, list);
        break;
      case 5:
        number = NAN;
        cntc_setpenetration(&ire, &icp, &number);
        break;
      case 6: /* wrong order: no results yet */
        stresses(ire, icp);
        break;
      default: /* no message; another method without a solution */
        cntc_setpenetration(&ire, &icp, &number);
        n = 2 + k % 2;
        list[0] = -1.0 - k;
        cntc_setsolverflags(&ire, &icp, &n, &n, limits, &one, list);
    }
    note(ire, texts[k]);
  }
}

static void *report_together(void *number) {
  int worker = *(int *)number;
  report_all(worker, texts_together[worker]);
  return NULL;
}

/* Messages of many problems at the same time are those of each of them alone */
static void messages(void) {
  pthread_t thread[talkers];
  int number[talkers], k, i, round, reported = 0, other = 0;

  for (k = 0; k < talkers; k++) start(k + 1, 3);
  for (k = 0; k < talkers; k++) report_all(k, texts_alone[k]);
  for (k = 0; k < talkers; k++)
    for (i = 0; i < tries; i++) reported += strlen(texts_alone[k][i]) > 10;
  check(reported >= talkers * tries * 3 / 4, "wrong calls are reported");
  for (round = 0; round < 10; round++) {
    for (k = 0; k < talkers; k++) {
      number[k] = k;
      pthread_create(&thread[k], NULL, report_together, &number[k]);
    }
    for (k = 0; k < talkers; k++) pthread_join(thread[k], NULL);
    for (k = 0; k < talkers; k++)
      for (i = 0; i < tries; i++)
        if (strcmp(texts_alone[k][i], texts_together[k][i]) && other++ < 10)
          printf("alone:    %s\ntogether: %s\n", texts_alone[k][i], texts_together[k][i]);
  }
  same(other, 0, "messages that differ");
  cntc_finalizelast();
}

/* More callers than simultaneous calculations: each waits for a short time, and nothing is refused */
enum { callers = 6, rounds_of_caller = 30 };
static _Atomic int done_by[callers], in_line, first_end[callers], somebody_ended;
static double of_callers[callers][4];
static int code_of_caller[callers];

static void *queue(void *number) {
  const int caller = *(int *)number;
  int k, code;
  in_line++;
  while (in_line < callers) continue;
  for (k = 0; k < rounds_of_caller; k++) {
    code = calculate(caller + 1, 1);
    if (code != 0) code_of_caller[caller] = code;
    done_by[caller]++;
  }
  if (somebody_ended++ == 0)
    for (k = 0; k < callers; k++) first_end[k] = done_by[k];
  forces(caller + 1, 1, of_callers[caller]);
  return NULL;
}

static void turns(void) {
  pthread_t thread[callers];
  int number[callers], k, most, status = 7;
  double alone_force[4];

  for (k = 0; k < callers; k++) start(k + 1, 3), set_up(k + 1, 1, 45, 1e-3);
  start(99, 3), set_up(99, 1, 45, 1e-3);
  for (k = 0; k < rounds_of_caller; k++) calculate(99, 1);
  forces(99, 1, alone_force);
  cntc_getmaxnumthreads(&most);
  check(most < callers, "the test needs OMP_NUM_THREADS below the number of callers");
  for (k = 0; k < callers; k++) {
    number[k] = k;
    pthread_create(&thread[k], NULL, queue, &number[k]);
  }
  for (k = 0; k < callers; k++) pthread_join(thread[k], NULL);
  for (k = 0; k < callers; k++) {
    same(code_of_caller[k], 0, "a caller who waits gets results");
    check(memcmp(of_callers[k], alone_force, sizeof alone_force) == 0, "and the same as alone");
    /* the system may delay a thread as well, but not for long */
    check(first_end[k] >= 3, "each caller finishes");
  }
  /* a child process has no other threads */
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    _exit(calculate(99, 1));
  }
  waitpid(child, &status, 0);
  same(status, 0, "a forked process calculates");
  cntc_finalizelast();
}

/* Cases of both modules, different for each worker; their results as one number per case */
enum { mixed_workers = 8 };
static int mixed_cases;
static unsigned long long *mixed_alone, *mixed_together;

static unsigned long long digest(const double *values, int n) {
  const unsigned char *bytes = (const unsigned char *)values;
  unsigned long long sum = 1469598103934665603ull;
  for (size_t k = 0; k < (size_t)n * sizeof *values; k++) sum = (sum ^ bytes[k]) * 1099511628211ull;
  return sum;
}

/* Worker k has result elements 2k + 1 (module 3) and 2k + 2 (module 1) */
static void mix(int worker, unsigned long long *list) {
  int ire = 2 * worker + 1, pair = ire + 1, one = 1, whole = -1, length = totals, six = 6, k, code, n = 15 * 15;
  double values[4 + 3 * 15 * 15], position[6] = {0.0, 0.0, 0.0, 0.0, 0.002, 0.0}, rolled[places][totals];
  unsigned seed = (unsigned)worker + 1;
  roll_all(pair - 1, rolled);
  for (k = 0; k < mixed_cases; k++) {
    memset(values, 0, sizeof values);
    if (k % 8 == 7) {
      position[1] = 4.0 * rand_r(&seed) / RAND_MAX - 2.0;
      cntc_setwheelsetposition(&pair, &one, &six, position);
      code = calculate(pair, -1);
      cntc_getglobalforces(&pair, &whole, &length, values);
    } else {
      set_up(ire, 1, 7 + 2 * (k % 5), 1e-4 + 5e-3 * rand_r(&seed) / RAND_MAX);
      code = calculate(ire, 1);
      forces(ire, 1, values);
      cntc_gettractions(&ire, &one, &n, values + 4, values + 4 + n, values + 4 + 2 * n);
    }
    list[k] = code == 0 ? digest(values, 4 + 3 * n) : (unsigned long long)code;
  }
}

static void *mix_together(void *number) {
  const int worker = *(int *)number;
  mix(worker, mixed_together + (size_t)worker * (size_t)mixed_cases);
  return NULL;
}

static void mixed(void) {
  pthread_t thread[mixed_workers];
  int number[2 * mixed_workers], k, bad = 0;
  const int n = mixed_workers * mixed_cases;
  mixed_alone = calloc((size_t)n, sizeof *mixed_alone), mixed_together = calloc((size_t)n, sizeof *mixed_together);
  for (k = 0; k < 2 * mixed_workers; k++) number[k] = k + 1, start(k + 1, k % 2 ? 1 : 3);
  for (k = 0; k < mixed_workers; k++) mix(k, mixed_alone + (size_t)k * (size_t)mixed_cases);
  for (k = 0; k < 2 * mixed_workers; k++) cntc_finalize(&number[k]);
  for (k = 0; k < 2 * mixed_workers; k++) start(k + 1, k % 2 ? 1 : 3);
  for (k = 0; k < mixed_workers; k++) {
    number[k] = k;
    pthread_create(&thread[k], NULL, mix_together, &number[k]);
  }
  for (k = 0; k < mixed_workers; k++) pthread_join(thread[k], NULL);
  for (k = 0; k < n; k++) {
    bad += mixed_alone[k] != mixed_together[k];
    check(mixed_alone[k] > 1000, "each case has a result");
  }
  same(bad, 0, "cases that differ between eight threads and one");
  printf("%d threads, %d cases each\n", mixed_workers, mixed_cases);
  free(mixed_alone), free(mixed_together);
  cntc_finalizelast();
}

int main(int argc, char **argv) {
  const char *what = argc > 1 ? argv[1] : "";
  if (!strcmp(what, "codes")) codes();
  if (!strcmp(what, "rounds")) rounds(argc > 2 ? atoi(argv[2]) : 10000);
  if (!strcmp(what, "threads")) threads();
  if (!strcmp(what, "messages")) messages();
  profiles = argc > 2 ? argv[2] : ".";
  if (!strcmp(what, "pairs")) pairs();
  if (!strcmp(what, "turns")) turns();
  mixed_cases = argc > 3 ? atoi(argv[3]) : 200;
  if (!strcmp(what, "mixed")) mixed();
  printf("%d checks, %d failed\n", checks, failed);
  return failed || !checks;
}
