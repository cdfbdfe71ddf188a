/* Blocks of memory that a calculation has given back, kept by its owner for the next one; see kept_blocks.c */
#ifndef CONTACT_KEPT_BLOCKS_H
#define CONTACT_KEPT_BLOCKS_H

#include <stddef.h>

struct kept_blocks;

/* A place for blocks, empty; NULL where there is no memory. Its owner frees it when no thread uses it any more */
struct kept_blocks *contact_kept_new(void);
void contact_kept_free(struct kept_blocks *kept);

/* What is to be requested from the system so that a block of n bytes can be kept: n or a little more */
size_t contact_kept_size(size_t n);

/* A block of at least n bytes that was kept, or NULL */
void *contact_kept_take(struct kept_blocks *kept, size_t n);

/* Keep a block with room for so many bytes, from malloc; 0 where it has to be freed instead */
int contact_kept_put(struct kept_blocks *kept, void *block, size_t room);

#endif
