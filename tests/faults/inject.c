/* A library to preload: the n-th call of one kind fails. Calls that touch a file below a folder fail as on a bad or full
 * disk, requests for memory as when there is none; or the process ends there, as by kill -9.
 *
 * INJECT_CALL     write | close | rename | open | fsync | any | memory: which calls are counted; pwrite and writev count as write,
 *                 fopen as open, and malloc, calloc, realloc and their relatives that align as memory; any: all that touch files
 * INJECT_AT       number of the call that fails; 0 for none
 * INJECT_ERROR    number of the error (errno); -1: the process ends instead, a write after half of its bytes; -2: a write takes half
 *                 of its bytes and returns their number, which is not an error
 * INJECT_FOLDER   only files below this folder are affected
 * INJECT_FOR_EVER if set, all later calls fail too
 * INJECT_COUNT    name of a file that receives the number of calls at the end
 * INJECT_NO_OPENAT2   if set, the system does not have openat2, as before Linux 5.6
 * INJECT_SIZE     requests for less memory are not counted [bytes]
 *
 * A program that is linked with it, or finds inject_memory by dlsym, sets the counting of memory itself:
 * inject_memory(n, for_ever, size) begins to count, inject_counted() returns the count.
 *
 * Streams of the C library call their own write and close: fopen and fdopen for writing create streams that call those here.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

enum { end_of_process = -1, half_a_write = -2 };

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

/* Does the fault apply to this file or path? */
static int is_meant(int file, const char *path) {
  char name[4096], link[64];
  if (kind == NULL || folder == NULL) return 0;
  if (path == NULL) {
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t length = readlink(link, name, sizeof name - 1);
    if (length < 0) return 0;
    name[length] = 0;
    return strncmp(name, folder, strlen(folder)) == 0;
  }
  if (path[0] != '/') {
    char here[2048];
    if (getcwd(here, sizeof here) == NULL) return 0;
    char whole[sizeof here + 2050];
    snprintf(whole, sizeof whole, "%s/%.2047s", here, path);
    return strncmp(whole, folder, strlen(folder)) == 0;
  }
  return strncmp(path, folder, strlen(folder)) == 0;
}

