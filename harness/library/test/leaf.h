/* The text of a scene file, and checks of calls that must fail. */
#ifndef BEAMWORK_LEAF_H
#define BEAMWORK_LEAF_H

#include <gsl/gsl_test.h>
#include <stdio.h>
#include <string.h>

#include "harness/library/beamwork.h"

static const char leaf[] =
    "beamwork: 1\n"
    "sections:\n"
    "  leaf: {rectangle: {width: 50e-3, thickness: 0.5e-3}, young: 210e9, shear_modulus: 81e9}\n"
    "nodes:\n"
    "  base: {at: [0, 0, 0], hold: all}\n"
    "  tip:  {at: [0.1, 0, 0]}\n"
    "members:\n"
    "  leaf: {from: base, to: tip, section: leaf, y: [0, 1, 0]}\n"
    "loads:\n"
    "  push: {force: [0, 1, 0], on: tip}\n";

static inline void leaf_fails(bw_status got, bw_status expected, char *why, const char *word)
{
    const int reported = why != NULL && strstr(why, word) != NULL;
    gsl_test(got != expected || !reported, "%s: '%s'", bw_status_name(expected), word);
    if (!reported)
        fprintf(stderr, "%s: %s\n", bw_status_name(got), why != NULL ? why : "");
    bw_free_text(why);
}

static inline void leaf_is_well(bw_status got, char *why, const char *what)
{
    gsl_test(got != BW_OK || why != NULL, "%s: %s %s", what, bw_status_name(got),
             why != NULL ? why : "");
    bw_free_text(why);
}

/* Calls leaf_fails with the message in `why`. The call is evaluated before its message is read. */
#define FAILS(call, expected, word)                                                                \
    do {                                                                                           \
        const bw_status got_ = (call);                                                             \
        leaf_fails(got_, expected, why, word);                                                     \
    } while (0)
#define WELL(call, what)                                                                           \
    do {                                                                                           \
        const bw_status got_ = (call);                                                             \
        leaf_is_well(got_, why, what);                                                             \
    } while (0)

#endif
