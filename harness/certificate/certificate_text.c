#include "harness/certificate/certificate_text.h"

#include <math.h>
#include <string.h>

#include "harness/adapters/adapters.h"
#include "harness/tables/paragraph.h"

enum { NAME = 14, INDENT = 18 };

static void put_mark(FILE *to, screen look, claim_outcome outcome)
{
    static const char *const utf8[] = {"✔", "✘", "·"}, *const ascii[] = {"+", "X", "."};
    static const screen_ink ink[] = {SCREEN_GOOD, SCREEN_BAD, SCREEN_FAINT};
    fputs("  ", to);
    screen_put(to, look, ink[outcome], (look.utf8 ? utf8 : ascii)[outcome]);
    fputc(' ', to);
}

static claim_outcome outcome_of(const claims *c)
{
    if (claims_counted(c, CLAIM_BROKEN) > 0)
        return CLAIM_BROKEN;
    return claims_counted(c, CLAIM_HOLDS) > 0 ? CLAIM_HOLDS : CLAIM_NOT_CLAIMED;
}

/* A line for each claim that is broken, or all of them. */
static void write_claims(FILE *to, screen look, const claims *c, int verbose)
{
    for (int i = 0; i < c->count; i++) {
        const claim *one = &c->claim[i];
        if (!verbose && one->outcome != CLAIM_BROKEN)
            continue;
        fputs("    ", to);
        put_mark(to, look, one->outcome);
        if (one->outcome == CLAIM_HOLDS)
            paragraph_say(to, 8, 8, "%s: %d compared, at most %.1e (allowed %.1e)", one->name,
                          one->compared, one->worst, one->allowed);
        else if (one->outcome == CLAIM_BROKEN && isfinite(one->worst) && one->allowed > 0)
            paragraph_say(to, 8, 8, "%s (apart by %.1e, allowed %.1e)", one->sentence, one->worst,
                          one->allowed);
        else if (one->outcome == CLAIM_BROKEN)
            paragraph_write(to, 8, 8, one->sentence);
        else
            paragraph_say(to, 8, 8, "%s: not claimed; %s", one->name, one->sentence);
    }
}

static void write_family(FILE *to, screen look, const certificate *c, int part, int verbose)
{
    const claims *own = &c->part[part].claims;
    const claim_outcome outcome = outcome_of(own);
    put_mark(to, look, outcome);
    fprintf(to, "%-*s", NAME, certificate_part_name(part));
    if (outcome == CLAIM_NOT_CLAIMED)
        paragraph_say(to, INDENT, INDENT, "not claimed: %s",
                      own->count > 0 ? own->claim[0].sentence : "nothing to look at");
    else
        paragraph_say(to, INDENT, INDENT, "%s (%d compared)", certificate_part_words(part),
                      claims_compared(own));
    write_claims(to, look, own, verbose);
}

static void write_verdict(FILE *to, screen look, const certificate *c)
{
    const int broken = certificate_counted(c, CLAIM_BROKEN),
              kept = certificate_counted(c, CLAIM_HOLDS);
    fputs("contract: ", to);
    screen_put(to, look, broken == 0 ? SCREEN_GOOD : SCREEN_BAD, broken == 0 ? "KEPT" : "BROKEN");
    if (broken > 0)
        fprintf(to, ", %d of %d claims", broken, broken + kept);
    else
        fprintf(to, ", %d claims", kept);
    fprintf(to, " on %d numbers; %d not claimed\n", certificate_compared(c),
            certificate_counted(c, CLAIM_NOT_CLAIMED));
}

static void write_one(FILE *to, screen look, const certificate *c, int verbose, int quiet)
{
    const char *left = adapters_words(c->chosen.type);
    paragraph_write(to, fprintf(to, "%s: ", c->chosen.key), 2, c->chosen.type->summary);
    if (left[0] != '\0')
        paragraph_say(to, 0, 2, "leaves out %s", left);
    write_verdict(to, look, c);
    for (int i = 0; i < CHECKS_FAMILIES; i++)
        if (!quiet || outcome_of(&c->part[i].claims) == CLAIM_BROKEN)
            write_family(to, look, c, i, verbose);
}

void certificate_text(FILE *to, screen look, const certificate *all, int count, int verbose,
                      int quiet)
{
    int broken = 0, numbers = 0;
    for (int i = 0; i < count; i++) {
        if (i > 0 && !quiet)
            fputc('\n', to);
        if (!quiet || !certificate_holds(&all[i]))
            write_one(to, look, &all[i], verbose, quiet);
        broken += !certificate_holds(&all[i]);
        numbers += certificate_compared(&all[i]);
    }
    if (count > 1)
        fprintf(to, "%s%d of %d formulations keep the contract (%d numbers compared)\n",
                quiet ? "" : "\n", count - broken, count, numbers);
}
