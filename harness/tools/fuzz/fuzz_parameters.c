/* Uses the input as parameters of a reference value or of --set: "CASE NUMBER", then
 * "name=value;...". Reading the text of an accepted point must give the same point, and its scene
 * must be built or rejected. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/tools/fuzz/fuzz.h"

static void build(const case_type *type, const double value[])
{
    scene s;
    fault f = {""};
    scene_init(&s, type->name);
    if (case_build(type, value, &s, &f) == STATUS_OK)
        scene_validate(&s, &f);
    scene_free(&s);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    double value[CASE_MAX_PARAMETERS] = {0}, again[CASE_MAX_PARAMETERS] = {0};
    int any[CASE_MAX_PARAMETERS] = {0}, cases = 0;
    char written[PARAMETERS_TEXT];
    fault f = {""};
    if (size < 1)
        return 0;
    while (registry_cases[cases] != NULL)
        cases++;
    const case_type *type = registry_cases[data[0] % cases];
    char *text = fuzz_text(data + 1, size - 1);
    const status outcome = parameters_parse(type, text, value, any, &f);
    fuzz_must((outcome == STATUS_OK) == (f.text[0] == '\0'), "only a rejection has a reason");
    if (outcome == STATUS_OK) {
        parameters_text(type, value, written, sizeof written);
        const status same = parameters_parse(type, written, again, NULL, &f);
        fuzz_must(same == STATUS_OK && memcmp(value, again, sizeof value) == 0,
                  "the text of a point gives the same point");
        fuzz_must(parameters_hash(type, value, NULL) == parameters_hash(type, again, NULL),
                  "and has its hash");
        build(type, value);
    }
    parameters_default(type, value);
    if (parameters_set(type, text, value, &f) == STATUS_OK)
        build(type, value);
    free(text);
    return 0;
}
