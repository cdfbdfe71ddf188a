/* Connection of libFuzzer and a target: its entry points, and coverage of branches
 *
 * The rooms are compiled with -fsanitize-coverage=trace-pc: each block of the code calls __sanitizer_cov_trace_pc. Pairs of
 * consecutive blocks are counted in a table that libFuzzer evaluates after each execution. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contact.h"
#include "fuzz.h"

enum { table_size = 1 << 17 };
__attribute__((section("__libfuzzer_extra_counters"))) static uint8_t counters[table_size];
/* Pairs that were ever seen */
static uint8_t seen[table_size];
static uintptr_t before;

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t room);
int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t room, unsigned seed);
size_t LLVMFuzzerCustomCrossOver(const uint8_t *one, size_t one_size, const uint8_t *other, size_t other_size, uint8_t *data,
  size_t room, unsigned seed);
void __sanitizer_cov_trace_pc(void);

void __sanitizer_cov_trace_pc(void)
{
  /* relative to the library, whose address differs from run to run */
  uintptr_t here = ((uintptr_t)__builtin_return_address(0) - (uintptr_t)&contact_run) * 0x9e3779b97f4a7c15u >> 47;
  counters[here ^ before]++;
  before = here >> 1;
}

/* Printed at the end, for the table of doc/validation/robustness.md */
static void tell_branches(void)
{
  size_t n = 0;
  for (size_t k = 0; k < table_size; k++) n += seen[k];
  fprintf(stderr, "stat::branches: %zu\n", n);
}

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
  (void)argc;
  (void)argv;
  fuzz_enter();
  fuzz_begin();
  fuzz_keep();
  atexit(tell_branches);
  return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  before = 0;
  fuzz_execute((const char *)data, size);
  for (size_t k = 0; k < table_size; k += 8) {
    uint64_t eight;
    memcpy(&eight, counters + k, 8);
    if (eight)
      for (size_t i = k; i < k + 8; i++) seen[i] |= counters[i] != 0;
  }
  return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t room, unsigned seed)
{
  uint64_t state = seed;
  if (fuzz_random(&state, 4) == 0) return LLVMFuzzerMutate(data, size, room);
  return fuzz_mutate((char *)data, size, room, NULL, 0, &state);
}

size_t LLVMFuzzerCustomCrossOver(const uint8_t *one, size_t one_size, const uint8_t *other, size_t other_size, uint8_t *data,
  size_t room, unsigned seed)
{
  uint64_t state = seed;
  if (one_size > room) one_size = room;
  memcpy(data, one, one_size);
  return fuzz_mutate((char *)data, one_size, room, (const char *)other, other_size, &state);
}
