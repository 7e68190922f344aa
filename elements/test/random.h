/* Numbers of high entropy for tests: the same sequence for the same seed, on every machine. */
#ifndef BEAMWORK_TEST_RANDOM_H
#define BEAMWORK_TEST_RANDOM_H

#include <stdint.h>

/* 64 bits of splitmix64 (Steele, Lea, Flood, OOPSLA 2014); seeds may be small and adjacent. */
uint64_t random_bits(uint64_t *seed);
/* Uniform in [-1, 1), multiples of 2^-52. */
double random_number(uint64_t *seed);
/* 0 .. count - 1. */
int random_below(uint64_t *seed, int count);

#endif
