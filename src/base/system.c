/* System services that Fortran lacks: opening files of the expected kind only, locks, folders; see system.f90.
 *
 * A descriptor is 0 or more; failures are negative numbers, listed in system.f90 too. */
#define _GNU_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>
#ifdef __linux__
#include <linux/openat2.h>
#endif

enum { REFUSED = -1, OF_ANOTHER_KIND = -2, OUTSIDE = -3, HELD = -4, LINK = -5 };

int contact_open_input(const char *folder, const char *name, int confined, long long *length, int *cause);
long long contact_read(int file, char *buffer, long long length, int *cause);
int contact_stamp(const char *name, long long numbers[5], long long *age);
int contact_real_path(const char *name, char *path, int length);
int contact_open_output(const char *name, int confined, long keep, int *cause);
void contact_close(int file);
void contact_divert(int file);
void contact_explain(int cause, char *text, int length);
int contact_lock(const char *name, char *holder, int length, int *cause);
void contact_unlock(int file, const char *name);
void contact_clean(const char *folder, const char *start, int (*is_ours)(const char *rest, int length));

/* The next component of a path, or NULL at its end; `place` is moved past it */
static const char *part_of(const char **place, char *part, size_t size) {
  const char *from = *place + strspn(*place, "/");
  const size_t length = strcspn(from, "/");
  if (length == 0 || length >= size) return NULL;
  memcpy(part, from, length);
  part[length] = 0;
  *place = from + length;
  return part;
}

/* Does a path relative to a folder lead out of it, by its names alone? */
static int leads_out(const char *name) {
  char part[256];
  if (name[0] == '/') return 1;
  for (const char *place = name; part_of(&place, part, sizeof part) != NULL;)
    if (strcmp(part, "..") == 0) return 1;
  return 0;
}

