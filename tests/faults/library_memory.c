/* Requests for memory are refused while a host calls the library: an error code or correct results, never the end of the
 * host, and correct results again afterwards.
 *
 * usage: library_memory contact | pair | written | run | large | threads  SAMPLES | all  FOLDER_OF_EXAMPLES
 *
 * Preload contact_inject. Of all requests of a small scenario a sample (fixed seed), or each one, is refused: alone, and
 * with all that follow. In kind written the cases of the pair are written as an input file. Kind large refuses only those
 * of 1 MB and more, which no reserve serves. */
#define _GNU_SOURCE
#include <caddon_flags.h>
#include <contact.h>
#include <contact_addon.h>
#include <dlfcn.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "../capi/robust/pair.h"

enum { max_values = 4000, largest_message = 400, max_elements = 201*201 };

/* Result of a scenario: values, and the error that was reported to the caller */
struct outcome {
  int count, trouble, code;
  double values[max_values];
  char message[largest_message];
};

static void (*inject)(long, int, size_t);
static long (*counted)(void);
static const char *examples, *kind;
static struct outcome reference, seen;
static long place;
static int persistent, elements = 21;
/* Of two threads; not from the heap */
static double fields[2*3*max_elements];
static struct outcome of_thread[2];

static void crashed(int signal_number) {
  char text[200];
  inject(-1, 0, 0);
  const int n = snprintf(text, sizeof text, "FAILED %s: signal %d when request %ld was refused%s\n", kind, signal_number, place,
                         persistent ? " and all later ones" : "");
  if (write(1, text, (size_t)n) != n) _exit(4);
  _exit(3);
}

static int is_over;
static void ended(void) {
  if (!is_over) crashed(0);
}

static void hand_over(struct outcome *o, const double *values, int n) {
  for (int k = 0; k < n && o->count < max_values; k++) o->values[o->count++] = values[k];
}

/* Record the code of a call, and the message of the library */
static void look(struct outcome *o, int ire, int icp, int error) {
  char text[largest_message];
  const int code = contact_last_error(ire, icp, text, sizeof text);
  if (error == 0 && code == 0) return;
  if (!o->trouble) {
    o->code = error != 0 ? error : code;
    memcpy(o->message, text, sizeof text);
  }
  o->trouble = 1;
}

/* Module 3: settings of each group, calculation, results, stresses, sensitivities */
static void contact_problem(struct outcome *o, int ire) {
  const int icp = 1, module = 3, zero = 0, one = 1, two = 2, four = 4, six = 6, n = elements*elements, blocks = 9;
  const int flags[6] = {CNTC_if_units, CNTC_ic_tang, CNTC_ic_sens, CNTC_ic_norm, CNTC_ic_output, CNTC_ic_flow};
  const int is_large = elements > 100, digits[6] = {CNTC_un_cntc, 3, is_large ? 0 : 3, 1, 0, 0}, flag_count = 6, limits[4] = {999, 30, 30, 1}, side = elements;
  const double eps = 1e-6, material[4] = {0.28, 0.28, 82000, 82000}, friction[2] = {0.3, 0.3}, fn = 20000.0, spin = 4e-4, cksi = 1e-3;
  const double width = 0.6*21/side, half = -0.5*width*side, zero_real = 0.0, step = width, velocity = 30000.0, x[2] = {0.1, 0.4};
  const double grid[6] = {side, side, half, half, width, width}, quadratic[6] = {1.2e-3, 0.0, 1.4e-3, 0.0, 0.0, 0.0};
  double *field[3];
  double forces[4] = {0}, sens[4] = {0}, stress[2*2*2*4] = {0};
  const int columns[4] = {1, 4, 8, 9}, points = 8, length = 2;
  int version = 0, error = 0;

  for (int k = 0; k < 3; k++) field[k] = fields + ((size_t)3*(size_t)(ire - 1) + (size_t)k)*max_elements;
  cntc_initialize(&ire, &module, &version, &error, " ", &one);
  look(o, 0, 0, error);
  cntc_setflags(&ire, &icp, &flag_count, flags, digits);
  cntc_setmaterialparameters(&ire, &icp, &zero, &four, material);
  cntc_setfrictionmethod(&ire, &icp, &zero, &two, friction);
  cntc_setsolverflags(&ire, &icp, &zero, &four, limits, &one, &eps);
  cntc_setreferencevelocity(&ire, &icp, &velocity);
  cntc_setrollingstepsize(&ire, &icp, &zero_real, &step);
  cntc_setpotcontact(&ire, &icp, &one, &six, grid);
  cntc_setundeformeddistc(&ire, &icp, &one, &six, quadratic);
  cntc_setnormalforce(&ire, &icp, &fn);
  cntc_setcreepages(&ire, &icp, &cksi, &zero_real, &spin);
  subs_addblock(&ire, &icp, &one, &blocks, &two, &two, &two, x, x, x);
  for (int k = 0; k < 2; k++) {
    cntc_calculate(&ire, &icp, &error);
    look(o, ire, icp, error);
  }
  cntc_getcontactforces(&ire, &icp, forces, forces + 1, forces + 2, forces + 3);
  hand_over(o, forces, 4);
  cntc_gettractions(&ire, &icp, &n, field[0], field[1], field[2]);
  hand_over(o, field[0], n < 441 ? n : 441);
  cntc_getdisplacements(&ire, &icp, &n, field[0], field[1], field[2]);
  hand_over(o, field[2], n < 441 ? n : 441);
  cntc_getmicroslip(&ire, &icp, &n, field[0], field[1]);
  hand_over(o, field[0], n < 441 ? n : 441);
  cntc_getsensitivities(&ire, &icp, &length, &length, sens);
  hand_over(o, sens, 4);
  look(o, ire, icp, 0);
  subs_calculate(&ire, &icp, &error);
  look(o, ire, icp, error);
  subs_getresults(&ire, &icp, &one, &points, &four, columns, stress);
  hand_over(o, stress, 32);
  look(o, ire, icp, 0);
  look(o, 0, 0, 0);
  cntc_finalize(&ire);
}

