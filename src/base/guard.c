/* Failed memory requests, and run-time libraries that would end the process.
 *
 * Compiled Fortran does not check the result of malloc in allocations by assignment. Its run-time library, the OpenMP library
 * and FFTW end the process when memory is exhausted. None of this may happen to a host program. Calls of malloc and related
 * functions, exit and abort in this code and in those libraries are therefore redirected here:
 *
 * - a small request that the system refuses is served from a reserve, and the computation continues with correct results;
 * - a larger request of our own code abandons all work up to the enclosing guard, contact_guard, which reports the cause;
 * - so does a run-time library that attempts to end the process.
 *
 * Outside a guard nothing changes, so a host that uses the same run-time libraries sees no difference. Abandoned work keeps its
 * memory; blocks of more than `recorded` bytes are recorded with their owner, which can free them.
 *
 * Calls are redirected by writing to the tables of imported addresses (GOT) of the loaded objects when this one is loaded. On
 * systems other than Linux with ELF on x86-64 or AArch64, and under sanitizers, nothing is redirected and guards do nothing. */
#define _GNU_SOURCE
#include <setjmp.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include "kept_blocks.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WATCHED 0
#elif defined(__linux__) && defined(__ELF__) && (defined(__x86_64__) || defined(__aarch64__))
#define WATCHED 1
#else
#define WATCHED 0
#endif

/* How a guard ended: work done; out of memory; a run-time library failed. Same values as guard_end in guard.f90 */
enum { done = 0, no_memory = 1, gave_up = 2 };

int contact_guard(void (*work)(void *), void *data, int owner);
void contact_guard_free(int owner);
int contact_guard_new_owner(void);
void contact_guard_set_owner(int owner);
void contact_guard_expect(int refusals);
void contact_guard_use_blocks(struct kept_blocks *blocks);
void contact_guard_use_blocks_again(struct kept_blocks *blocks);
void contact_guard_whole_process(void);
_Noreturn void contact_guard_without_memory(void);
int contact_guard_is_watched(void);
int contact_guard_reserve_used(void);

static _Atomic int owners = 0;

/* A new identifier for an owner of memory blocks */
int contact_guard_new_owner(void) { return atomic_fetch_add(&owners, 1) + 1; }

#if !WATCHED

int contact_guard(void (*work)(void *), void *data, int owner) {
  (void)owner;
  work(data);
  return done;
}
void contact_guard_free(int owner) { (void)owner; }
void contact_guard_set_owner(int owner) { (void)owner; }
void contact_guard_expect(int refusals) { (void)refusals; }
void contact_guard_use_blocks(struct kept_blocks *blocks) { (void)blocks; }
void contact_guard_use_blocks_again(struct kept_blocks *blocks) { (void)blocks; }
void contact_guard_whole_process(void) {}
_Noreturn void contact_guard_without_memory(void) { abort(); }
int contact_guard_is_watched(void) { return 0; }
int contact_guard_reserve_used(void) { return 0; }

#else

#include <dlfcn.h>
#include <elf.h>
#include <errno.h>
#include <link.h>
#include <malloc.h>
#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>

/* ---- state of a thread ---- */

/* An active guard */
struct guard {
  jmp_buf place;
  struct guard *outer;
  int criticals, cause;
};

/* Maximum nesting depth of OpenMP critical sections in this code */
enum { max_criticals = 8 };

static _Thread_local __attribute__((tls_model("initial-exec"))) struct {
  struct guard *guard;
  /* Owner of the blocks; does the code handle refusals itself? */
  int owner, expects;
  /* Store that its blocks come from and return to; NULL: the heap */
  struct kept_blocks *blocks;
  /* Critical sections that the thread is in */
  int criticals;
  void **critical[max_criticals];
  /* Was work abandoned, whose end is being handled? */
  int after;
} guarded_thread;
#define me guarded_thread

/* Do all threads of the process belong to the program, inside and outside guards? */
static int whole_process = 0, watched = 0;

