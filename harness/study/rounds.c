#include "harness/study/rounds.h"

#include <math.h>

double rounds_least(const rounds_reading *c)
{
    double least = INFINITY;
    for (int i = 0; i < c->rounds; i++)
        least = fmin(least, c->round[i]);
    return least;
}

double rounds_most(const rounds_reading *c)
{
    double most = 0;
    for (int i = 0; i < c->rounds; i++)
        most = fmax(most, c->round[i]);
    return c->rounds > 0 ? most : INFINITY;
}

int rounds_compare(const rounds_reading *a, const rounds_reading *b)
{
    return (rounds_most(b) < rounds_least(a)) - (rounds_most(a) < rounds_least(b));
}

double dense_reference_seconds(const dense_reference *b, long iterations)
{
    if (b->whole.rounds > 0)
        return rounds_least(&b->whole);
    return b->unknowns > 0 ? b->iteration * (double)iterations : INFINITY;
}
