#include "harness/experiments/claims.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

claim *claims_open(claims *c, const char *name, double allowed)
{
    for (int i = 0; i < c->count; i++)
        if (strcmp(c->claim[i].name, name) == 0)
            return &c->claim[i];
    assert(c->count < CLAIMS_MOST && strlen(name) < CLAIM_NAME);
    claim *one = &c->claim[c->count++];
    memset(one, 0, sizeof *one);
    snprintf(one->name, sizeof one->name, "%s", name);
    one->allowed = allowed;
    return one;
}

void claims_not_made(claims *c, const char *name, const char *why)
{
    claim *one = claims_open(c, name, 0);
    one->outcome = CLAIM_NOT_CLAIMED;
    snprintf(one->sentence, sizeof one->sentence, "%s", why);
}

__attribute__((format(printf, 3, 0))) static void note(claim *one, double departure,
                                                       const char *format, va_list words)
{
    const int worse = isnan(departure) ? !isnan(one->worst) : departure > one->worst;
    one->compared++;
    if (!worse)
        return;
    one->worst = departure;
    if (departure <= one->allowed)
        return;
    one->outcome = CLAIM_BROKEN;
    vsnprintf(one->sentence, sizeof one->sentence, format, words);
}

void claims_departs(claim *one, double departure, const char *format, ...)
{
    va_list words;
    va_start(words, format);
    note(one, departure, format, words);
    va_end(words);
}

void claims_asks(claim *one, int holds, const char *format, ...)
{
    va_list words;
    va_start(words, format);
    note(one, holds ? 0 : INFINITY, format, words);
    va_end(words);
}

void claims_doing(claims *c, const char *format, ...)
{
    va_list words;
    va_start(words, format);
    vsnprintf(c->doing, sizeof c->doing, format, words);
    va_end(words);
}

int claims_counted(const claims *c, claim_outcome outcome)
{
    int count = 0;
    for (int i = 0; i < c->count; i++)
        count += c->claim[i].outcome == outcome;
    return count;
}

int claims_compared(const claims *c)
{
    int count = 0;
    for (int i = 0; i < c->count; i++)
        count += c->claim[i].compared;
    return count;
}
