/* Blocks of memory released by a calculation, kept by its owner for the next one.
 *
 * Arrays of the size of a window are reallocated when the window changes, which happens in a tenth of the steps of a loop over
 * time if the contact moves. Instead of being returned to the heap, such blocks are kept with the problem that used them, in lists
 * by size. Sizes are powers of two. A request is served by a block of its size, or of the next one.
 *
 * If there is none, the block is cut from an area of 16 MB of address space. The owner gets two of them from the system at the
 * beginning of its second calculation. Pages of an area that no block has used take no memory. So later calculations have room for
 * larger windows than any before without a request to the heap, and without memory that nobody uses. The first calculation uses the
 * heap: many problems are calculated once. Each of the first 50 calculations begins with an area that no block has used, so that
 * there is one when they are over; later the owner gets one only when there is no space left. It has at most `most_areas`. Then
 * larger kept blocks are used, and at last the heap; blocks from there are kept up to `most_bytes`.
 *
 * A thread uses the blocks of one owner while it calculates (guard.c). A block of an area that is freed elsewhere, by a setting or
 * by another thread, waits in the list `returned` of the area for the next calculation of the owner. An area whose owner is gone
 * exists until its last block is freed; its free pages are given back at once. */
#define _GNU_SOURCE
#include "kept_blocks.h"
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>

#ifdef __linux__
#include <sys/mman.h>
#include <sys/resource.h>
#endif

enum { sizes = 17, smallest = 64, largest = smallest << (sizes - 1), most_bytes = 16 << 20 };

/* Upper bound of the extra size of a block of the system: a page and its head */
enum { most_rounding = 8192 };

enum { area_bits = 24, area_size = 1 << area_bits, most_areas = 4, page = 4096 };

/* Number of calculations after which an owner should need no further area */
enum { first_ones = 50 };


/* Blocks of this size and more are a cache line apart, so that arrays that are used together do not begin at the same place of
 * their pages */
enum { apart_from = 1024, apart = 64 };

/* A kept block: its first bytes contain the address of the next one */
struct link {
  struct link *next;
};

/* Head of an area, at its beginning, which is a multiple of its size */
struct area {
  /* Null: the owner is gone. This and the next two are protected by `lock_of_areas` */
  _Atomic(struct kept_blocks *) owner;
  struct link *returned;
  /* Number of blocks in use, after the owner is gone */
  long out;
  /* Number of blocks cut so far; where the next one begins [bytes] */
  long cut;
  size_t end;
  /* Index of the size of the block that begins at each place */
  unsigned char size_at[area_size/smallest];
};

struct kept_blocks {
  struct link *first[sizes];
  size_t bytes;
  struct area *area[most_areas];
  int areas;
  /* Index of the area from which blocks are cut: later ones are not used yet */
  int current;
  /* Number of calculations, up to `first_ones` + 1; was an area refused? */
  int count, refused;
};

static atomic_flag lock_of_areas = ATOMIC_FLAG_INIT;

static void lock_areas(void) {
  while (atomic_flag_test_and_set_explicit(&lock_of_areas, memory_order_acquire)) continue;
}
static void unlock_areas(void) { atomic_flag_clear_explicit(&lock_of_areas, memory_order_release); }

/* A forked child has a single thread; the lock must not be held by another thread of the parent */
void contact_kept_after_fork(void) { unlock_areas(); }

/* Beginnings of all areas by the bits above those of an area; an area whose entry is taken is not used */
enum { entries = 4096 };
static _Atomic uintptr_t area_at[entries];

static unsigned entry_of(uintptr_t base) { return (unsigned)(base >> area_bits)%entries; }

static struct area *area_of(const void *p) {
  const uintptr_t base = (uintptr_t)p & ~(uintptr_t)(area_size - 1);
  if (base == 0 || atomic_load_explicit(&area_at[entry_of(base)], memory_order_relaxed) != base) return NULL;
  return (struct area *)base;
}

#ifdef __linux__

/* A piece of address space that begins at a multiple of its size; NULL if the system refuses it, or if address space is limited
 * (ulimit -v) and therefore not to be used in advance */
static void *new_space(void) {
  struct rlimit limit;
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY) return NULL;
  char *const p = mmap(NULL, 2*(size_t)area_size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (p == MAP_FAILED) return NULL;
  const size_t before = (size_t)(-(uintptr_t)p & (area_size - 1));
  if (before > 0) munmap(p, before);
  munmap(p + before + area_size, area_size - before);
  return p + before;
}
static void free_space(void *p) { munmap(p, area_size); }

/* Give the pages inside a free block back to the system */
static void free_pages(char *block, size_t n) {
  const size_t before = (size_t)(-(uintptr_t)block & (page - 1));
  if (n >= before + page) madvise(block + before, (n - before) & ~(size_t)(page - 1), MADV_DONTNEED);
}

#else
static void *new_space(void) { return NULL; }
static void free_space(void *p) { (void)p; }
static void free_pages(char *block, size_t n) {
  (void)block;
  (void)n;
}
#endif

static void add_area(struct kept_blocks *kept) {
  struct area *const area = new_space();
  kept->refused = area == NULL;
  if (area == NULL) return;
  area->owner = kept;
  area->end = (sizeof *area + page - 1)/page*page;
  uintptr_t nothing = 0;
  kept->refused = !atomic_compare_exchange_strong(&area_at[entry_of((uintptr_t)area)], &nothing, (uintptr_t)area);
  if (kept->refused) free_space(area);
  else kept->area[kept->areas++] = area;
}

static void free_area(struct area *area) {
  atomic_store(&area_at[entry_of((uintptr_t)area)], 0);
  free_space(area);
}

