/* Processor time inside the solver of contact patches. The benchmark is linked with
   --wrap=__contact_patch_solve_MOD_solve_patch, so that every call passes here. */
#define _POSIX_C_SOURCE 199309L
#include <time.h>

static double inside;
static long calls;

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void __real___contact_patch_solve_MOD_solve_patch(void *problem, void *state, void *workspace, void *log, void *result,
                                                  void *error);
void __wrap___contact_patch_solve_MOD_solve_patch(void *problem, void *state, void *workspace, void *log, void *result,
                                                  void *error);

void __wrap___contact_patch_solve_MOD_solve_patch(void *problem, void *state, void *workspace, void *log, void *result,
                                                  void *error)
{
  double start = now();
  __real___contact_patch_solve_MOD_solve_patch(problem, state, workspace, log, result, error);
  inside += now() - start;
  calls++;
}

double bench_clock(void) { return now(); }
double bench_inside(void) { return inside; }
long bench_calls(void) { return calls; }
