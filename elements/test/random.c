#include "elements/test/random.h"

uint64_t random_bits(uint64_t *seed)
{
    uint64_t z = *seed += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

double random_number(uint64_t *seed)
{
    return (double)(random_bits(seed) >> 11) / 4503599627370496.0 - 1;
}

int random_below(uint64_t *seed, int count)
{
    return (int)(random_bits(seed) % (uint64_t)count);
}
