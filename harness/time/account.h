/* What is missing in the balance of a motion's energy, against what the motion has of it. */
#ifndef BEAMWORK_ACCOUNT_H
#define BEAMWORK_ACCOUNT_H

#include "cases/scene/quantity.h"
#include "elements/shared/status.h"
#include "harness/time/scheme.h"

/* Parts of account_size: energy from nothing that ends a motion; energy lost that is stated, and
 * that ends a motion unless the scene asks for it. */
enum { ACCOUNT_STEPS = 10 }; /* at the begin: the motion has hardly any energy to be measured by */
extern const double account_gained, account_stated, account_lost;

typedef struct account {
    double largest; /* [J] energy so far */
    double turned;  /* [J] sum of the work of all steps, whatever their signs */
    double work;    /* [J] at the last one */
} account;

/* Of the begin (steps 0) and of all steps, in their order. */
void account_take(account *, int steps, const double balance[SCENE_BALANCES]);
/* The largest energy so far, or all the work so far, if that is larger [J]. */
double account_size(const account *);
/* [J] what may be missing: a part of that, and rounding. */
double account_most(const account *, double part, double rounding);

/* Is energy lost on purpose: by alpha with a spectral radius below 0.9, or by steps that the scene
 * prescribes? */
int account_loses(const scene_motion *);

/* NOT_CONVERGED: more energy than account_gained has come from nothing, or more than account_lost
 * was lost, which nobody asked for. rounding [J]: see balance_rounding. */
status account_judge(const account *, const scene_motion *, double time,
                     const double balance[SCENE_BALANCES], double rounding, fault *);

#endif