/* The original functions, looked up before calls are redirected */
static struct {
  void *(*malloc)(size_t);
  void *(*calloc)(size_t, size_t);
  void *(*realloc)(void *, size_t);
  void *(*memalign)(size_t, size_t);
  int (*posix_memalign)(void **, size_t, size_t);
  void *(*aligned_alloc)(size_t, size_t);
  void (*free)(void *);
  size_t (*usable_size)(void *);
  char *(*strdup)(const char *);
  char *(*strndup)(const char *, size_t);
  void (*exit)(int);
  void (*abort)(void);
  void (*parallel)(void (*)(void *), void *, unsigned, unsigned);
  void (*sections)(void (*)(void *), void *, unsigned, unsigned, unsigned);
  void (*enter)(void **);
  void (*leave)(void **);
} real;

/* ---- the reserve: first fit over a fixed piece of memory ---- */

enum { unit = 64, reserve_size = 8 << 20, largest_piece = 1 << 20 };

/* Our own code leaves so much to other libraries, and to the work that closes files after it ran out of memory [bytes]; these get
 * larger pieces, too. HDF5 1.10 damages the heap if a request of its free lists is refused: H5FL_blk_malloc counts in a node that
 * its garbage collection has freed; they ask for up to 1 MB and a head */
enum { kept_back = 4 << 20 };

struct piece {
  size_t size; /* with this head; a multiple of unit */
  _Atomic int used;
};

static _Alignas(4096) unsigned char reserve[reserve_size];
static atomic_flag reserve_lock = ATOMIC_FLAG_INIT;
static size_t reserve_place = 0;
static _Atomic int reserve_pieces = 0, reserve_uses = 0;

/* Number of requests served from the reserve */
int contact_guard_reserve_used(void) { return reserve_uses; }

static inline int in_reserve(const void *p) { return (uintptr_t)p - (uintptr_t)reserve < reserve_size; }

static struct piece *piece_of(void *p) { return (struct piece *)((unsigned char *)p - unit); }

/* A piece of the first `most` bytes of the reserve; it is small unless that is all of it */
static void *take_from_reserve(size_t n, size_t align, size_t most) {
  void *found = NULL;
  if ((n > largest_piece && most < reserve_size) || n > kept_back || align > 4096) return NULL;
  const size_t wanted = unit + (n + unit - 1)/unit*unit;
  while (atomic_flag_test_and_set_explicit(&reserve_lock, memory_order_acquire)) continue;
  struct piece *first = (struct piece *)reserve;
  if (first->size == 0) first->size = reserve_size;
  size_t at = reserve_place, walked = 0;
  while (walked < 2*(size_t)reserve_size) {
    struct piece *piece = (struct piece *)(reserve + at);
    if (!piece->used) {
      /* merge this piece with the free pieces that follow */
      while (at + piece->size < reserve_size) {
        struct piece *next = (struct piece *)(reserve + at + piece->size);
        if (next->used) break;
        piece->size += next->size;
      }
      const size_t shift = (align - (size_t)((uintptr_t)(reserve + at + unit)%align))%align;
      if (piece->size >= wanted + shift && at + shift + wanted <= most) {
        if (shift > 0) {
          const size_t rest = piece->size - shift;
          piece->size = shift;
          at += shift;
          piece = (struct piece *)(reserve + at);
          piece->size = rest;
        }
        if (piece->size > wanted) {
          struct piece *next = (struct piece *)(reserve + at + wanted);
          next->size = piece->size - wanted;
          next->used = 0;
          piece->size = wanted;
        }
        piece->used = 1;
        found = reserve + at + unit;
        break;
      }
    }
    walked += piece->size;
    at += piece->size;
    if (at >= reserve_size) at = 0;
  }
  reserve_place = at;
  atomic_flag_clear_explicit(&reserve_lock, memory_order_release);
  if (found) {
    reserve_pieces++;
    reserve_uses++;
  }
  return found;
}