/* Open a file below a folder without following symbolic links; one in the path gives errno ELOOP */
static int walk(int folder, const char *name, int flags) {
  char part[256];
  int at = dup(folder);
  const char *place = name;
  while (at >= 0 && part_of(&place, part, sizeof part) != NULL) {
    const int last = place[strspn(place, "/")] == 0;
    const int next = openat(at, part, (last ? flags : O_RDONLY | O_DIRECTORY | O_CLOEXEC) | O_NOFOLLOW);
    struct stat status;
    int cause = errno;
    /* a link in place of a folder is reported as "not a directory" */
    if (next < 0 && cause == ENOTDIR && fstatat(at, part, &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(status.st_mode))
      cause = ELOOP;
    close(at);
    errno = cause;
    if (last || next < 0) return next;
    at = next;
  }
  if (at >= 0) close(at);
  errno = ENOENT;
  return -1;
}

/* Open a file below a folder. Links may lead anywhere below it, but not outside. If the system cannot enforce this, no link is
 * followed and `by_parts` is set */
static int open_below(const char *folder, const char *name, int flags, int *by_parts) {
  const int at = open(folder[0] ? folder : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (at < 0) return -1;
  int file = -1;
  errno = ENOSYS;
#if defined(SYS_openat2) && defined(RESOLVE_BENEATH)
  struct open_how how = {.flags = (unsigned)flags, .resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS};
  file = (int)syscall(SYS_openat2, at, name, &how, sizeof how);
#endif
  /* an older kernel, or one that does not permit the call */
  *by_parts = file < 0 && (errno == ENOSYS || errno == EPERM);
  if (*by_parts) file = walk(at, name, flags);
  const int cause = errno;
  close(at);
  errno = cause;
  return file;
}

/* Open a regular file for reading. Other kinds are refused without waiting: a FIFO blocks, a device has no end.
 * `folder` and `name` together are the path; a confined file must be below the folder. */
int contact_open_input(const char *folder, const char *name, int confined, long long *length, int *cause) {
  const int flags = O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
  struct stat status;
  int by_parts = 0;
  *cause = 0;
  if (confined && leads_out(name)) return OUTSIDE;
  const int file = confined ? open_below(folder, name, flags, &by_parts) : open(name, flags);
  if (file < 0) {
    *cause = errno;
    if (by_parts && errno == ELOOP) return LINK;
    return confined && (errno == EXDEV || errno == ELOOP) ? OUTSIDE : errno == ENXIO ? OF_ANOTHER_KIND : REFUSED;
  }
  if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) {
    close(file);
    return OF_ANOTHER_KIND;
  }
  *length = (long long)status.st_size;
  return file;
}

/* Identity and time stamps of a file, which stay the same until it is written to, and the time since its last change [ns];
 * returns non-zero if it does not exist. The time of the status change can only be set by the system */
int contact_stamp(const char *name, long long numbers[5], long long *age) {
  struct stat status;
  struct timespec now;
  if (stat(name, &status) != 0 || clock_gettime(CLOCK_REALTIME, &now) != 0) return REFUSED;
  const long long second = 1000000000LL;
  numbers[0] = (long long)status.st_dev;
  numbers[1] = (long long)status.st_ino;
  numbers[2] = (long long)status.st_size;
  numbers[3] = (long long)status.st_mtim.tv_sec * second + status.st_mtim.tv_nsec;
  numbers[4] = (long long)status.st_ctim.tv_sec * second + status.st_ctim.tv_nsec;
  *age = (long long)now.tv_sec * second + now.tv_nsec - numbers[4];
  return 0;
}

/* Path of an existing file after all links; its length, 0 if there is none or it is longer than the buffer */
int contact_real_path(const char *name, char *path, int length) {
  char real[PATH_MAX];
  if (realpath(name, real) == NULL) return 0;
  const size_t size = strlen(real);
  if (size > (size_t)length) return 0;
  memcpy(path, real, size);
  return (int)size;
}

/* Read from a file until the buffer is full or the file ends; returns the number of bytes read, or -1 */
long long contact_read(int file, char *buffer, long long length, int *cause) {
  long long done = 0;
  while (done < length) {
    const ssize_t more = read(file, buffer + done, (size_t)(length - done));
    if (more == 0) break;
    if (more < 0 && errno == EINTR) continue;
    if (more < 0) {
      *cause = errno;
      return -1;
    }
    done += more;
  }
  return done;
}

/* Open a file for writing. Its content is lost, or with keep >= 0 all but the first `keep` bytes. Does not wait for a reader of
 * a FIFO. Confined: a regular file that is not a symbolic link. */
int contact_open_output(const char *name, int confined, long keep, int *cause) {
  struct stat status;
  const int access = keep < 0 ? O_WRONLY | O_CREAT : O_RDWR;
  const int flags = access | O_NONBLOCK | O_NOCTTY | O_CLOEXEC | (confined ? O_NOFOLLOW : 0);
  const int file = open(name, flags, 0666);
  *cause = errno;
  if (file < 0) return errno == ENXIO || (confined && errno == ELOOP) ? OF_ANOTHER_KIND : REFUSED;
  if (fstat(file, &status) != 0 || (confined && !S_ISREG(status.st_mode))) {
    close(file);
    return OF_ANOTHER_KIND;
  }
  if (S_ISREG(status.st_mode) && ftruncate(file, keep < 0 ? 0 : keep) != 0) {
    *cause = errno;
    close(file);
    return REFUSED;
  }
  fcntl(file, F_SETFL, fcntl(file, F_GETFL) & ~O_NONBLOCK);
  return file;
}

void contact_close(int file) { close(file); }

/* Replace an open file by an empty one in memory, which is released when it is closed; nothing on systems without such files */
void contact_divert(int file) {
#ifdef MFD_CLOEXEC
  const int memory = memfd_create("contact", MFD_CLOEXEC);
  if (memory < 0) return;
  dup3(memory, file, O_CLOEXEC);
  close(memory);
#else
  (void)file;
#endif
}

/* The system's text for an errno */
void contact_explain(int cause, char *text, int length) {
  char buffer[256];
#ifdef __GLIBC__
  const char *sentence = strerror_r(cause, buffer, sizeof buffer);
#else
  const char *sentence = strerror_r(cause, buffer, sizeof buffer) == 0 ? buffer : "unknown error";
#endif
  memset(text, ' ', (size_t)length);
  const size_t used = strlen(sentence);
  memcpy(text, sentence, used < (size_t)length ? used : (size_t)length);
}

/* Take the lock of an experiment: a file that the system keeps locked until it is closed or this process ends in any
 * way. A leftover file does not lock. Returns the holder if the lock is taken. */
int contact_lock(const char *name, char *holder, int length, int *cause) {
  char text[256] = "", host[128] = "", since[32] = "";
  memset(holder, ' ', (size_t)length);
  for (int trial = 0; trial < 100; trial++) {
    struct stat ours, there;
    const int flags = O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC;
    int file = open(name, O_RDWR | O_CREAT | flags, 0666);
    if (file < 0 && errno == EACCES) file = open(name, O_RDONLY | flags);
    *cause = errno;
    if (file < 0) return REFUSED;
    if (fstat(file, &ours) != 0 || !S_ISREG(ours.st_mode)) {
      close(file);
      return OF_ANOTHER_KIND;
    }
    if (flock(file, LOCK_EX | LOCK_NB) != 0) {
      *cause = errno;
      const ssize_t used = errno == EWOULDBLOCK ? pread(file, text, sizeof text - 1, 0) : 0;
      close(file);
      if (*cause != EWOULDBLOCK) return REFUSED;
      for (ssize_t k = 0; k < used && k < length; k++)
        if (text[k] >= ' ' && text[k] < 127) holder[k] = text[k];
      return HELD;
    }
    /* the previous holder may have deleted the file after we opened it */
    if (stat(name, &there) != 0 || there.st_ino != ours.st_ino || there.st_dev != ours.st_dev) {
      close(file);
      continue;
    }
    const time_t now = time(NULL);
    struct tm local;
    gethostname(host, sizeof host - 1);
    if (localtime_r(&now, &local) != NULL) strftime(since, sizeof since, "%Y-%m-%d %H:%M:%S", &local);
    const int used = snprintf(text, sizeof text, "process %ld on %s since %s\n", (long)getpid(), host, since);
    /* only informs others */
    if (ftruncate(file, 0) != 0 || pwrite(file, text, (size_t)used, 0) != used) *cause = errno;
    return file;
  }
  *cause = EBUSY;
  return REFUSED;
}

/* Release the lock; the file is deleted first, while nobody else can hold the lock */
void contact_unlock(int file, const char *name) {
  unlink(name);
  flock(file, LOCK_UN);
  close(file);
}

/* Delete the files in a folder whose names start with `start` and have an accepted rest */
void contact_clean(const char *folder, const char *start, int (*is_ours)(const char *rest, int length)) {
  const size_t skipped = strlen(start);
  DIR *entries = opendir(folder[0] ? folder : ".");
  if (entries == NULL) return;
  for (struct dirent *entry = readdir(entries); entry != NULL; entry = readdir(entries)) {
    const char *rest = entry->d_name + skipped;
    if (strncmp(entry->d_name, start, skipped) == 0 && is_ours(rest, (int)strlen(rest))) unlinkat(dirfd(entries), entry->d_name, 0);
  }
  closedir(entries);
}
