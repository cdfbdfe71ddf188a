/* Unusual hosts: each must get the forces of a usual one or an error code, and continue.
 *
 * usage: host PROFILES_FOLDER traps | stack | folder | de_DE | tr_TR | fork | memory | grids */
#define _GNU_SOURCE
#include <contact.h>
#include <contact_addon.h>
#include <fenv.h>
#include <locale.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#define INT(value) (&(const int){value})
#define REAL(value) (&(const double){value})
#define INTS(...) ((const int[]){__VA_ARGS__})
#define REALS(...) ((const double[]){__VA_ARGS__})

static int failed = 0, checks = 0;
static const char *profiles;

static void check(int good, const char *what) {
  checks++;
  if (good) return;
  failed++;
  printf("FAILED %s\n", what);
}

static int start(int ire, int module) {
  int version = 0, error = 7;
  cntc_initialize(&ire, &module, &version, &error, " ", INT(1));
  return error;
}

static int calculate(int ire, int icp) {
  int error = 99;
  cntc_calculate(&ire, &icp, &error);
  return error;
}

/* Rolling contact of an ellipse with friction that decreases with slip, on n x n elements */
static int basic(int ire, int n, double *force) {
  const double creepages[] = {1e-3, 0.0, 4e-4};
  if (start(ire, 3) != 0) return 98;
  cntc_setflags(&ire, INT(1), INT(3), INTS(1984, 1985, 1987), INTS(0, 0, 0));
  cntc_setmaterialparameters(&ire, INT(1), INT(0), INT(4), REALS(0.28, 0.28, 82000, 82000));
  cntc_setfrictionmethod(&ire, INT(1), INT(2), INT(7), REALS(0.3, 0.1, 1000, 0.0, 1.0, 0.001, 10));
  cntc_sethertzcontact(&ire, INT(1), INT(-3), INT(5), REALS(n, n, 4.25, 7.0, 1.2));
  cntc_setpenetration(&ire, INT(1), REAL(0.05));
  cntc_setreferencevelocity(&ire, INT(1), REAL(24000));
  cntc_setcreepages(&ire, INT(1), creepages, creepages + 1, creepages + 2);
  cntc_settemperaturedata(&ire, INT(1), INT(3), INT(9), REALS(20, 450, 0.05, 7.85e-6, 20, 450, 0.05, 7.85e-6, 1));
  const int code = calculate(ire, 1);
  subs_addblock(&ire, INT(1), INT(1), INT(9), INT(2), INT(1), INT(3), REALS(0, 1), REALS(0), REALS(0, 1, 2));
  int error = 99;
  subs_calculate(&ire, INT(1), &error);
  cntc_getcontactforces(&ire, INT(1), force, force + 1, force + 2, force + 3);
  return code != 0 ? code : error;
}

/* A wheel on a rail with a force */
static int wheel(int ire, double *force) {
  const char *const names[] = {"60E1.prr", "S1002.prw"};
  if (start(ire, 1) != 0) return 98;
  cntc_setflags(&ire, INT(-1), INT(2), INTS(1984, 1985), INTS(0, 0));
  cntc_setmaterialparameters(&ire, INT(-1), INT(0), INT(4), REALS(0.28, 0.28, 82000, 82000));
  cntc_setfrictionmethod(&ire, INT(-1), INT(0), INT(2), REALS(0.3, 0.3));
  cntc_setpotcontact(&ire, INT(-1), INT(-1), INT(5), REALS(0.4, 0.4, 1.57, 8, 4));
  cntc_settrackdimensions(&ire, INT(3), INT(11), REALS(14, 0, 1435, 0.025, 0, 0, 0, 0, 0, 0, 0));
  cntc_setwheelsetdimensions(&ire, INT(3), INT(3), REALS(1360, -70, 460));
  for (int k = 0; k < 2; k++) {
    char file[500];
    snprintf(file, sizeof file, "%s/%s", profiles, names[k]);
    cntc_setprofileinputfname(&ire, file, INT((int)strlen(file)), INT(1), INTS(k), INT(0), NULL);
  }
  cntc_setwheelsetposition(&ire, INT(1), INT(6), REALS(0, 5.0, 0, 0, 0.005, 0));
  cntc_setwheelsetvelocity(&ire, INT(2), INT(6), REALS(20000, 0, 0, 0, 0, -43.5));
  cntc_setverticalforce(&ire, REAL(60000));
  const int code = calculate(ire, -1);
  double all[24];
  cntc_getglobalforces(&ire, INT(-1), INT(24), all);
  memcpy(force, all, 4 * sizeof(double));
  return code;
}

/* Both kinds, forces of a usual host first */
static double quiet[8], now[8];

static void compare(const char *what) {
  char text[200];
  memset(now, 0, sizeof now);
  int code = basic(11, 33, now);
  snprintf(text, sizeof text, "%s: basic contact ends with %d, %g instead of %g", what, code, now[1], quiet[1]);
  check(code == 0 && memcmp(now, quiet, 4 * sizeof(double)) == 0, text);
  code = wheel(12, now + 4);
  snprintf(text, sizeof text, "%s: wheel on rail ends with %d, %g instead of %g", what, code, now[5], quiet[5]);
  check(code == 0 && memcmp(now + 4, quiet + 4, 4 * sizeof(double)) == 0, text);
  cntc_finalize(INT(11));
  cntc_finalize(INT(12));
}