static void give_to_reserve(void *p) {
  piece_of(p)->used = 0;
  reserve_pieces--;
}

/* Usable size of a block from malloc or from a store */
static size_t room_of(void *p) {
  const size_t n = contact_kept_room(p);
  return n > 0 ? n : real.usable_size(p);
}

/* Free a block that is not of the reserve */
static void free_block(void *p) {
  if (p == NULL || contact_kept_return(p)) return;
  real.free(p);
}

/* ---- blocks with owners ---- */

/* Larger blocks [bytes] are recorded. A block whose table entry is taken is not recorded, and leaks if its work is abandoned */
enum { recorded = 16 << 10, table_size = 4096 };
static struct {
  _Atomic(void *) block;
  _Atomic int owner;
} table[table_size];

static inline unsigned place_of(const void *p) {
  return (unsigned)(((uintptr_t)p >> 4)*UINT64_C(0x9E3779B97F4A7C15) >> 52)%table_size;
}

static void note(void *p, int owner) {
  const unsigned k = place_of(p);
  void *nothing = NULL;
  if (owner != 0 && atomic_compare_exchange_strong(&table[k].block, &nothing, p)) table[k].owner = owner;
}

/* Owner of a block that is about to be freed; 0 if it was not recorded */
static inline int forget(void *p) {
  const unsigned k = place_of(p);
  if (atomic_load_explicit(&table[k].block, memory_order_relaxed) != p || p == NULL) return 0;
  const int owner = table[k].owner;
  table[k].owner = 0;
  atomic_store(&table[k].block, NULL);
  return owner;
}

/* Free the blocks of an owner whose work was abandoned; they must not be used any more */
void contact_guard_free(int owner) {
  me.after = 0;
  if (owner == 0) return;
  for (unsigned k = 0; k < table_size; k++) {
    void *p = table[k].block;
    if (p == NULL || table[k].owner != owner) continue;
    forget(p);
    free_block(p);
  }
}

/* Blocks allocated by this thread belong to this owner from now on; 0 for none */
void contact_guard_set_owner(int owner) { me.owner = owner; }

/* Does the code that follows check the result of its own allocations (1) or not (0)? */
void contact_guard_expect(int refusals) { me.expects = refusals; }

/* From now on this thread takes its blocks from a store and returns them to it; NULL: from the heap */
void contact_guard_use_blocks(struct kept_blocks *blocks) {
  if (blocks != NULL) contact_kept_begin(blocks);
  me.blocks = blocks;
}

/* The same between calculations, unless the blocks of the first one are not there yet */
void contact_guard_use_blocks_again(struct kept_blocks *blocks) {
  if (blocks != NULL && contact_kept_goes_on(blocks)) me.blocks = blocks;
}

/* ---- guards ---- */

/* Run the work. If it runs out of memory it is abandoned, and the cause is returned */
int contact_guard(void (*work)(void *), void *data, int owner) {
  struct guard guard;
  const int owner_before = me.owner;
  struct kept_blocks *const blocks_before = me.blocks;
  guard.outer = me.guard;
  guard.criticals = me.criticals;
  guard.cause = done;
  if (_setjmp(guard.place) == 0) {
    me.guard = &guard;
    if (owner != 0) me.owner = owner;
    work(data);
  }
  me.guard = guard.outer;
  me.owner = owner_before;
  me.blocks = blocks_before;
  me.expects = 0;
  return guard.cause;
}

/* Abandon all work up to the innermost guard of this thread, and release its critical sections */
static _Noreturn void leave_all(int cause) {
  struct guard *guard = me.guard;
  while (me.criticals > guard->criticals) {
    me.criticals--;
    if (me.criticals < max_criticals) real.leave(me.critical[me.criticals]);
  }
  guard->cause = cause;
  me.after = 1;
  longjmp(guard->place, 1);
}

/* ---- refused requests ---- */

