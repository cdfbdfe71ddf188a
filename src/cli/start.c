/* Initialisation of the program before that of its libraries
 *
 * Each function to be called is a variable of its own in the section of the linker: an array of two would be aligned to 16 bytes,
 * and a gap behind the entry of another object file, as sanitizers have one, would be called as a null pointer. */
#include <stddef.h>
#include <string.h>

/* Handle refused memory requests in all libraries from now on */
void contact_guard_whole_process(void);
#if defined(__linux__) && defined(__ELF__)
static void start(int count, char **words, char **environment) {
  (void)count;
  (void)words;
  (void)environment;
  contact_guard_whole_process();
}
__attribute__((section(".preinit_array"), used)) static void (*const first)(int, char **, char **) = start;
#else
__attribute__((constructor)) static void first(void) { contact_guard_whole_process(); }
#endif

#ifdef __ELF__
static int begins(const char *text, const char *with) { return strncmp(text, with, strlen(with)) == 0; }

/* Run before the run-time libraries read their environment variables. A list of variables cannot become longer here. */

/* libgfortran: some variables end the program at its start (GFORTRAN_STDERR_UNIT=6), others change the format of all numbers
 * (GFORTRAN_OPTIONAL_PLUS) */
static void forget_variables(int count, char **words, char **variables) {
  char **kept = variables;
  (void)count;
  (void)words;
  for (; *variables != NULL; variables++)
    if (!begins(*variables, "GFORTRAN_")) *kept++ = *variables;
  *kept = NULL;
}

/* libgomp: a thread that has done its part of a loop tests for some 4 ms whether the others are ready before it sleeps. Beside
 * other programs it burns its turn while the others wait for theirs, and two threads take up to twelve times as long as one. With
 * 1000 tests, some 20 microseconds, they do not, and are as quick as before on an idle machine. The choice of the user counts. The
 * place is that of a variable which shells set for themselves; without any, nothing changes. */
static void wait_briefly(int count, char **words, char **variables) {
  static char choice[] = "GOMP_SPINCOUNT=1000";
  static const char *const of_shells[] = {"_=", "OLDPWD=", "SHLVL="};
  char **place = NULL;
  (void)count;
  (void)words;
  for (; *variables != NULL; variables++) {
    if (begins(*variables, "GOMP_SPINCOUNT=") || begins(*variables, "OMP_WAIT_POLICY=")) return;
    for (size_t k = 0; k < sizeof of_shells/sizeof of_shells[0]; k++)
      if (begins(*variables, of_shells[k])) place = variables;
  }
  if (place != NULL) *place = choice;
}

__attribute__((section(".preinit_array"), used)) static void (*const second)(int, char **, char **) = forget_variables;
__attribute__((section(".preinit_array"), used)) static void (*const third)(int, char **, char **) = wait_briefly;
#endif
