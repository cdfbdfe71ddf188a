/* Blocks of memory released by a calculation, kept by its owner for the next one.
 *
 * Arrays of the size of a window are reallocated when the window changes, which happens in a tenth of the steps of a loop over
 * time if the contact moves. Instead of being returned to the heap, such blocks are kept with the problem that used them: in
 * total up to `most_bytes`, of up to `largest` bytes each, in lists by size. There are four sizes per factor of two; a
 * request is served by the smallest kept block of up to twice its size. Distances of sizes are at least those of the block sizes of
 * the system. A thread uses the blocks of one owner while it calculates (guard.c). */
#include "kept_blocks.h"
#include <stdint.h>
#include <stdlib.h>

enum { sizes = 57, smallest = 64, largest = 1 << 20, most_bytes = 16 << 20, wider = 4 };

/* A kept block: its first bytes contain the address of the next one */
struct link {
  struct link *next;
};

struct kept_blocks {
  struct link *first[sizes];
  size_t bytes;
};

static size_t size_of(unsigned k) { return (size_t)(4 + k%4) << (k/4 + 4); }

/* Index of the largest size that is at most n, for n >= smallest */
static unsigned size_below(size_t n) {
  const unsigned shift = 61u - (unsigned)__builtin_clzll((unsigned long long)n);
  return 4*(shift - 4) + (unsigned)(n >> shift) - 4;
}

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

size_t contact_kept_size(size_t n) { return n > largest ? n : size_of(size_above(n)); }

void *contact_kept_take(struct kept_blocks *kept, size_t n) {
  if (n > largest) return NULL;
  /* the smallest block that is not more than twice as large: windows that grow and shrink share the same blocks */
  unsigned k = size_above(n);
  for (const unsigned end = k + wider < sizes ? k + wider : sizes - 1; k < end && kept->first[k] == NULL; k++) continue;
  struct link *block = kept->first[k];
  if (block == NULL) return NULL;
  kept->first[k] = block->next;
  kept->bytes -= size_of(k);
  return block;
}

int contact_kept_put(struct kept_blocks *kept, void *block, size_t room) {
  if (room < smallest) return 0;
  const unsigned k = size_below(room);
  if (k >= sizes || size_of(k) > largest || kept->bytes + size_of(k) > most_bytes) return 0;
  struct link *link = block;
  link->next = kept->first[k];
  kept->first[k] = link;
  kept->bytes += size_of(k);
  return 1;
}