static void *serve(size_t n, size_t align, int own) {
  if (me.guard == NULL && !whole_process) return NULL;
  void *p = take_from_reserve(n, align, own && !me.after ? reserve_size - kept_back : reserve_size);
  if (p == NULL && own && me.guard != NULL && !me.expects) leave_all(no_memory);
  if (p == NULL) errno = ENOMEM;
  return p;
}

static void *request(size_t n, int own) {
  void *p = NULL;
  if (me.blocks != NULL) p = contact_kept_take(me.blocks, n);
  if (p == NULL) p = real.malloc(me.blocks != NULL ? contact_kept_size(n) : n);
  if (p == NULL) return serve(n, 16, own);
  if (own && n >= recorded) note(p, me.owner);
  return p;
}

static void *cleared(size_t count, size_t size, int own) {
  void *p = NULL;
  size_t n;
  const int keeps = me.blocks != NULL && !__builtin_mul_overflow(count, size, &n);
  if (keeps) p = contact_kept_take(me.blocks, n);
  if (p != NULL) memset(p, 0, n);
  if (p == NULL) p = keeps ? real.calloc(1, contact_kept_size(n)) : real.calloc(count, size);
  if (p == NULL) {
    if (__builtin_mul_overflow(count, size, &n)) n = SIZE_MAX;
    p = serve(n, 16, own);
    if (p != NULL) memset(p, 0, n);
  } else if (own && count*size >= recorded) {
    note(p, me.owner);
  }
  return p;
}

static void release(void *p) {
  if (in_reserve(p)) {
    give_to_reserve(p);
    return;
  }
  forget(p);
  if (me.blocks != NULL && p != NULL && contact_kept_put(me.blocks, p, room_of(p))) return;
  free_block(p);
}

static void *resized(void *p, size_t n, int own) {
  if (p == NULL) return request(n, own);
  size_t old;
  if (n > 0 && !in_reserve(p) && (me.blocks != NULL || contact_kept_room(p) > 0)) {
    old = room_of(p);
    if (n <= old && old/2 <= n) return p;
    void *q = request(n, own);
    if (q == NULL) return NULL;
    memcpy(q, p, old < n ? old : n);
    release(p);
    return q;
  }
  if (in_reserve(p)) {
    old = piece_of(p)->size - unit;
    if (n <= old && n > 0) return p;
  }
  if (n == 0) {
    release(p);
    return NULL;
  }
  if (!in_reserve(p)) {
    const int owner = forget(p);
    void *q = real.realloc(p, n);
    if (q != NULL) {
      if (own && n >= recorded) note(q, owner != 0 ? owner : me.owner);
      return q;
    }
    note(p, owner);
    if (me.guard == NULL && !whole_process) return NULL;
    old = real.usable_size(p);
  }
  void *q = in_reserve(p) ? request(n, own) : serve(n, 16, own);
  if (q == NULL) return NULL;
  memcpy(q, p, old < n ? old : n);
  release(p);
  return q;
}

static void *own_malloc(size_t n) { return request(n, 1); }
static void *own_calloc(size_t count, size_t size) { return cleared(count, size, 1); }
static void *own_realloc(void *p, size_t n) { return resized(p, n, 1); }
static void *other_malloc(size_t n) { return request(n, 0); }
static void *other_calloc(size_t count, size_t size) { return cleared(count, size, 0); }
static void *other_realloc(void *p, size_t n) { return resized(p, n, 0); }

static void *kept_aligned(size_t align, size_t n) {
  return me.blocks != NULL && (align & (align - 1)) == 0 ? contact_kept_take_aligned(me.blocks, n, align) : NULL;
}

static void *other_memalign(size_t align, size_t n) {
  void *p = kept_aligned(align, n);
  if (p == NULL) p = real.memalign(align, n);
  return p != NULL ? p : serve(n, align, 0);
}

