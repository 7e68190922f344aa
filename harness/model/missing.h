/* What a scene needs and a formulation does not offer: what it can run without, as another model,
 * and what it cannot. */
#ifndef BEAMWORK_MISSING_H
#define BEAMWORK_MISSING_H

#include "harness/model/model.h"

/* Physics that can be left out and are no feature of their own. */
enum {
    OMIT_SHEAR_Y = FEATURE_END,            /* shear flexibility along y */
    OMIT_SHEAR_COUPLING = FEATURE_END << 1 /* between its directions, and with warping */
};
enum { OMIT_WORDS = 200, OMIT_BITS = 16 }; /* length of their words; how many there are */

/* The needs that the type does not offer, or a limit it hits, in words, which are empty if and only
 * if there are none; 0: it has all that the scene needs. */
int missing_words(const scene *, const element_type *, char *words, int size);
/* Those of them without which nothing of the scene can be solved; 0: it can run. */
int missing_refused(const scene *, const element_type *, char *words, int size);
/* Those that it runs without: bits of FEATURE_* and OMIT_*. */
unsigned missing_omits(const scene *, const element_type *);
/* Such bits in words. */
void missing_omit_words(unsigned omits, char words[OMIT_WORDS]);
/* Takes out of a section what is left out and no element is asked for by a feature. */
void missing_omit(section *, unsigned omits);
/* The limit of the type that a section of so many closed cells hits, in words; NULL: none. */
const char *missing_in_section(const element_type *, const section *, int cells, int warps);

/* What the type offers in one direction only (element_lack) where the scene needs it, in words: 0:
 * nothing, 1: so little of it that it is shown and not refused, 2: missing_words says so too. */
int lacks_of(const scene *, const element_type *, char *words, int size);

#endif