/* The host traps invalid operations, and must find its own settings restored */
static void traps(void) {
  feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
  compare("traps of floating point exceptions");
  check(fegetexcept() == (FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW), "the traps of the host are as they were");
  start(13, 3);
  for (int k = 0; k < 3; k++) {
    cntc_setpenetration(INT(13), INT(1), REAL(k == 0 ? NAN : k == 1 ? INFINITY : 1e300));
    cntc_sethertzcontact(INT(13), INT(1), INT(-1), INT(5), REALS(5, 5, 1e300, 1e-300, 1));
    calculate(13, 1);
  }
  cntc_setverticalforce(INT(12), REAL(1e300));
  calculate(12, -1);
  const double limits[] = {NAN, -NAN, INFINITY, -INFINITY, 1e300, -1e300, -1e-300, 1e12};
  for (int k = 0; k < 3*(int)(sizeof limits/sizeof limits[0]); k++) {
    double limit[3] = {0};
    limit[k % 3] = limits[k/3];
    check(contact_run_limited("no_such_experiment", CONTACT_RUN, NULL, 1, 0, 0, limit[0], limit[1], limit[2], NULL, 0) == 1,
          "an invalid limit is a wrong call");
  }
  check(fegetexcept() == (FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW), "the traps of the host are as they were");
  fedisableexcept(FE_ALL_EXCEPT);
}

static void *in_thread(void *what) {
  compare(what);
  return NULL;
}

/* Threads with small stacks */
static void stack(void) {
  const size_t sizes[] = {512 * 1024, 256 * 1024};
  for (int k = 0; k < 2; k++) {
    pthread_t thread;
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, sizes[k]);
    check(pthread_create(&thread, &attributes, in_thread, k == 0 ? "512 kB of stack" : "256 kB of stack") == 0, "a thread");
    pthread_join(thread, NULL);
    pthread_attr_destroy(&attributes);
  }
}

/* A current folder in which no user can create a file */
static void folder(void) {
  check(mkdir("gone", 0755) == 0 && chdir("gone") == 0 && rmdir("../gone") == 0, "a folder that is gone");
  cntc_finalizelast();
  compare("no folder for files");
  start(11, 3);
  double force[4];
  cntc_setflags(INT(11), INT(1), INT(2), INTS(2002, 1987), INTS(1, 1));
  check(basic(11, 9, force) == 0, "input and .mat files that cannot be written do not make the case fail");
}

/* A host with another locale: decimals with a comma, in Turkish also an i without an upper-case form of one byte. 0 if there is no
 * such language here. Python sets the language of letters (LC_CTYPE) by itself. */
static int language(const char *name) {
  char command[200], made[40];
  setenv("LOCPATH", ".", 1);
  snprintf(made, sizeof made, "%s.utf8", name);
  snprintf(command, sizeof command, "localedef -i %s -f UTF-8 ./%s > localedef.log 2>&1", name, made);
  if (system(command) == -1) return 0;
  if (setlocale(LC_ALL, made) == NULL || strtod("1,5", NULL) != 1.5) return 0;
  compare(name);
  char experiment[500], message[200];
  snprintf(experiment, sizeof experiment, "%s/../cattaneo", profiles);
  check(contact_run_with(experiment, CONTACT_RUN, ".", 1, CONTACT_WRITE_JSON | CONTACT_WRITE_HDF5 | CONTACT_WRITE_VTK, message,
                         sizeof message) == 0, message);
  start(11, 3);
  cntc_setflags(INT(11), INT(1), INT(3), INTS(1984, 2002, 1987), INTS(3, 1, 1));
  cntc_sethertzcontact(INT(11), INT(1), INT(-3), INT(5), REALS(9, 9, 4.25, 7.0, 1.2));
  cntc_setpenetration(INT(11), INT(1), REAL(0.05));
  check(calculate(11, 1) == 0, "a case with files");
  cntc_finalizelast();
  const char *const files[] = {"contact_addon.out", "contact_addon.inp", "caddon_re011_cp1.0001.mat"};
  for (int k = 0; k < 3; k++) {
    FILE *file = fopen(files[k], "r");
    check(file != NULL, files[k]);
    if (file == NULL) continue;
    int before = ' ', last = ' ', letter, wrong = 0, points = 0;
    while ((letter = getc(file)) != EOF) {
      if (letter >= '0' && letter <= '9' && before >= '0' && before <= '9') {
        wrong += last == ',';
        points += last == '.';
      }
      before = last;
      last = letter;
    }
    fclose(file);
    check(wrong == 0 && points > 0, files[k]);
  }
  return 1;
}

