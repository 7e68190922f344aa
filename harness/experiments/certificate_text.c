#include "harness/experiments/certificate_text.h"

#include <math.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/terminal/terminal.h"

enum { NAME = 14, INDENT = 18, MEASURE = 36, COLUMN = 8 };

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
    if (outcome == CLAIM_NOT_CLAIMED && c->late != NULL && own->count == 1 &&
        strncmp(own->claim[0].sentence, "not checked", 11) == 0)
        paragraph_write(to, INDENT, INDENT, own->claim[0].sentence);
    else if (outcome == CLAIM_NOT_CLAIMED)
        paragraph_say(to, INDENT, INDENT, "not claimed: %s",
                      own->count > 0 ? own->claim[0].sentence : "nothing to look at");
    else
        paragraph_say(to, INDENT, INDENT, "%s (%d compared)", certificate_part_words(part),
                      claims_compared(own));
    write_claims(to, look, own, verbose);
}

/* "exact", "0.35 %", "3e-05 %". */
static void error_text(double error, char text[COLUMN + 8])
{
    const double percent = 100 * fabs(error);
    if (isnan(error))
        snprintf(text, COLUMN + 8, "-");
    else if (fabs(error) < 1e-9)
        snprintf(text, COLUMN + 8, "exact");
    else if (percent >= 999)
        snprintf(text, COLUMN + 8, "%.0e %%", percent);
    else
        snprintf(text, COLUMN + 8, percent < 1e-2 ? "%.0e %%" : "%.2g %%", percent);
}

static int nothing(const element_measure *one)
{
    for (int i = 0; i < one->points; i++)
        if (!isnan(one->error[i]))
            return 0;
    return 1;
}

static void write_measure(FILE *to, const element_measure *one, int verbose)
{
    const int at = fprintf(to, "    %-*s", MEASURE - 4, one->name);
    if (nothing(one)) {
        paragraph_write(to, at, at, one->words);
        return;
    }
    for (int i = 0; i < one->points; i++) {
        char text[COLUMN + 8];
        error_text(one->error[i], text);
        fprintf(to, " %*s", COLUMN - 1, text);
    }
    if (!isnan(one->order))
        fprintf(to, "  %.1f (%d-%d)", one->order, one->least, one->highest);
    fputs(one->locks ? "  locks\n" : "\n", to);
    if (verbose && !one->astray && one->words[0] != '\0')
        paragraph_write(to, fprintf(to, "      "), 6, one->words);
}

/* What is measured, below a line that says what the columns are. */
static void write_measures(FILE *to, screen look, const certificate *c, int part, int verbose)
{
    const certificate_part *own = &c->part[part];
    const element_measure *first = &own->measures.measure[0];
    fprintf(to, "  %-*s", MEASURE - 2, certificate_part_name(part));
    for (int i = 1; i < own->measures.count; i++)
        first = own->measures.measure[i].points > first->points ? &own->measures.measure[i] : first;
    for (int i = 0; i < first->points; i++)
        fprintf(to, part == CHECKS_FAMILIES + 1 ? " %*.0e" : " %*.0f", COLUMN - 1, first->at[i]);
    fprintf(to, "%s\n", part == CHECKS_FAMILIES + 2 ? "  order" : "");
    if (own->measures.count == 0 && own->claims.count == 1 && c->late != NULL)
        paragraph_write(to, fprintf(to, "    "), 4, own->claims.claim[0].sentence);
    for (int i = 0; i < own->measures.count; i++)
        write_measure(to, &own->measures.measure[i], verbose);
    if (own->measures.words[0] != '\0')
        paragraph_write(to, fprintf(to, "    "), 6, own->measures.words);
    for (int i = 0; i < own->measures.count && own->measures.words[0] == '\0'; i++)
        if (own->measures.measure[i].astray)
            paragraph_say(to, fprintf(to, "    "), 6, "%s: %s", own->measures.measure[i].name,
                          own->measures.measure[i].words);
    write_claims(to, look, &own->claims, verbose);
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
    const int astray = measures_astray(&c->part[CHECKS_FAMILIES].measures);
    if (astray > 0)
        fprintf(to, "measured: %d state%s with a wrong limit\n", astray, astray > 1 ? "s" : "");
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
    if (!quiet)
        fputs("measured: errors by numbers of elements (states: 4 of unequal lengths; orders), and "
              "by "
              "thickness\n",
              to);
    for (int i = CHECKS_FAMILIES; i < CERTIFICATE_PARTS; i++)
        if (!quiet)
            write_measures(to, look, c, i, verbose);
        else
            write_claims(to, look, &c->part[i].claims, verbose);
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
        else if (count == 1)
            fprintf(to, "%s: KEPT\n", all[i].chosen.key);
        broken += !certificate_holds(&all[i]);
        numbers += certificate_compared(&all[i]);
    }
    if (count > 1)
        fprintf(to, "%s%d of %d formulations keep the contract (%d numbers compared)\n",
                quiet ? "" : "\n", count - broken, count, numbers);
}
