/* Blocks kept by an owner: each is reused by requests of its size, no more are kept than allowed; areas from which they are cut */
#define _GNU_SOURCE
#include "kept_blocks.h"
#include <malloc.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __linux__
#include <pthread.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

static int failures = 0;

/* Number of requests for address space; the function of the C library is replaced in this program, but not that of a sanitizer */
static long requests = 0;
#if defined(__linux__) && defined(SYS_mmap) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
void *mmap(void *p, size_t n, int access, int flags, int file, off_t offset) {
  requests++;
  return (void *)syscall(SYS_mmap, p, n, access, flags, file, offset);
}
#endif

static void check(int condition, const char *what, size_t n) {
  if (condition) return;
  failures++;
  printf("FAILED %s: %zu bytes\n", what, n);
}

/* A store in its second calculation; it has an area, unless address space is limited */
static struct kept_blocks *later_store(void) {
  struct kept_blocks *kept = contact_kept_new();
  if (kept == NULL) exit(1);
  contact_kept_begin(kept);
  check(contact_kept_take(kept, 1000) == NULL, "the first calculation uses the heap", 1000);
  check(!contact_kept_goes_on(kept), "it has no area", 0);
  contact_kept_begin(kept);
  return kept;
}

/* Blocks cut from an area: sizes, no overlap, alignment, return by their owner or by others, use after the owner is gone */
static void test_areas(void) {
  enum { many = 500 };
  struct kept_blocks *kept = later_store(), *other = later_store();
  unsigned char *block[many];
  size_t n, size[many];
  int k, i, wrong = 0;
  if (!contact_kept_goes_on(kept)) {
    printf("no areas: address space is limited\n");
    contact_kept_free(kept);
    contact_kept_free(other);
    return;
  }
  for (k = 0, n = 1; k < many; k++, n = n*13/11 + 1) {
    if (n > 50000) n = 1;
    size[k] = n;
    block[k] = contact_kept_take(kept, n);
    check(block[k] != NULL, "a later calculation gets a block without the heap", n);
    check(contact_kept_room(block[k]) >= n, "it has room", n);
    check((uintptr_t)block[k]%64 == 0, "it begins at a cache line", n);
    memset(block[k], k%251, contact_kept_room(block[k]));
  }
  for (k = 0; k < many; k++)
    for (n = 0; n < contact_kept_room(block[k]); n++) wrong += block[k][n] != k%251;
  check(wrong == 0, "blocks do not overlap", (size_t)wrong);
  check(!contact_kept_put(other, block[0], 64), "another store does not keep it", 0);
  check(contact_kept_return(block[0]), "it is returned", 0);
  contact_kept_begin(kept);
  check(contact_kept_take(kept, size[0]) == block[0], "and serves its owner again", size[0]);
  void *odd = malloc(200), *ordinary = malloc(300);
  check(contact_kept_room(ordinary) == 0 && !contact_kept_return(ordinary), "a block of the heap is told apart", 300);
  if ((uintptr_t)odd%64 != 0) {
    check(contact_kept_put(kept, odd, 128), "a block of the heap is kept", 128);
    void *even = contact_kept_take_aligned(kept, 128, 64);
    check(even != NULL && even != odd && (uintptr_t)even%64 == 0, "a request with an alignment gets another one", 128);
    contact_kept_put(kept, even, 128);
    check(contact_kept_take_aligned(kept, 128, 64) == even, "which serves it again", 128);
    contact_kept_return(even);
  } else {
    free(odd);
  }
  check(contact_kept_take_aligned(kept, 128, 4096) == NULL, "an alignment beyond a cache line is left to the system", 4096);
  free(ordinary);
  for (k = 0; k < many/2; k++) contact_kept_put(kept, block[k], size[k]);
  contact_kept_free(kept);
  for (k = many/2, wrong = 0; k < many; k++)
    for (n = 0; n < contact_kept_room(block[k]); n++) wrong += block[k][n] != k%251;
  check(wrong == 0, "blocks in use remain when their owner is gone", (size_t)wrong);
  for (k = many/2; k < many; k++) {
    i = contact_kept_return(block[k]);
    check(i, "they are freed one by one", size[k]);
  }
  check(contact_kept_room(block[many - 1]) == 0, "the area is gone with the last one", 0);
  contact_kept_free(other);
}

