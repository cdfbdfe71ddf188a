/* Folder, files and checks of all targets, see fuzz.h */
#define _GNU_SOURCE
#include "fuzz.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

double fuzz_slow = 2.0;
int fuzz_slow_count;

static char folder[128], start[PATH_MAX];
static pid_t owner;
/* Names of the files that are kept */
static char *kept[64];
static int kept_count;

_Noreturn void fuzz_fail(const char *format, ...)
{
  va_list arguments;
  fprintf(stderr, "FOUND by the target %s: ", fuzz_name);
  va_start(arguments, format);
  vfprintf(stderr, format, arguments);
  va_end(arguments);
  fputc('\n', stderr);
  abort();
}

void fuzz_tell(const char *format, ...)
{
  va_list arguments;
  if (!getenv("CONTACT_FUZZ_PRINT")) return;
  va_start(arguments, format);
  vfprintf(stderr, format, arguments);
  va_end(arguments);
  fputc('\n', stderr);
}

void fuzz_write(const char *name, const char *text, size_t length)
{
  FILE *file = fopen(name, "w");
  if (!file || fwrite(text, 1, length, file) != length || fclose(file) != 0) {
    fprintf(stderr, "%s%s%s cannot be written: %s\n", *name == '/' ? "" : folder, *name == '/' ? "" : "/", name, strerror(errno));
    _exit(70);
  }
}

static void remove_folder(void)
{
  char command[256];
  if (getpid() != owner || chdir("/") != 0) return;
  snprintf(command, sizeof command, "rm -rf '%s'", folder);
  if (system(command) != 0) fprintf(stderr, "%s cannot be removed\n", folder);
}

/* Copy a profile with an eighth of its points: all lines but those of numbers, and of these every eighth */
static void copy_profile(const char *from, const char *to)
{
  char line[1000];
  FILE *source = fopen(from, "r"), *copy;
  int points = 0;
  if (!source) {
    fprintf(stderr, "%s cannot be read: %s\n", from, strerror(errno));
    _exit(70);
  }
  copy = fopen(to, "w");
  while (copy && fgets(line, sizeof line, source)) {
    double y, z;
    if (sscanf(line, "%lf %lf", &y, &z) != 2 || points++ % 8 == 0) fputs(line, copy);
  }
  fclose(source);
  if (copy) fclose(copy);
}

void fuzz_enter(void)
{
  static const char *const names[] = {"60E1.prr", "S1002.prw", "groove.txt", "roller.txt", "flat/slice_11.prw", "flat/slice_12.prw",
    "flat/slice_13.prw", "flat/slice_14.prw"};
  static const char flat[] = "0 0.002173913043\n4\n0 0 0\n1\n-6 'flat/slice_11.prw'\n-3 'flat/slice_12.prw'\n"
    "0 'flat/slice_13.prw'\n3 'flat/slice_14.prw'\n";
  const char *source = getenv("CONTACT_SOURCE"), *place = getenv("CONTACT_FUZZ_PLACE");
  char from[PATH_MAX], to[64];
  if (!getcwd(start, sizeof start)) strcpy(start, "/tmp");
  if (!source) {
    fprintf(stderr, "CONTACT_SOURCE must name the top of the sources\n");
    exit(70);
  }
  if (!place) place = access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
  snprintf(folder, sizeof folder, "%s/contact-fuzz-XXXXXX", place);
  if (!mkdtemp(folder) || chdir(folder) != 0 || mkdir("profiles", 0700) != 0 || mkdir("profiles/flat", 0700) != 0) {
    fprintf(stderr, "%s: no folder for the files of a run: %s\n", folder, strerror(errno));
    exit(70);
  }
  owner = getpid();
  atexit(remove_folder);
  for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
    snprintf(from, sizeof from, "%s/examples/profiles/%s", source, names[k]);
    snprintf(to, sizeof to, "profiles/%s", names[k]);
    copy_profile(from, to);
  }
  fuzz_write("profiles/flat.slcw", flat, sizeof flat - 1);
}