/* Processes forked from this one, while threads wait for work */
static void forked(void) {
  for (int k = 0; k < 2; k++) {
    cntc_setglobalflags(INT(1), INT(2003), INT(k == 0 ? 1 : -1));
    double force[4];
    basic(14, 150, force);
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
      alarm(100);
      failed = 0;
      compare("a child");
      basic(14, 150, now);
      check(memcmp(now, force, sizeof force) == 0, "the child has the forces of its parent");
      _exit(failed);
    }
    int status = -1;
    waitpid(child, &status, 0);
    check(WIFEXITED(status) && WEXITSTATUS(status) == 0, k == 0 ? "a child of one thread" : "a child of several threads");
    compare("the parent of a child");
  }
}

/* Grids and points that exceed any memory */
static void memory(void) {
  static const double sizes[] = {3000, 30000, 46341, 1e5, 1e9, 1e300};
  const struct rlimit limit = {(rlim_t)3 << 29, (rlim_t)3 << 29};
  static double list[500];
  double force[4];
  char text[300];
  int code;

  setrlimit(RLIMIT_AS, &limit);
  check(basic(15, 33, force) == 0, "a grid that fits");
  cntc_sethertzcontact(INT(15), INT(1), INT(-3), INT(5), REALS(1400, 1400, 4.25, 7.0, 1.2));
  code = calculate(15, 1);
  check(code == -99, "two million elements do not fit");
  check(contact_last_error(15, 1, text, sizeof text) == -99 && strstr(text, "MB of memory") != NULL, "the reason is reported");
  for (int k = 0; k < 6; k++) {
    cntc_sethertzcontact(INT(15), INT(1), INT(-3), INT(5), REALS(sizes[k], sizes[k], 4.25, 7.0, 1.2));
    check(contact_last_error(15, 1, text, sizeof text) == -99, "an ellipse with more elements than any");
    cntc_setpotcontact(INT(15), INT(1), INT(1), INT(6), REALS(sizes[k], sizes[k], -5, -5, 10 / sizes[k], 10 / sizes[k]));
    check(contact_last_error(15, 1, text, sizeof text) == -99, "a rectangle with more elements than any");
  }
  check(basic(15, 33, force) == 0, "the grid that fits, again");
  for (int k = 0; k < 500; k++) list[k] = k;
  for (int n = 200; n <= 500; n += 300) {
    subs_addblock(INT(15), INT(1), INT(1), INT(9), &n, &n, &n, list, list, list);
    subs_calculate(INT(15), INT(1), &code);
    check(code == -99, "points below the surface that do not fit");
  }
  compare("after grids that were too large");
}

/* Elements of many sizes, by two pairs in turn, half of them a single row: blocks of the pairs, of FFTW and of Fortran are
 * requested and freed. The host takes the address of free: in an executable at fixed addresses all pointers to free are then to
 * the table of calls of the host */
static void grids(void) {
  void (*volatile of_host)(void *) = free;
  double force[4], before[4][20], all[24];
  char text[100];

  check(of_host != NULL, "an address");
  for (int ire = 15; ire <= 16; ire++) check(wheel(ire, force) == 0, "the first size");
  for (int round = 0; round < 2; round++)
    for (int k = 0; k < 20; k++) {
      const int ire = 15 + k % 2;
      cntc_setpotcontact(&ire, INT(-1), INT(-1), INT(5), REALS(0.1 + 0.05 * k, k % 4 < 2 ? 0.5 : 30.0, 1.57, 8, 4));
      cntc_setwheelsetposition(&ire, INT(1), INT(6), REALS(0, 0.3 * k, 0, 0, 0.005, 0));
      const int code = calculate(ire, -1);
      snprintf(text, sizeof text, "elements %d, for the %d. time, end with %d", k, round + 1, code);
      check(code == 0, text);
      cntc_getglobalforces(&ire, INT(-1), INT(24), all);
      for (int i = 0; i < 3; i++) {
        if (round == 0) before[i][k] = all[i];
        else check(fabs(all[i] - before[i][k]) <= 2e-5 * 60000, text);
      }
    }
  compare("after many grids");
}

int main(int argc, char **argv) {
  if (argc != 3) return 2;
  profiles = argv[1];
  check(basic(11, 33, quiet) == 0, "basic contact");
  check(wheel(12, quiet + 4) == 0, "wheel on rail");
  check(fabs(quiet[6] - 60000) < 60, "the vertical force is reached");
  cntc_finalize(INT(11));
  cntc_finalize(INT(12));
  if (strcmp(argv[2], "traps") == 0) traps();
  else if (strcmp(argv[2], "stack") == 0) stack();
  else if (strcmp(argv[2], "folder") == 0) folder();
  else if (strcmp(argv[2], "de_DE") == 0 || strcmp(argv[2], "tr_TR") == 0) {
    if (!language(argv[2])) {
      printf("skipped: the locale %s cannot be made\n", argv[2]);
      return 77;
    }
  } else if (strcmp(argv[2], "fork") == 0) forked();
  else if (strcmp(argv[2], "memory") == 0) memory();
  else if (strcmp(argv[2], "grids") == 0) grids();
  else return 2;
  cntc_finalizelast();
  printf("%s: %d checks, %d failed\n", argv[2], checks, failed);
  return failed != 0;
}