static void contact(struct outcome *o) { contact_problem(o, 1); }

/* Module 1: profiles from files, two positions */
static void pair(struct outcome *o) {
  const int ire = 1, whole = -1, module = 1, one = 1, six = 6, count = 24, eight = 8;
  double position[6] = {0.0, 1.0, 0.0, 0.0, 0.0024, 0.0}, totals[24] = {0}, location[8] = {0};
  char profiles[900];
  int version = 0, error = 0;

  cntc_initialize(&ire, &module, &version, &error, " ", &one);
  look(o, 0, 0, error);
  snprintf(profiles, sizeof profiles, "%s/profiles", examples);
  set_up_pair(ire, profiles, 1.0);
  const int write_input = CNTC_if_wrtinp, is_written = strcmp(kind, "written") == 0;
  cntc_setflags(&ire, &whole, &one, &write_input, &is_written);
  for (int k = 0; k < 2; k++) {
    position[1] = 1.0 - 0.8*k;
    cntc_setwheelsetposition(&ire, &one, &six, position);
    cntc_calculate(&ire, &whole, &error);
    look(o, ire, whole, error);
    cntc_getglobalforces(&ire, &whole, &count, totals);
    hand_over(o, totals, 24);
    cntc_getcontactlocation(&ire, &one, &eight, location);
    hand_over(o, location, 8);
    look(o, ire, whole, 0);
  }
  look(o, 0, 0, 0);
  cntc_finalize(&ire);
}

/* A whole experiment with all its files */
static void run(struct outcome *o) {
  char name[1000];
  snprintf(name, sizeof name, "%s/cattaneo.inp", examples);
  const int status = contact_run_with(name, CONTACT_RUN, ".", 1, CONTACT_WRITE_JSON | CONTACT_WRITE_HDF5 | CONTACT_WRITE_VTK,
                                      o->message, sizeof o->message);
  if (status == 0) return;
  o->trouble = 1;
  o->code = status;
}

static void *work(void *data) {
  const int k = data == &of_thread[1];
  contact_problem(data, k + 1);
  return NULL;
}

static int is_right(const struct outcome *o) {
  return o->count == reference.count && memcmp(o->values, reference.values, sizeof *o->values*(size_t)o->count) == 0;
}

