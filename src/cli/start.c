/* What the program does before its libraries are initialised */
#include <stddef.h>
#include <string.h>

/* From here on, refused requests for memory are looked after in all libraries */
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
/* Runs before the run-time library of Fortran looks at its variables: some of them end the program before it has begun
 * (GFORTRAN_STDERR_UNIT=6), others change every number that is written (GFORTRAN_OPTIONAL_PLUS). */
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
