#include "harness/request/runs_on.h"

#include "harness/catalogue/parameters.h"
#include "harness/catalogue/registry.h"
#include "harness/model/lacks.h"
#include "harness/model/missing.h"
#include "harness/study/cell.h"

void runs_on_scene(const scene *s, const element_type *type, runs_on *out)
{
    *out = (runs_on){.name = type->name};
    out->runs = !missing_words(s, type, out->words, sizeof out->words);
    if (out->runs && !lacks_of(s, type, out->words, sizeof out->words))
        out->words[0] = '\0';
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
            runs_on_scene(&s, type, &out[count]);
        out[count].name = here->name;
        scene_free(&s);
    }
    return count;
}
