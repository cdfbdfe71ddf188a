/* Blocks kept by an owner: each is reused by requests of its size, and no more are kept than allowed */
#include "kept_blocks.h"
#include <malloc.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

static void check(int condition, const char *what, size_t n) {
  if (condition) return;
  failures++;
  printf("FAILED %s: %zu bytes\n", what, n);
}

int main(void) {
  const size_t limit = (size_t)16 << 20, largest = (size_t)1 << 20;
  struct kept_blocks *kept = contact_kept_new();
  size_t n, total = 0;
  int blocks = 0;
  if (kept == NULL) return 1;
  for (n = 1; n <= largest; n += 1 + n/7) {
    const size_t size = contact_kept_size(n);
    void *block = malloc(size);
    check(size >= n && size <= (n < 64 ? 64 : 2*n), "the size of a block suits the request", n);
    check(contact_kept_take(kept, n) == NULL, "nothing is kept at first", n);
    check(contact_kept_put(kept, block, malloc_usable_size(block)), "a block is kept", n);
    check(contact_kept_take(kept, size + 1) == NULL, "it does not serve a larger request", n);
    check(contact_kept_take(kept, n) == block, "it serves a request of its size again", n);
    check(contact_kept_take(kept, n) == NULL, "but once only", n);
    memset(block, 1, n);
    free(block);
  }
  for (n = 64; n <= largest/4; n += 1 + n/7) {
    void *twice = malloc(2*contact_kept_size(n)), *more = malloc(4*contact_kept_size(n));
    check(contact_kept_put(kept, more, malloc_usable_size(more)), "a block of four times the size is kept", n);
    check(contact_kept_take(kept, n) == NULL, "it does not serve the request", n);
    check(contact_kept_put(kept, twice, malloc_usable_size(twice)), "a block of twice the size is kept", n);
    check(contact_kept_take(kept, n) == twice, "it serves the request", n);
    check(contact_kept_take(kept, 4*n) == more, "the other one is used for a request of its size", n);
    free(twice);
    free(more);
  }
  void *large = malloc(largest + 4096), *tiny = malloc(1);
  check(!contact_kept_put(kept, large, largest + largest/2), "a block that is too large is not kept", largest + largest/2);
  check(!contact_kept_put(kept, tiny, 8), "nor is a tiny one", 8);
  check(contact_kept_size(3*largest) == 3*largest, "requests that are not kept are not rounded up", 3*largest);
  free(large);
  free(tiny);
  contact_kept_begin(kept);
  check(contact_kept_stock(kept, 64) == 0, "the first calculation makes no stock", 64);
  contact_kept_begin(kept);
  check(contact_kept_stock(kept, 64) == 128, "a stock consists of a limited number of blocks", 64);
  check(contact_kept_stock(kept, 32768) == 64, "and of a limited number of bytes", 32768);
  check(contact_kept_stock(kept, 3*largest) == 0, "none of blocks that are not kept", 3*largest);
  for (n = 1000; blocks < 100000; blocks++) {
    void *block = malloc(contact_kept_size(n));
    if (!contact_kept_put(kept, block, malloc_usable_size(block))) {
      free(block);
      break;
    }
    total += contact_kept_size(n);
  }
  check(total <= limit && total > limit - 2000, "blocks are kept up to the limit", total);
  check(contact_kept_stock(kept, 1024) == 0, "and no stock is made beyond it", 1024);
  contact_kept_free(kept);
  contact_kept_free(NULL);
  printf("%d blocks of %zu bytes were kept\n", blocks, contact_kept_size(1000));
  return failures > 0;
}
