/* Blocks of memory released by a calculation, kept by its owner for the next one; see kept_blocks.c */
#ifndef CONTACT_KEPT_BLOCKS_H
#define CONTACT_KEPT_BLOCKS_H

#include <stddef.h>

struct kept_blocks;

/* An empty store of blocks; NULL if there is no memory. Its owner frees it when no thread uses it any more */
struct kept_blocks *contact_kept_new(void);
void contact_kept_free(struct kept_blocks *kept);

/* A calculation begins to use the blocks */
void contact_kept_begin(struct kept_blocks *kept);

/* Size to be requested from the system for a block of n bytes that is to be kept: up to twice as large, n beyond 1 MB */
size_t contact_kept_size(size_t n);

/* Number of further blocks of this size to be requested with a new one, and kept; 0 in the first calculation */
int contact_kept_stock(const struct kept_blocks *kept, size_t size);

/* A kept block of at least n bytes, or NULL */
void *contact_kept_take(struct kept_blocks *kept, size_t n);

/* Keep a block from malloc with a usable size of `room` bytes; 0 if the caller has to free it instead */
int contact_kept_put(struct kept_blocks *kept, void *block, size_t room);

#endif
