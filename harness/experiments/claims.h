/* What was claimed of a formulation, how far it departs from what holds, and what to mend. Plain
 * data of one size: it can lie in memory that processes share. */
#ifndef BEAMWORK_CLAIMS_H
#define BEAMWORK_CLAIMS_H

enum { CLAIM_NAME = 64, CLAIM_SENTENCE = 400, CLAIMS_MOST = 48 };

typedef enum claim_outcome {
    CLAIM_HOLDS,
    CLAIM_BROKEN,
    CLAIM_NOT_CLAIMED, /* the type does not say so, or leaves it to others: sentence says why */
    CLAIM_OUTCOMES
} claim_outcome;

typedef struct claim {
    char name[CLAIM_NAME];
    claim_outcome outcome;
    int compared;                  /* numbers, or questions of yes and no */
    double worst, allowed;         /* largest departure, dimensionless; INFINITY: a question's no */
    char sentence[CLAIM_SENTENCE]; /* of the worst departure that is not allowed */
} claim;

/* Of one family of checks. */
typedef struct claims {
    int count;
    claim claim[CLAIMS_MOST];
    char doing[CLAIM_SENTENCE]; /* what is called now: for what does not come back */
    int complete;               /* 1: all was looked at */
} claims;

/* The claim of that name; a new one holds until something departs. */
claim *claims_open(claims *c, const char *name, double allowed);
/* The type makes no such claim, and why. */
void claims_not_made(claims *c, const char *name, const char *why);
/* One more comparison; what is not a number departs most. */
void claims_departs(claim *one, double departure, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* One more question: the sentence says what is wrong where it does not hold. */
void claims_asks(claim *one, int holds, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* What comes now. */
void claims_doing(claims *c, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* How far apart two numbers are of their size; two that are equal are not, also where both are 0.
 */
static inline double claims_share(double apart, double size)
{
    return apart == 0 ? 0 : apart / size;
}
/* How many of them came out so, and how many comparisons they stand on. */
int claims_counted(const claims *c, claim_outcome outcome);
int claims_compared(const claims *c);

#endif