/* Call what for each file of the folder */
static void each_file(void (*what)(const char *name))
{
  DIR *list = opendir(".");
  struct dirent *entry;
  while (list && (entry = readdir(list)))
    if (entry->d_name[0] != '.' || entry->d_name[strspn(entry->d_name, ".")]) what(entry->d_name);
  if (list) closedir(list);
}

static void keep(const char *name)
{
  if (kept_count < (int)(sizeof kept / sizeof kept[0])) kept[kept_count++] = strdup(name);
}

static void tidy(const char *name)
{
  for (int k = 0; k < kept_count; k++)
    if (strcmp(kept[k], name) == 0) return;
  if (unlink(name) != 0) rmdir(name);
}

void fuzz_keep(void) { each_file(keep); }
void fuzz_tidy(void) { each_file(tidy); }

static double processor_time(void)
{
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9*(double)now.tv_nsec;
}

/* Keep a slow text, which would not be recorded otherwise, as its result is correct */
static void keep_slow(const char *text, size_t length, double seconds)
{
  static char name[PATH_MAX + 100];
  const char *place = getenv("CONTACT_FUZZ_FOUND");
  uint32_t hash = 2166136261u;
  for (size_t k = 0; k < length; k++) hash = (hash ^ (unsigned char)text[k])*16777619u;
  snprintf(name, sizeof name, "%s/slow-%s-%08x", place ? place : start, fuzz_name, (unsigned)hash);
  fuzz_write(name, text, length);
  fprintf(stderr, "SLOW in the target %s: %.1f s of processor time; the text is in %s\n", fuzz_name, seconds, name);
  fuzz_slow_count++;
}

void fuzz_execute(const char *text, size_t length)
{
  static char copy[fuzz_longest + 1];
  double begin;
  if (length > fuzz_longest) length = fuzz_longest;
  memcpy(copy, text, length);
  copy[length] = '\0';
  begin = processor_time();
  fuzz_text(copy, length);
  begin = processor_time() - begin;
  if (begin > fuzz_slow) keep_slow(copy, length, begin);
  fuzz_tidy();
}

void fuzz_check_message(const char *message, const char *what)
{
  const unsigned char *c = (const unsigned char *)message;
  if (!*c) fuzz_fail("%s, without a message", what);
  for (; *c; c++)
    if (*c < 32 || *c == 127) fuzz_fail("%s with the control character %d in its message: %s", what, *c, message);
}

/* Is the word NaN or infinite? */
static int is_nonsense(const char *word, size_t length)
{
  static const char *const bad[] = {"nan", "inf", "infinity"};
  if (length > 1 && (*word == '-' || *word == '+')) word++, length--;
  for (int k = 0; k < 3; k++)
    if (length == strlen(bad[k]) && strncasecmp(word, bad[k], length) == 0) return 1;
  return length >= 5 && strspn(word, "*") >= length;
}

/* Is this a row of the picture of the contact area, in which stars mark adhesion? */
static int is_picture(const char *line)
{
  line += strspn(line, " ");
  if (!isdigit((unsigned char)*line)) return 0;
  line += strspn(line, "0123456789");
  line += strspn(line, " ");
  line += strspn(line, "*.|SPTabcdefghijklmnopqrstuvwxyz");
  return line[strspn(line, " \r\n")] == '\0';
}

void fuzz_check_report(const char *name)
{
  static char line[4096];
  FILE *file = fopen(name, "r");
  while (file && fgets(line, sizeof line, file)) {
    /* messages repeat text of the input */
    if (is_picture(line) || strpbrk(line, "'\"") || strstr(line, "ERROR") || strcasestr(line, "warning")) continue;
    for (const char *word = line; *word;) {
      size_t length = strcspn(word, " \t\r\n,;:=()[]{}");
      if (length && is_nonsense(word, length)) fuzz_fail("not a number in %s: %s", name, line);
      word += length + (word[length] != '\0');
    }
  }
  if (file) fclose(file);
}
