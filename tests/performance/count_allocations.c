/* Counts requests for memory, to the heap and to the system (mmap), and records their callers; linked into the benchmark only.
 *
 * The benchmark defines the functions of the C library and calls the originals by their internal
 * names, which only glibc has. With other libraries, and with sanitizers, which replace the same
 * functions, the count is -1, "unknown". */
#define _GNU_SOURCE
#include <stddef.h>
#include <stdio.h>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(BENCH_NO_COUNT)
#include <errno.h>
#include <execinfo.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);
extern void *__libc_memalign(size_t, size_t);
extern void __libc_free(void *);

enum { depth = 7, places = 400, own = 2 };
static long count;
static int tracing, inside;
static struct { void *stack[depth]; long count; } place[places];

static void note(void)
{
  void *stack[depth + own];
  int i, n;
  __atomic_add_fetch(&count, 1, __ATOMIC_RELAXED);
  if (!tracing || inside) return;
  inside = 1;
  memset(stack, 0, sizeof stack);
  n = backtrace(stack, depth + own);
  if (n > own)
    for (i = 0; i < places; i++) {
      if (place[i].count && memcmp(place[i].stack, stack + own, sizeof place[i].stack)) continue;
      memcpy(place[i].stack, stack + own, sizeof place[i].stack);
      place[i].count++;
      break;
    }
  inside = 0;
}

void *malloc(size_t n) { note(); return __libc_malloc(n); }
void *calloc(size_t n, size_t m) { note(); return __libc_calloc(n, m); }
void *realloc(void *p, size_t n) { note(); return __libc_realloc(p, n); }
void *memalign(size_t a, size_t n) { note(); return __libc_memalign(a, n); }
void *aligned_alloc(size_t a, size_t n) { note(); return __libc_memalign(a, n); }
int posix_memalign(void **p, size_t a, size_t n)
{
  note();
  *p = __libc_memalign(a, n);
  return *p ? 0 : ENOMEM;
}
void free(void *p) { __libc_free(p); }
void *mmap(void *p, size_t n, int access, int flags, int file, off_t offset)
{
  note();
  return (void *)syscall(SYS_mmap, p, n, access, flags, file, offset);
}

long bench_allocations(void) { return count; }

void bench_trace(int on)
{
  void *warm[2];
  if (on) {
    backtrace(warm, 2);
    memset(place, 0, sizeof place);
  }
  tracing = on;
}

/* Load address of the program: the first line of its map */
static char *program_base(void)
{
  unsigned long base = 0;
  FILE *map = fopen("/proc/self/maps", "r");
  if (map) {
    if (fscanf(map, "%lx", &base) != 1) base = 0;
    fclose(map);
  }
  return (char *)base;
}

/* One line per call site: count and addresses, innermost first, relative to the program */
void bench_print_places(void)
{
  int i, j;
  char *base = program_base();
  for (i = 0; i < places && place[i].count; i++) {
    printf("PLACE %ld", place[i].count);
    for (j = 0; j < depth && place[i].stack[j]; j++) printf(" %p", (void *)((char *)place[i].stack[j] - 1 - (size_t)base));
    printf("\n");
  }
  fflush(stdout);
}
#else
long bench_allocations(void) { return -1; }
void bench_trace(int on) { (void)on; }
void bench_print_places(void) {}
#endif