static void *other_aligned_alloc(size_t align, size_t n) {
  void *p = kept_aligned(align, n);
  if (p == NULL) p = real.aligned_alloc(align, n);
  return p != NULL ? p : serve(n, align, 0);
}

static int other_posix_memalign(void **p, size_t align, size_t n) {
  void *kept = kept_aligned(align, n);
  if (kept != NULL) {
    *p = kept;
    return 0;
  }
  const int error = real.posix_memalign(p, align, n);
  if (error != ENOMEM) return error;
  void *q = serve(n, align, 0);
  if (q == NULL) return error;
  *p = q;
  return 0;
}

static char *copied(char *copy, const char *text, size_t n) {
  if (copy != NULL) return copy;
  copy = serve(n + 1, 1, 0);
  if (copy == NULL) return NULL;
  memcpy(copy, text, n);
  copy[n] = 0;
  return copy;
}

/* A copy in a kept block, NULL if there is none */
static char *kept_copy(const char *text, size_t n) {
  char *const copy = me.blocks != NULL ? contact_kept_take(me.blocks, n + 1) : NULL;
  if (copy == NULL) return NULL;
  memcpy(copy, text, n);
  copy[n] = 0;
  return copy;
}

static char *other_strdup(const char *text) {
  char *const copy = kept_copy(text, strlen(text));
  return copied(copy != NULL ? copy : real.strdup(text), text, strlen(text));
}

static char *other_strndup(const char *text, size_t n) {
  char *const copy = kept_copy(text, strnlen(text, n));
  return copied(copy != NULL ? copy : real.strndup(text, n), text, strnlen(text, n));
}

/* ---- calls that end the process ---- */

static void other_exit(int status) {
  if (me.guard != NULL) leave_all(gave_up);
  real.exit(status);
}

static void other_abort(void) {
  if (me.guard != NULL) leave_all(gave_up);
  real.abort();
}

/* For our C++ code, whose run-time library throws when memory is exhausted */
_Noreturn void contact_guard_without_memory(void) {
  if (me.guard != NULL) leave_all(no_memory);
  abort();
}

/* ---- external libraries linked into the program: their calls have these names (program_hdf5.cmake) ---- */

void *contact_outside_malloc(size_t n);
void *contact_outside_calloc(size_t count, size_t size);
void *contact_outside_realloc(void *p, size_t n);
void contact_outside_free(void *p);
char *contact_outside_strdup(const char *text);
void contact_outside_exit(int status);
void contact_outside_abort(void);

void *contact_outside_malloc(size_t n) { return other_malloc(n); }
void *contact_outside_calloc(size_t count, size_t size) { return other_calloc(count, size); }
void *contact_outside_realloc(void *p, size_t n) { return other_realloc(p, n); }
void contact_outside_free(void *p) { release(p); }
char *contact_outside_strdup(const char *text) { return other_strdup(text); }
void contact_outside_exit(int status) { other_exit(status); }
void contact_outside_abort(void) { other_abort(); }

/* ---- OpenMP: threads of a team, critical sections ---- */

struct team {
  void (*work)(void *);
  void *data;
  int owner;
  _Atomic int cause;
};

/* Each thread of a team has its own guard; parallel regions contain no barriers that an abandoned thread would miss */
static void be_member(void *data) {
  struct team *team = data;
  const int cause = contact_guard(team->work, team->data, team->owner);
  if (cause != done) team->cause = cause;
}

static void own_parallel(void (*work)(void *), void *data, unsigned threads, unsigned flags) {
  if (me.guard == NULL) {
    real.parallel(work, data, threads, flags);
    return;
  }
  struct team team = {work, data, me.owner, done};
  real.parallel(be_member, &team, threads, flags);
  if (team.cause != done) leave_all(team.cause);
}

static void own_sections(void (*work)(void *), void *data, unsigned threads, unsigned count, unsigned flags) {
  if (me.guard == NULL) {
    real.sections(work, data, threads, count, flags);
    return;
  }
  struct team team = {work, data, me.owner, done};
  real.sections(be_member, &team, threads, count, flags);
  if (team.cause != done) leave_all(team.cause);
}