static size_t size_of(unsigned k) { return (size_t)smallest << k; }

/* Index of the largest size that is at most n, for n >= smallest */
static unsigned size_below(size_t n) { return 57u - (unsigned)__builtin_clzll((unsigned long long)n); }

/* Index of the smallest size that is at least n */
static unsigned size_above(size_t n) { return n <= smallest ? 0 : size_below(n - 1) + 1; }

static unsigned size_in(const struct area *area, const void *block) {
  return area->size_at[((uintptr_t)block - (uintptr_t)area)/smallest];
}

/* A new block from the present area of the owner, or from the next one; NULL if there is no more space */
static void *cut(struct kept_blocks *kept, unsigned k) {
  const size_t n = size_of(k) + (size_of(k) >= apart_from ? apart : 0);
  if (kept->areas == 0) return NULL;
  if (kept->area[kept->current]->end + n > area_size) {
    const int next = kept->current + 1;
    if (next == kept->areas && next < most_areas && !kept->refused) add_area(kept);
    if (next == kept->areas) return NULL;
    kept->current = next;
  }
  struct area *const area = kept->area[kept->current];
  char *const block = (char *)area + area->end;
  area->size_at[area->end/smallest] = (unsigned char)k;
  area->end += n;
  area->cut++;
  return block;
}

static void keep(struct kept_blocks *kept, void *block, unsigned k) {
  struct link *link = block;
  link->next = kept->first[k];
  kept->first[k] = link;
}

/* Take back the blocks of an area that were freed elsewhere */
static void take_back(struct kept_blocks *kept, struct area *area) {
  struct link *block;
  while ((block = area->returned) != NULL) {
    area->returned = block->next;
    keep(kept, block, size_in(area, block));
  }
}

struct kept_blocks *contact_kept_new(void) { return calloc(1, sizeof(struct kept_blocks)); }

void contact_kept_free(struct kept_blocks *kept) {
  if (kept == NULL) return;
  lock_areas();
  for (int i = 0; i < kept->areas; i++) {
    take_back(kept, kept->area[i]);
    kept->area[i]->owner = NULL;
    kept->area[i]->out = kept->area[i]->cut;
  }
  for (unsigned k = 0; k < sizes; k++)
    while (kept->first[k] != NULL) {
      struct link *block = kept->first[k];
      struct area *area = area_of(block);
      kept->first[k] = block->next;
      if (area == NULL) {
        free(block);
        continue;
      }
      area->out--;
      free_pages((char *)block, size_of(k));
    }
  for (int i = 0; i < kept->areas; i++)
    if (kept->area[i]->out == 0) free_area(kept->area[i]);
  unlock_areas();
  free(kept);
}

void contact_kept_begin(struct kept_blocks *kept) {
  if (kept->count <= first_ones) kept->count++;
  if (kept->areas > 0) {
    lock_areas();
    for (int i = 0; i < kept->areas; i++) take_back(kept, kept->area[i]);
    unlock_areas();
  }
  if (kept->count == 1 || kept->count > first_ones) return;
  while (kept->areas < most_areas && kept->areas < kept->current + 2 && !kept->refused) add_area(kept);
}

size_t contact_kept_size(size_t n) { return n > largest ? n : size_of(size_above(n)); }

void *contact_kept_take(struct kept_blocks *kept, size_t n) {
  if (n > largest) return NULL;
  const unsigned wanted = size_above(n);
  unsigned k = wanted;
  if (kept->first[k] == NULL && k + 1 < sizes) k++;
  if (kept->first[k] == NULL) {
    void *const block = cut(kept, wanted);
    if (block != NULL || kept->count < 2) return block;
    while (k + 1 < sizes && kept->first[k] == NULL) k++;
  }
  struct link *block = kept->first[k];
  if (block == NULL) return NULL;
  kept->first[k] = block->next;
  if (area_of(block) == NULL) kept->bytes -= size_of(k);
  return block;
}

void *contact_kept_take_aligned(struct kept_blocks *kept, size_t n, size_t align) {
  if (n > largest || align > smallest) return NULL;
  const unsigned k = size_above(n);
  struct link **before = &kept->first[k];
  while (*before != NULL && (uintptr_t)*before%align != 0) before = &(*before)->next;
  struct link *block = *before;
  if (block == NULL) return cut(kept, k);
  *before = block->next;
  if (area_of(block) == NULL) kept->bytes -= size_of(k);
  return block;
}

int contact_kept_goes_on(const struct kept_blocks *kept) { return kept->areas > 0; }

int contact_kept_put(struct kept_blocks *kept, void *block, size_t room) {
  const struct area *area = area_of(block);
  if (area != NULL) {
    if (area->owner != kept) return 0;
    keep(kept, block, size_in(area, block));
    return 1;
  }
  if (room < smallest || room > largest + most_rounding) return 0;
  const unsigned k = size_below(room);
  if (kept->bytes + size_of(k) > most_bytes) return 0;
  keep(kept, block, k);
  kept->bytes += size_of(k);
  return 1;
}

size_t contact_kept_room(const void *block) {
  const struct area *area = area_of(block);
  return area == NULL ? 0 : size_of(size_in(area, block));
}

int contact_kept_return(void *block) {
  struct area *area = area_of(block);
  if (area == NULL) return 0;
  lock_areas();
  if (area->owner != NULL) {
    struct link *link = block;
    link->next = area->returned;
    area->returned = link;
    area = NULL;
  } else {
    area->out--;
    if (area->out > 0) {
      free_pages(block, size_of(size_in(area, block)));
      area = NULL;
    }
  }
  if (area != NULL) free_area(area);
  unlock_areas();
  return 1;
}
