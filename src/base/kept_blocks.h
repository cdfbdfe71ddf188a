/* Blocks of memory released by a calculation, kept by its owner for the next one; see kept_blocks.c */
#ifndef CONTACT_KEPT_BLOCKS_H
#define CONTACT_KEPT_BLOCKS_H

#include <stddef.h>

struct kept_blocks;

/* An empty store of blocks; NULL if there is no memory. Its owner frees it when no thread uses it any more. Blocks that are still
 * in use remain valid */
struct kept_blocks *contact_kept_new(void);
void contact_kept_free(struct kept_blocks *kept);

/* A calculation begins to use the blocks */
void contact_kept_begin(struct kept_blocks *kept);

/* Has it an area, so that the work between calculations need not request memory from the system either? */
int contact_kept_goes_on(const struct kept_blocks *kept);

/* Size to be requested from the system for a block of n bytes that is to be kept: up to twice as large; n beyond 4 MB */
size_t contact_kept_size(size_t n);

/* A block of at least n bytes, or NULL: it has to come from the system */
void *contact_kept_take(struct kept_blocks *kept, size_t n);

/* The same at a multiple of `align`, a power of two */
void *contact_kept_take_aligned(struct kept_blocks *kept, size_t n, size_t align);

/* Keep a block, from malloc with a usable size of `room` bytes, or of this store; 0 if the caller has to free it in another way */
int contact_kept_put(struct kept_blocks *kept, void *block, size_t room);

/* Size of a block that was cut by a store; 0: it is from the system */
size_t contact_kept_room(const void *block);

/* Free a block that was cut by a store, in any thread; 0: it is from the system */
int contact_kept_return(void *block);

/* To be called in the child of a fork */
void contact_kept_after_fork(void);

#endif
