/* Initialisation of the program before that of its libraries */
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
/* Runs before the run-time library of Fortran reads its environment variables: some of them end the program at its start
 * (GFORTRAN_STDERR_UNIT=6), others change the format of all numbers (GFORTRAN_OPTIONAL_PLUS). */
static void forget_variables(int count, char **words, char **variables) {
  static const char prefix[] = "GFORTRAN_";
  char **kept = variables;
  (void)count;
  (void)words;
  for (; *variables != NULL; variables++)
    if (strncmp(*variables, prefix, sizeof prefix - 1) != 0) *kept++ = *variables;
  *kept = NULL;
}
__attribute__((section(".preinit_array"), used)) static void (*const before_all)(int, char **, char **) = forget_variables;
#endif
