#include "harness/experiments/outcome.h"

static const char *const names[OUTCOME_KINDS] = {"value",         "coarse",   "wrong",
                                                 "not converged", "singular", "refused",
                                                 "no value",      "fault",    "skip"};

const char *outcome_name(outcome_kind kind)
{
    return kind >= 0 && kind < OUTCOME_KINDS ? names[kind] : "?";
}

int outcome_is_good(outcome_kind kind)
{
    return kind == OUTCOME_VALUE || kind == OUTCOME_COARSE;
}