static void own_enter(void **name) {
  real.enter(name);
  if (me.criticals < max_criticals) me.critical[me.criticals] = name;
  me.criticals++;
}

static void own_leave(void **name) {
  me.criticals--;
  real.leave(name);
}

/* ---- redirection of calls ---- */

extern void GOMP_parallel(void (*)(void *), void *, unsigned, unsigned) __attribute__((weak));
extern void GOMP_parallel_sections(void (*)(void *), void *, unsigned, unsigned, unsigned) __attribute__((weak));
extern void GOMP_critical_name_start(void **) __attribute__((weak));
extern void GOMP_critical_name_end(void **) __attribute__((weak));

typedef void (*function)(void);

/* A redirected call: where pointers to the function and calls of it lead, and its targets from our own code and from other
 * libraries (null: not redirected). Calls for memory are redirected together, or not at all */
struct detour {
  const char *name;
  function pointed, real, own, other;
  int is_of_memory;
};

/* A call of an object that may be redirected: its entry, its target; is it for memory? */
struct call {
  function *slot, to;
  int is_of_memory;
};

/* Maximum number in an object: each function may be called and pointed to */
enum { max_calls = 32 };

struct detours {
  struct detour list[16];
  int count;
  /* Prefixes of the names */
  const char *letters;
};

#define MEMORY(name, own, other) {#name, (function)name, (function)real.name, (function)(own), (function)(other), 1}
#define DETOUR(name, kept, own, other) {#name, (function)name, (function)real.kept, (function)(own), (function)(other), 0}

/* Libraries that end the process, or whose memory is freed here */
static const char *const libraries[] = {"libgfortran.", "libgomp.", "libfftw3.", "libhdf5", "libz.", "libquadmath."};

static int begins_with_one(const char *name, const char *const *list, size_t count) {
  for (size_t k = 0; k < count; k++)
    if (strncmp(name, list[k], strlen(list[k])) == 0) return 1;
  return 0;
}
#define ONE_OF(name, list) begins_with_one(name, list, sizeof list/sizeof *list)

static int contains(const struct dl_phdr_info *info, const void *address) {
  for (int k = 0; k < info->dlpi_phnum; k++) {
    const ElfW(Phdr) *part = &info->dlpi_phdr[k];
    if (part->p_type == PT_LOAD && (uintptr_t)address - (info->dlpi_addr + part->p_vaddr) < part->p_memsz) return 1;
  }
  return 0;
}

/* Is a function in the executable, the first object? */
static int is_in_executable(struct dl_phdr_info *info, size_t size, void *pointed) {
  (void)size;
  return contains(info, (const void *)*(function *)pointed) ? 1 : -1;
}

/* Where calls of a function from other objects lead.
 *
 * Pointers to a function are the same in the whole process. In an executable at fixed addresses that has one, as the Python of
 * Debian, it is the address of an entry in its own table of calls. Calls lead to the first object behind the executable that
 * defines the function. */
static function actual(const char *name, function pointed) {
  struct link_map *object = NULL;
  function found = pointed;
  if (pointed == NULL || dl_iterate_phdr(is_in_executable, &pointed) != 1) return pointed;
  void *handle = dlopen(NULL, RTLD_LAZY);
  if (handle == NULL || dlinfo(handle, RTLD_DI_LINKMAP, &object) != 0) return pointed;
  dlclose(handle);
  for (object = object->l_next; object != NULL; object = object->l_next) {
    Dl_info place;
    void *address;
    handle = dlopen(object->l_name, RTLD_LAZY | RTLD_NOLOAD);
    if (handle == NULL) continue;
    address = dlsym(handle, name);
    dlclose(handle);
    /* an object also gives what those that it needs define */
    if (address == NULL || dladdr(address, &place) == 0 || (uintptr_t)place.dli_fbase != object->l_addr) continue;
    memcpy(&found, &address, sizeof found);
    break;
  }
  return found;
}
#define ACTUAL(name) ((__typeof__(&(name)))actual(#name, (function)name))