/* Is this the call that fails? The process may end here */
static int fails(const char *what, int file, const char *path) {
  if (kind == NULL || (strcmp(kind, what) != 0 && strcmp(kind, "any") != 0) || !is_meant(file, path)) return 0;
  const long number = __atomic_add_fetch(&calls, 1, __ATOMIC_RELAXED);
  if (failing == 0 || number < failing || (number > failing && !for_ever)) return 0;
  if (error == end_of_process && strcmp(what, "write") != 0) _exit(137);
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

/* Is this the request to be refused? */
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

/* Number of bytes of the failing write that are written; -1: it fails */
static ssize_t part(size_t size) { return error == end_of_process || error == half_a_write ? (ssize_t)((size + 1) / 2) : -1; }

static ssize_t after_part(ssize_t done) {
  if (error == end_of_process) _exit(137);
  return done;
}

ssize_t write(int file, const void *data, size_t size) {
  if (!fails("write", file, NULL)) return REAL(write)(file, data, size);
  return part(size) < 0 ? -1 : after_part(REAL(write)(file, data, part(size)));
}

ssize_t pwrite(int file, const void *data, size_t size, off_t place) {
  if (!fails("write", file, NULL)) return REAL(pwrite)(file, data, size, place);
  return part(size) < 0 ? -1 : after_part(REAL(pwrite)(file, data, part(size), place));
}

ssize_t pwrite64(int file, const void *data, size_t size, off64_t place) {
  if (!fails("write", file, NULL)) return REAL(pwrite64)(file, data, size, place);
  return part(size) < 0 ? -1 : after_part(REAL(pwrite64)(file, data, part(size), place));
}

ssize_t writev(int file, const struct iovec *parts, int count) {
  if (!fails("write", file, NULL)) return REAL(writev)(file, parts, count);
  if (part(1) < 0) return -1;
  struct iovec first = {parts[0].iov_base, part(parts[0].iov_len)};
  return after_part(REAL(writev)(file, &first, 1));
}

int close(int file) {
  const int fail = fails("close", file, NULL);
  const int status = REAL(close)(file);
  if (fail) errno = error;
  return fail ? -1 : status;
}

int fsync(int file) { return fails("fsync", file, NULL) ? -1 : REAL(fsync)(file); }

int rename(const char *old, const char *new) { return fails("rename", -1, new) ? -1 : REAL(rename)(old, new); }

#define MODE_OF(flags) va_list list; va_start(list, flags); \
  const mode_t mode = (flags & O_CREAT) ? (mode_t)va_arg(list, int) : 0; va_end(list)

int open(const char *path, int flags, ...) {
  MODE_OF(flags);
  return fails("open", -1, path) ? -1 : REAL(open)(path, flags, mode);
}

int open64(const char *path, int flags, ...) {
  MODE_OF(flags);
  return fails("open", -1, path) ? -1 : REAL(open64)(path, flags, mode);
}

/* System calls without a C function */
long syscall(long number, ...) {
  long value[6];
  va_list list;
  va_start(list, number);
  for (int k = 0; k < 6; k++) value[k] = va_arg(list, long);
  va_end(list);
#ifdef SYS_openat2
  if (number == SYS_openat2 && getenv("INJECT_NO_OPENAT2") != NULL) {
    errno = ENOSYS;
    return -1;
  }
#endif
  return REAL(syscall)(number, value[0], value[1], value[2], value[3], value[4], value[5]);
}

/* Streams, which write by the calls above */
static int number_of(void *cookie) { return (int)(intptr_t)cookie - 1; }

static ssize_t stream_read(void *cookie, char *data, size_t size) { return read(number_of(cookie), data, size); }

static ssize_t stream_write(void *cookie, const char *data, size_t size) {
  size_t done = 0;
  while (done < size) {
    const ssize_t now = write(number_of(cookie), data + done, size - done);
    if (now < 0) return (ssize_t)done;
    done += (size_t)now;
  }
  return (ssize_t)done;
}

static int stream_seek(void *cookie, off64_t *place, int from) {
  const off64_t now = lseek64(number_of(cookie), *place, from);
  if (now < 0) return -1;
  *place = now;
  return 0;
}

static int stream_close(void *cookie) { return close(number_of(cookie)); }

static FILE *stream_of(int file, const char *mode) {
  const cookie_io_functions_t functions = {stream_read, stream_write, stream_seek, stream_close};
  return fopencookie((void *)(intptr_t)(file + 1), mode, functions);
}

static FILE *open_stream(const char *path, const char *mode, FILE *(*real)(const char *, const char *)) {
  if (strpbrk(mode, "wa+") == NULL || !is_meant(-1, path)) return real(path, mode);
  int flags = strchr(mode, '+') ? O_RDWR : O_WRONLY;
  if (mode[0] == 'w') flags |= O_CREAT | O_TRUNC;
  if (mode[0] == 'a') flags |= O_CREAT | O_APPEND;
  if (strchr(mode, 'e')) flags |= O_CLOEXEC;
  if (strchr(mode, 'x')) flags |= O_EXCL;
  const int file = open(path, flags, 0666);
  if (file < 0) return NULL;
  return stream_of(file, mode);
}

/* The files of results are opened by their descriptor */
FILE *fdopen(int file, const char *mode) {
  return strpbrk(mode, "wa+") != NULL && is_meant(file, NULL) ? stream_of(file, mode) : REAL(fdopen)(file, mode);
}

FILE *fopen(const char *path, const char *mode) { return open_stream(path, mode, REAL(fopen)); }

FILE *fopen64(const char *path, const char *mode) { return open_stream(path, mode, REAL(fopen64)); }

__attribute__((destructor)) static void end(void) {
  const char *name = count_file;
  if (name == NULL) return;
  kind = NULL;
  count_file = NULL;
  if (counting) calls = memory_calls;
  counting = 0;
  FILE *file = fopen(name, "w");
  if (file == NULL) return;
  fprintf(file, "%ld\n", calls);
  fclose(file);
}
