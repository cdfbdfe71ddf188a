/* Initialisation of the program (src/cli/start.c) beside that of another object file, as of a sanitizer */
#include <stdio.h>
#include <stdlib.h>

void contact_guard_whole_process(void);

static int calls = 0, others = 0;

void contact_guard_whole_process(void) { calls++; }

static void of_another(int count, char **words, char **variables) {
  (void)count;
  (void)words;
  (void)variables;
  others++;
}
__attribute__((section(".preinit_array"), used)) static void (*const entry)(int, char **, char **) = of_another;

int main(void) {
  const int forgotten = getenv("GFORTRAN_UNBUFFERED_ALL") == NULL;
  printf("%d and %d calls, variables of libgfortran %s\n", calls, others, forgotten ? "forgotten" : "kept");
  return !(calls == 1 && others == 1 && forgotten);
}