/* Write-protected addresses of a loaded object: start and length, 0 if there are none */
static void find_protected(const struct dl_phdr_info *info, uintptr_t *start, size_t *length) {
  const uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE);
  *length = 0;
  for (int k = 0; k < info->dlpi_phnum; k++) {
    const ElfW(Phdr) *part = &info->dlpi_phdr[k];
    if (part->p_type != PT_GNU_RELRO) continue;
    *start = (info->dlpi_addr + part->p_vaddr) & ~(page - 1);
    *length = ((info->dlpi_addr + part->p_vaddr + part->p_memsz) & ~(page - 1)) - *start;
  }
}

static int is_import(unsigned type) {
#ifdef __x86_64__
  return type == R_X86_64_JUMP_SLOT || type == R_X86_64_GLOB_DAT;
#else
  return type == R_AARCH64_JUMP_SLOT || type == R_AARCH64_GLOB_DAT;
#endif
}

static const struct detour *detour_of(const struct detours *detours, const char *symbol) {
  for (int d = 0; d < detours->count; d++)
    if (strcmp(symbol, detours->list[d].name) == 0) return &detours->list[d];
  return NULL;
}

/* May a call be redirected? Not if it is already, by a second copy of this code in the process or by another tool */
static int is_plain(const struct dl_phdr_info *info, function target, const struct detour *detour) {
  /* calls that were not made yet lead back to their own object */
  return target == detour->pointed || target == detour->real || contains(info, (const void *)target);
}

static int redirect(struct dl_phdr_info *info, size_t size, void *data) {
  const struct detours *detours = data;
  const char *name = info->dlpi_name ? info->dlpi_name : "", *base = strrchr(name, '/');
  const int own = contains(info, (const void *)&watched);
  const ElfW(Dyn) *entry = NULL;
  const ElfW(Rela) *tables[2] = {NULL, NULL};
  size_t bytes[2] = {0, 0};
  const ElfW(Sym) *symbols = NULL;
  const char *strings = NULL;
  uintptr_t protected = 0;
  size_t length = 0;
  struct call calls[max_calls];
  int count = 0, is_open = 0, memory_is_plain = 1;
  (void)size;

  base = base ? base + 1 : name;
  if (!own && !ONE_OF(base, libraries)) return 0;
  for (int k = 0; k < info->dlpi_phnum; k++)
    if (info->dlpi_phdr[k].p_type == PT_DYNAMIC) entry = (const ElfW(Dyn) *)(info->dlpi_addr + info->dlpi_phdr[k].p_vaddr);
  if (entry == NULL) return 0;
  for (; entry->d_tag != DT_NULL; entry++) {
    const uintptr_t value = entry->d_un.d_ptr, address = value < info->dlpi_addr ? value + info->dlpi_addr : value;
    if (entry->d_tag == DT_JMPREL) tables[0] = (const ElfW(Rela) *)address;
    if (entry->d_tag == DT_PLTRELSZ) bytes[0] = entry->d_un.d_val;
    if (entry->d_tag == DT_RELA) tables[1] = (const ElfW(Rela) *)address;
    if (entry->d_tag == DT_RELASZ) bytes[1] = entry->d_un.d_val;
    if (entry->d_tag == DT_SYMTAB) symbols = (const ElfW(Sym) *)address;
    if (entry->d_tag == DT_STRTAB) strings = (const char *)address;
    if (entry->d_tag == DT_PLTREL && entry->d_un.d_val != DT_RELA) return 0;
  }
  if (symbols == NULL || strings == NULL) return 0;
  find_protected(info, &protected, &length);
  for (int t = 0; t < 2; t++)
    for (size_t k = 0; tables[t] != NULL && k < bytes[t]/sizeof(ElfW(Rela)); k++) {
      const ElfW(Rela) *import = &tables[t][k];
      if (!is_import((unsigned)ELF64_R_TYPE(import->r_info))) continue;
      const char *symbol = strings + symbols[ELF64_R_SYM(import->r_info)].st_name;
      if (strchr(detours->letters, symbol[0]) == NULL) continue;
      const struct detour *detour = detour_of(detours, symbol);
      const function to = detour == NULL ? NULL : own ? detour->own : detour->other;
      if (to == NULL) continue;
      const struct call call = {(function *)(info->dlpi_addr + import->r_offset), to, detour->is_of_memory};
      if (count < max_calls && is_plain(info, *call.slot, detour)) calls[count++] = call;
      else if (detour->is_of_memory) memory_is_plain = 0;
    }
  for (int k = 0; k < count; k++) {
    if (calls[k].is_of_memory && !memory_is_plain) continue;
    if ((uintptr_t)calls[k].slot - protected < length && !is_open) {
      if (mprotect((void *)protected, length, PROT_READ | PROT_WRITE) != 0) return 0;
      is_open = 1;
    }
    *calls[k].slot = calls[k].to;
  }
  if (is_open) mprotect((void *)protected, length, PROT_READ);
  return 0;
}