/* Calculations that needed little leave room for one that needs more than the rest of an area, without a request to the system */
static void test_room_ahead(void) {
  enum { most = 20, calculations = 60 };
  const size_t n = (size_t)1 << 20;
  struct kept_blocks *kept = later_store();
  void *block[most];
  int k;
  if (contact_kept_goes_on(kept)) {
    for (k = 2; k < calculations; k++) {
      contact_kept_begin(kept);
      void *few = contact_kept_take(kept, 3*n);
      check(few != NULL, "each calculation gets its block", 3*n);
      contact_kept_put(kept, few, 0);
    }
    const long before = requests;
    for (k = 0; k < most; k++) {
      block[k] = contact_kept_take(kept, n);
      check(block[k] != NULL, "a larger calculation is served", n);
    }
    check(requests == before, "it requests no area from the system", (size_t)(requests - before));
    while (k > 0) contact_kept_put(kept, block[--k], 0);
  }
  contact_kept_free(kept);
}

/* Areas follow one another up to a limit, then larger kept blocks are used, then the heap */
static void test_large(void) {
  enum { most = 100 };
  const size_t n = (size_t)1 << 20;
  struct kept_blocks *kept = later_store();
  void *block[most], *next;
  int k = 0, cuts;
  if (contact_kept_goes_on(kept)) {
    void *large = contact_kept_take(kept, 4*n);
    while (k < most && (block[k] = contact_kept_take(kept, n)) != NULL) k++;
    cuts = k;
    check(cuts > 40 && cuts <= 64, "the address space of an owner has a limit", (size_t)cuts);
    contact_kept_put(kept, large, 0);
    next = contact_kept_take(kept, n);
    check(next == large, "a larger block serves at last", n);
    check(contact_kept_take(kept, n) == NULL, "then the heap has to", n);
    contact_kept_put(kept, next, 0);
    while (k > 0) contact_kept_put(kept, block[--k], 0);
    for (k = 0; k < cuts && contact_kept_take(kept, n) != NULL;) k++;
    check(k == cuts, "freed blocks serve again", (size_t)k);
  }
  contact_kept_free(kept);
}

#ifdef __linux__
/* Blocks of one store are returned by another thread while it goes on; none is lost or given twice */
static void *blocks_to_return[2000];
static atomic_int ready = 0;

static void *return_blocks(void *data) {
  int k = 0;
  while (k < 2000) {
    if (k >= ready) continue;
    if (!contact_kept_return(blocks_to_return[k])) *(int *)data = 1;
    k++;
  }
  return NULL;
}

static void test_threads(void) {
  struct kept_blocks *kept = later_store();
  pthread_t thread;
  int lost = 0, wrong = 0, k;
  if (contact_kept_goes_on(kept) && pthread_create(&thread, NULL, return_blocks, &lost) == 0) {
    for (k = 0; k < 2000; k++) {
      int *block = contact_kept_take(kept, 4000);
      if (block == NULL) break;
      *block = k;
      blocks_to_return[k] = block;
      ready = k + 1;
      if (k%10 == 0) contact_kept_begin(kept);
    }
    wrong = k < 2000;
    ready = 2000;
    pthread_join(thread, NULL);
    check(!lost && !wrong, "blocks are returned by another thread", (size_t)k);
  }
  contact_kept_free(kept);
}
#else
static void test_threads(void) {}
#endif

int main(void) {
  const size_t limit = (size_t)16 << 20, largest = (size_t)4 << 20;
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
  for (n = 1000; blocks < 100000; blocks++) {
    void *block = malloc(contact_kept_size(n));
    if (!contact_kept_put(kept, block, malloc_usable_size(block))) {
      free(block);
      break;
    }
    total += contact_kept_size(n);
  }
  check(total <= limit && total > limit - 2000, "blocks are kept up to the limit", total);
  contact_kept_free(kept);
  contact_kept_free(NULL);
  test_areas();
  test_large();
  test_room_ahead();
  test_threads();
  printf("%d blocks of %zu bytes were kept\n", blocks, contact_kept_size(1000));
  return failures > 0;
}
