#include "harness/experiments/runs_on.h"

#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/study/study.h"

static void look_at(const scene *s, const element_type *type, runs_on *out)
{
    const unsigned omits = missing_omits(s, type);
    *out = (runs_on){.name = type->name};
    out->runs = !missing_refused(s, type, out->words, sizeof out->words);
    if (!out->runs)
        return;
    if (omits != 0)
        missing_omit_words(omits, out->words);
    else if (!lacks_of(s, type, out->words, sizeof out->words))
        out->words[0] = '\0';
}

void runs_on_scene(const scene *s, const element_type *type, runs_on *out)
{
    omission without;
    look_at(s, type, out);
    if (!out->runs || missing_omits(s, type) == 0)
        return;
    omission_of(s, type, &without);
    out->other = without.other;
}

int runs_on_cases(const element_type *type, runs_on out[], int room)
{
    int count = 0;
    for (; registry_cases[count] != NULL && count < room; count++) {
        const case_type *here = registry_cases[count];
        double value[CASE_MAX_PARAMETERS] = {0};
        scene s;
        parameters_default(here, value);
        out[count] = (runs_on){.runs = 0};
        if (cell_scene(here, value, NULL, &s, NULL) == STATUS_OK)
            look_at(&s, type, &out[count]);
        out[count].name = here->name;
        scene_free(&s);
    }
    return count;
}