/* Redirect the calls, once */
static void watch(void) {
  if (watched) return;
  watched = 1;
  real.malloc = ACTUAL(malloc);
  real.calloc = ACTUAL(calloc);
  real.realloc = ACTUAL(realloc);
  real.memalign = ACTUAL(memalign);
  real.posix_memalign = ACTUAL(posix_memalign);
  real.aligned_alloc = ACTUAL(aligned_alloc);
  real.free = ACTUAL(free);
  real.usable_size = ACTUAL(malloc_usable_size);
  real.strdup = ACTUAL(strdup);
  real.strndup = ACTUAL(strndup);
  real.exit = ACTUAL(exit);
  real.abort = ACTUAL(abort);
  real.parallel = ACTUAL(GOMP_parallel);
  real.sections = ACTUAL(GOMP_parallel_sections);
  real.enter = ACTUAL(GOMP_critical_name_start);
  real.leave = ACTUAL(GOMP_critical_name_end);
  struct detours detours = {{
    MEMORY(malloc, own_malloc, other_malloc), MEMORY(calloc, own_calloc, other_calloc), MEMORY(realloc, own_realloc, other_realloc),
    MEMORY(memalign, NULL, other_memalign), MEMORY(posix_memalign, NULL, other_posix_memalign),
    MEMORY(aligned_alloc, NULL, other_aligned_alloc), MEMORY(free, release, release),
    MEMORY(strdup, NULL, other_strdup), MEMORY(strndup, NULL, other_strndup), DETOUR(exit, exit, NULL, other_exit),
    DETOUR(abort, abort, NULL, other_abort), DETOUR(GOMP_parallel, parallel, own_parallel, NULL),
    DETOUR(GOMP_parallel_sections, sections, own_sections, NULL), DETOUR(GOMP_critical_name_start, enter, own_enter, NULL),
    DETOUR(GOMP_critical_name_end, leave, own_leave, NULL)}, 15, "mcrpafseG"};
  dl_iterate_phdr(redirect, &detours);
}

/* All threads of this process belong to the program. Called before the first library is initialised */
void contact_guard_whole_process(void) {
  whole_process = 1;
  watch();
}

/* A forked child has a single thread; the reserve and the areas of blocks must not be locked by another thread of the parent */
static void free_lock(void) {
  atomic_flag_clear(&reserve_lock);
  contact_kept_after_fork();
}

__attribute__((constructor)) static void begin(void) {
  watch();
  pthread_atfork(NULL, NULL, free_lock);
}

int contact_guard_is_watched(void) { return watched; }

#endif
