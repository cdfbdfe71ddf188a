/* Blocks of memory released by a calculation, kept by its owner for the next one.
 *
 * Arrays of the size of a window are reallocated when the window changes, which happens in a tenth of the steps of a loop over
 * time if the contact moves. Instead of being returned to the heap, such blocks are kept with the problem that used them: in
 * total up to `most_bytes`, of up to `largest` bytes each, in lists by size. Sizes are powers of two. A request is served by a
 * block of the next size, or of the one above, so that the blocks have room for a window that grows. If there is none, a stock
 * of blocks of this size is made at once, except in the first calculation, which only makes the blocks that it needs: later ones
 * find a block when more of them are in use, and few request memory from the heap. A thread uses the blocks of one owner while it
 * calculates (guard.c). */
#include "kept_blocks.h"
#include <stdint.h>
#include <stdlib.h>

enum { sizes = 15, smallest = 64, largest = smallest << (sizes - 1), most_bytes = 16 << 20 };

/* Upper bound of the extra size of a block of the system: a page and its head */
enum { most_rounding = 8192 };

/* Size of a stock in bytes; it has at most `most_stocked` blocks */
enum { stock_bytes = 2 << 20, most_stocked = 128 };

/* A kept block: its first bytes contain the address of the next one */
struct link {
  struct link *next;
};

struct kept_blocks {
  struct link *first[sizes];
  size_t bytes;
  /* Has the first calculation begun, and a later one? */
  int begun, goes_on;
};

static size_t size_of(unsigned k) { return (size_t)smallest << k; }

/* Index of the largest size that is at most n, for n >= smallest */
static unsigned size_below(size_t n) { return 57u - (unsigned)__builtin_clzll((unsigned long long)n); }

/* Index of the smallest size that is at least n */
static unsigned size_above(size_t n) { return n <= smallest ? 0 : size_below(n - 1) + 1; }

struct kept_blocks *contact_kept_new(void) { return calloc(1, sizeof(struct kept_blocks)); }

void contact_kept_free(struct kept_blocks *kept) {
  if (kept == NULL) return;
  for (unsigned k = 0; k < sizes; k++)
    while (kept->first[k] != NULL) {
      struct link *block = kept->first[k];
      kept->first[k] = block->next;
      free(block);
    }
  free(kept);
}

void contact_kept_begin(struct kept_blocks *kept) {
  kept->goes_on = kept->begun;
  kept->begun = 1;
}

size_t contact_kept_size(size_t n) { return n > largest ? n : size_of(size_above(n)); }

int contact_kept_stock(const struct kept_blocks *kept, size_t size) {
  if (!kept->goes_on || size > largest || kept->bytes >= most_bytes) return 0;
  const size_t bytes = most_bytes - kept->bytes < stock_bytes ? most_bytes - kept->bytes : stock_bytes;
  return bytes/size < most_stocked ? (int)(bytes/size) : most_stocked;
}

void *contact_kept_take(struct kept_blocks *kept, size_t n) {
  if (n > largest) return NULL;
  unsigned k = size_above(n);
  if (kept->first[k] == NULL && k + 1 < sizes) k++;
  struct link *block = kept->first[k];
  if (block == NULL) return NULL;
  kept->first[k] = block->next;
  kept->bytes -= size_of(k);
  return block;
}

int contact_kept_put(struct kept_blocks *kept, void *block, size_t room) {
  if (room < smallest || room > largest + most_rounding) return 0;
  const unsigned k = size_below(room);
  if (kept->bytes + size_of(k) > most_bytes) return 0;
  struct link *link = block;
  link->next = kept->first[k];
  kept->first[k] = link;
  kept->bytes += size_of(k);
  return 1;
}
