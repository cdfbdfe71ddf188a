/* A library to preload: the n-th call of one kind fails. Calls that touch a file below a folder fail as on a bad or full
 * disk, requests for memory as when there is none.
 *
 * INJECT_CALL     write | close | rename | memory: which calls are counted; pwrite and writev count as write, and malloc,
 *                 calloc, realloc and their relatives that align as memory
 * INJECT_AT       number of the call that fails; 0 for none
 * INJECT_ERROR    number of the error (errno)
 * INJECT_FOLDER   files below this folder are meant
 * INJECT_FOR_EVER if set, all later calls fail too
 * INJECT_COUNT    name of a file that receives the number of calls at the end
 * INJECT_SIZE     requests for less memory are not counted [bytes]
 *
 * A program that is linked with it, or finds inject_memory by dlsym, sets the counting of memory itself:
 * inject_memory(n, for_ever, size) begins to count, inject_counted() tells how many were counted.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

static long calls, failing;
static int error, for_ever;
static const char *kind, *folder, *count_file;

void inject_memory(long at, int all_later, size_t size);
long inject_counted(void);

__attribute__((constructor)) static void begin(void) {
  const char *at = getenv("INJECT_AT"), *number = getenv("INJECT_ERROR");
  kind = getenv("INJECT_CALL");
  folder = getenv("INJECT_FOLDER");
  count_file = getenv("INJECT_COUNT");
  failing = at ? atol(at) : 0;
  error = number ? atoi(number) : EIO;
  for_ever = getenv("INJECT_FOR_EVER") != NULL;
  if (kind != NULL && strcmp(kind, "memory") == 0) {
    const char *size = getenv("INJECT_SIZE");
    inject_memory(failing, for_ever, size ? (size_t)atol(size) : 0);
  }
}

/* Is this the call that fails? */
static int fails(const char *what, int file, const char *path) {
  char name[4096], link[64];
  if (kind == NULL || folder == NULL || strcmp(kind, what) != 0) return 0;
  if (path == NULL) {
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t length = readlink(link, name, sizeof name - 1);
    if (length < 0) return 0;
    name[length] = 0;
    path = name;
  }
  if (strncmp(path, folder, strlen(folder)) != 0) return 0;
  const long number = __atomic_add_fetch(&calls, 1, __ATOMIC_RELAXED);
  if (failing == 0 || number < failing || (number > failing && !for_ever)) return 0;
  errno = error;
  return 1;
}

/* ---- memory ---- */

extern void *__libc_malloc(size_t), *__libc_calloc(size_t, size_t), *__libc_realloc(void *, size_t);
extern void *__libc_memalign(size_t, size_t);

static int counting, memory_for_ever;
static long memory_calls, memory_failing;
static size_t smallest;

void inject_memory(long at, int all_later, size_t size) {
  counting = 0;
  memory_calls = 0;
  memory_failing = at;
  memory_for_ever = all_later;
  smallest = size;
  counting = at >= 0;
}

long inject_counted(void) { return memory_calls; }

/* Is this the request that is refused? */
static int refused(size_t size) {
  if (!counting || size < smallest) return 0;
  const long number = __atomic_add_fetch(&memory_calls, 1, __ATOMIC_RELAXED);
  if (memory_failing == 0 || number < memory_failing || (number > memory_failing && !memory_for_ever)) return 0;
  errno = ENOMEM;
  return 1;
}

void *malloc(size_t size) { return refused(size) ? NULL : __libc_malloc(size); }
void *calloc(size_t count, size_t size) { return refused(count*size) ? NULL : __libc_calloc(count, size); }
void *realloc(void *block, size_t size) { return refused(size) ? NULL : __libc_realloc(block, size); }
void *memalign(size_t align, size_t size) { return refused(size) ? NULL : __libc_memalign(align, size); }
void *aligned_alloc(size_t align, size_t size) { return refused(size) ? NULL : __libc_memalign(align, size); }

int posix_memalign(void **block, size_t align, size_t size) {
  void *found = refused(size) ? NULL : __libc_memalign(align, size);
  if (found == NULL) return ENOMEM;
  *block = found;
  return 0;
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

ssize_t write(int file, const void *data, size_t size) {
  return fails("write", file, NULL) ? -1 : REAL(write)(file, data, size);
}

ssize_t pwrite(int file, const void *data, size_t size, off_t place) {
  return fails("write", file, NULL) ? -1 : REAL(pwrite)(file, data, size, place);
}

ssize_t pwrite64(int file, const void *data, size_t size, off64_t place) {
  return fails("write", file, NULL) ? -1 : REAL(pwrite64)(file, data, size, place);
}

ssize_t writev(int file, const struct iovec *parts, int count) {
  return fails("write", file, NULL) ? -1 : REAL(writev)(file, parts, count);
}

int close(int file) {
  const int fail = fails("close", file, NULL);
  const int status = REAL(close)(file);
  if (fail) errno = error;
  return fail ? -1 : status;
}

int rename(const char *old, const char *new) { return fails("rename", -1, new) ? -1 : REAL(rename)(old, new); }

__attribute__((destructor)) static void end(void) {
  const char *name = count_file;
  if (name == NULL) return;
  count_file = NULL;
  if (counting) calls = memory_calls;
  counting = 0;
  FILE *file = fopen(name, "w");
  if (file == NULL) return;
  fprintf(file, "%ld\n", calls);
  fclose(file);
}
