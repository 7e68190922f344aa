/* The elements of a formulation that are looked at: with everything that it offers, of each section
 * that it takes, each choice of each option, straight and curved. */
#ifndef BEAMWORK_SPECIMENS_H
#define BEAMWORK_SPECIMENS_H

#include "harness/experiments/claims.h"
#include "harness/experiments/specimen.h"

typedef void specimens_check(const specimen *s, claims *c);
/* What is refused with a reason is passed over, but the usual one: that it can be made is a claim
 * ("prepare"). */
void specimens_each(const formulation *chosen, claims *c, specimens_check *check);

#endif
