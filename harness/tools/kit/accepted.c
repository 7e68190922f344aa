#include "harness/tools/kit/accepted.h"

#include <gsl/gsl_test.h>
#include <stdio.h>
#include <stdlib.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

static void read_table(void)
{
    const char *path = getenv("BEAMWORK_TRUTHS");
    truths t;
    fault f = {""};
    const status outcome = truths_read_rules(path != NULL ? path : "build/truths.h5", &t, &f);
    gsl_test(outcome != STATUS_OK, "the accepted formulations cannot be read: %s", f.text);
    if (outcome == STATUS_OK)
        truths_free(&t);
    for (int i = 0; formulations_at(i) != NULL; i++)
        if (formulations_is_new(formulations_at(i)))
            printf("%s is new, so its results are not tested here\n", formulations_at(i)->name);
}

const element_type *accepted_at(int i)
{
    static int is_read;
    if (!is_read)
        read_table();
    is_read = 1;
    for (int k = 0; formulations_at(k) != NULL; k++)
        if (!formulations_is_new(formulations_at(k)) && i-- == 0)
            return formulations_at(k);
    return NULL;
}