/* Two other threads computing on other elements at the same time also get an error or correct results */
static void play(struct outcome *o) {
  memset(o, 0, sizeof *o);
  if (strcmp(kind, "pair") == 0 || strcmp(kind, "written") == 0) pair(o);
  else if (strcmp(kind, "run") == 0) run(o);
  else if (strcmp(kind, "threads") == 0) {
    pthread_t thread[2];
    memset(of_thread, 0, sizeof of_thread);
    for (int k = 0; k < 2; k++)
      if (pthread_create(&thread[k], NULL, work, &of_thread[k]) != 0) thread[k] = 0, of_thread[k].trouble = 1, of_thread[k].code = 1;
    for (int k = 0; k < 2; k++)
      if (thread[k] != 0) pthread_join(thread[k], NULL);
    /* a thread with an error, or with wrong results, is counted */
    int one = 0;
    for (int k = 1; k >= 0; k--)
      if (of_thread[k].trouble) one = k;
    if (!of_thread[0].trouble && !of_thread[1].trouble && reference.count > 0 && is_right(&of_thread[0])) one = 1;
    *o = of_thread[one];
  } else contact(o);
}

static long resident(void) {
  long total = 0, pages = 0;
  FILE *file = fopen("/proc/self/statm", "r");
  if (file == NULL || fscanf(file, "%ld %ld", &total, &pages) != 2) pages = 0;
  if (file != NULL) fclose(file);
  return pages*(sysconf(_SC_PAGESIZE)/1024);
}

int main(int argc, char **argv) {
  long right = 0, errors = 0, failures = 0, step = 1, before = 0;
  if (argc != 4) return 2;
  kind = argv[1];
  examples = argv[3];
  inject = (void (*)(long, int, size_t))dlsym(RTLD_DEFAULT, "inject_memory");
  counted = (long (*)(void))dlsym(RTLD_DEFAULT, "inject_counted");
  if (inject == NULL || counted == NULL) {
    printf("contact_inject is not preloaded\n");
    return 2;
  }
  const size_t smallest = strcmp(kind, "large") == 0 ? 1 << 20 : 0;
  if (smallest > 0) elements = 201;
  atexit(ended);
  for (int k = 0; k < 32; k++)
    if (k == SIGSEGV || k == SIGABRT || k == SIGBUS || k == SIGFPE || k == SIGILL || k == SIGALRM) signal(k, crashed);

  play(&reference);
  play(&reference);
  if (reference.trouble) {
    printf("FAILED %s without any fault: %d %s\n", kind, reference.code, reference.message);
    is_over = 1;
    return 1;
  }
  inject(0, 0, smallest);
  play(&seen);
  const long requests = counted();
  inject(-1, 0, 0);
  if (!is_right(&seen) || requests < 3) {
    printf("FAILED %s: two runs differ, or %ld requests are too few\n", kind, requests);
    failures++;
  }
  if (strcmp(argv[2], "all") != 0) step = requests/atol(argv[2]);
  if (step < 1) step = 1;
  unsigned seed = 20261122;
  for (long first = 1; first <= requests; first += step) {
    place = first + (step > 1 ? rand_r(&seed)%step : 0);
    if (place > requests) break;
    for (persistent = 0; persistent < 2; persistent++) {
      alarm(120);
      inject(place, persistent, smallest);
      play(&seen);
      inject(-1, 0, 0);
      const char *how = persistent ? " and all later ones" : "";
      if (seen.trouble) {
        errors++;
        if (seen.message[0] == 0 && seen.code == 0) {
          printf("FAILED %s: request %ld%s refused: neither code nor message\n", kind, place, how);
          failures++;
        }
      } else if (is_right(&seen)) {
        right++;
      } else {
        printf("FAILED %s: request %ld%s refused: wrong results without an error\n", kind, place, how);
        failures++;
      }
      play(&seen);
      if (seen.trouble || !is_right(&seen)) {
        printf("FAILED %s: after request %ld%s was refused: %d %s\n", kind, place, how, seen.code, seen.message);
        failures++;
      }
    }
    if (before == 0) before = resident();
  }
  alarm(0);
  cntc_finalizelast();
  is_over = 1;
  printf("%s: %ld requests, %ld refusals: %ld correct results, %ld errors, %ld failures; %ld kB more\n", kind, requests,
         right + errors, right, errors, failures, resident() - before);
  return failures != 0;
}
