/* A target without libFuzzer: repeats its corpus, then texts of it with random changes by a fixed seed
 *
 *   fuzz_NAME ROUNDS SEED PATIENCE FILE...     files or folders; PATIENCE: seconds of processor time that one text may take
 *                                              (and twenty times as many by the clock, if it waits)
 *
 * A text that takes more than a tenth of that is kept, and the exit status is 1: times CONTACT_SLOWER, where that is set.
 *
 * The current text is written to the file fuzz_NAME.found in the working directory if it is a finding. */
#define _GNU_SOURCE
#include <dirent.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include "fuzz.h"

enum { max_texts = 20000 };
static struct { char *text; size_t length; } texts[max_texts];
static int count;

/* The current text, and the file of a finding */
static char at_hand[fuzz_longest + 1], found[PATH_MAX];
static size_t at_hand_length;

static int busy;

static void save_text(void)
{
  FILE *file = busy ? fopen(found, "w") : NULL;
  if (!file) return;
  fwrite(at_hand, 1, at_hand_length, file);
  fclose(file);
}

/* Neither the library nor its run-time library may end the process */
static void save_at_exit(void)
{
  save_text();
  if (busy) fprintf(stderr, "The target %s was ended by an exit; the text is in %s\n", fuzz_name, found);
}

static void save(int signal_number)
{
  save_text();
  fprintf(stderr, "The target %s ended by signal %d%s; the text is in %s\n", fuzz_name, signal_number,
    signal_number == SIGALRM || signal_number == SIGPROF ? ": too slow" : "", found);
  signal(signal_number, SIG_DFL);
  raise(signal_number);
}

static void add(const char *path)
{
  char *text = malloc(fuzz_longest);
  FILE *file = fopen(path, "r");
  if (!file || !text || count == max_texts) {
    fprintf(stderr, "%s cannot be read\n", path);
    exit(70);
  }
  texts[count].text = text;
  texts[count++].length = fread(text, 1, fuzz_longest, file);
  fclose(file);
}

/* A file, or all files of a folder in the order of their names */
static void add_all(const char *path)
{
  struct dirent **list;
  struct stat status;
  int n;
  if (stat(path, &status) != 0 || !S_ISDIR(status.st_mode)) {
    add(path);
    return;
  }
  n = scandir(path, &list, NULL, alphasort);
  for (int k = 0; k < n; k++) {
    char name[PATH_MAX];
    snprintf(name, sizeof name, "%s/%s", path, list[k]->d_name);
    if (list[k]->d_name[0] != '.') add(name);
    free(list[k]);
  }
  free(list);
}

static void execute(unsigned patience)
{
  struct itimerval used = {{0, 0}, {patience, 0}}, none = {{0, 0}, {0, 0}};
  busy = 1;
  setitimer(ITIMER_PROF, &used, NULL);
  alarm(20 * patience);
  fuzz_execute(at_hand, at_hand_length);
  alarm(0);
  setitimer(ITIMER_PROF, &none, NULL);
  busy = 0;
}

int main(int argc, char **argv)
{
  static const int signals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM, SIGPROF};
  long rounds;
  unsigned patience;
  uint64_t state;
  if (argc < 5) {
    fprintf(stderr, "usage: %s ROUNDS SEED PATIENCE FILE...\n", argv[0]);
    return 64;
  }
  rounds = atol(argv[1]);
  state = strtoull(argv[2], NULL, 10);
  patience = (unsigned)atoi(argv[3]);
  fuzz_slow = 0.1*patience*(getenv("CONTACT_SLOWER") ? atof(getenv("CONTACT_SLOWER")) : 1.0);
  for (int k = 4; k < argc; k++) add_all(argv[k]);
  if (!getcwd(found, sizeof found - 40) || count == 0) {
    fprintf(stderr, "no texts\n");
    return 70;
  }
  snprintf(found + strlen(found), 40, "/fuzz_%s.found", fuzz_name);
  for (size_t k = 0; k < sizeof signals / sizeof signals[0]; k++) signal(signals[k], save);
  atexit(save_at_exit);
  fuzz_enter();
  fuzz_begin();
  fuzz_keep();
  for (int k = 0; k < count; k++) {
    memcpy(at_hand, texts[k].text, texts[k].length);
    at_hand_length = texts[k].length;
    execute(patience);
  }
  for (long k = 0; k < rounds; k++) {
    size_t one = fuzz_random(&state, (size_t)count), other = fuzz_random(&state, (size_t)count);
    memcpy(at_hand, texts[one].text, texts[one].length);
    at_hand_length = fuzz_mutate(at_hand, texts[one].length, fuzz_longest, texts[other].text, texts[other].length, &state);
    execute(patience);
  }
  printf("%s: %d texts repeated, %ld changed (seed %s), %d slow\n", fuzz_name, count, rounds, argv[2], fuzz_slow_count);
  for (int k = 0; k < count; k++) free(texts[k].text);
  return fuzz_slow_count > 0;
}
