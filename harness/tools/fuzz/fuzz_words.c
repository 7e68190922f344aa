/* Uses the input as words of a command line that have a grammar: formulations with options,
 * selections, thresholds. */
#include "harness/formulations/formulations.h"
#include "harness/records/records.h"
#include "harness/study/study.h"
#include "harness/tools/fuzz/fuzz.h"

static void read_formulation(const char *text)
{
    formulation one, again;
    fault f = {""};
    if (formulation_parse(text, &one, &f) != STATUS_OK) {
        fuzz_must(f.text[0] != '\0', "a rejection has a reason");
        return;
    }
    fuzz_must(formulation_parse(one.key, &again, &f) == STATUS_OK &&
                  strcmp(one.key, again.key) == 0,
              "a key gives the same formulation");
    fuzz_must(memcmp(one.option, again.option, sizeof one.option) == 0, "with its options");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 1)
        return 0;
    char *text = fuzz_text(data + 1, size - 1);
    comparison_limits limits = comparison_limits_default;
    fault f = {""};
    switch (data[0] % 3) {
    case 0:
        read_formulation(text);
        break;
    case 1: {
        const int here = select_matches(text, "c_column/default/beamw/buckling_load");
        fuzz_must(here >= -1 && here <= 1 && (here < 0) == (select_matches(text, "") < 0),
                  "whether an expression is malformed does not depend on the text");
        break;
    }
    default:
        if (comparison_limits_parse(text, &limits, &f) == STATUS_OK)
            fuzz_must(limits.error >= 0 && limits.floor >= 0 && limits.work >= 0,
                      "thresholds are not negative");
    }
    free(text);
    return 0;
}
