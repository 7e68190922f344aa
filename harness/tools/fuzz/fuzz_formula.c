/* Uses the input as a formula of time, and its lines as the pieces of a function. A rejection must
 * have a position. An accepted formula must give the same bits in parentheses, and its derivatives
 * must be zero if it does not contain t. */
#include <math.h>

#include "cases/scene/scene.h"
#include "harness/tools/fuzz/fuzz.h"

static const double instant[] = {0, 1e-3, 0.5, 1, -2, 1e6};
enum { INSTANTS = sizeof instant / sizeof instant[0] };

static int same(const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++)
        if (a[k] != b[k] && !(isnan(a[k]) && isnan(b[k])))
            return 0;
    return 1;
}

static void check_read(const char *text, const formula *f)
{
    char *wrapped = malloc(strlen(text) + 3);
    formula *again = NULL;
    expression_mistake mistake;
    fuzz_must(wrapped != NULL, "there is memory");
    sprintf(wrapped, "(%s)", text);
    /* The additional parentheses may exceed the limit. */
    if (formula_parse(wrapped, &again, &mistake) == STATUS_OK)
        for (int i = 0; i < INSTANTS; i++) {
            double one[3], two[3];
            formula_at(f, instant[i], one);
            formula_at(again, instant[i], two);
            fuzz_must(same(one, two), "parentheses change nothing");
            fuzz_must(strchr(text, 't') != NULL || (one[1] == 0 && one[2] == 0),
                      "the derivatives of a constant are zero");
        }
    formula_free(again);
    free(wrapped);
}

static void check_formula(const char *text)
{
    formula *f = NULL;
    expression_mistake mistake = {-1, ""};
    const status outcome = formula_parse(text, &f, &mistake);
    fuzz_must((outcome == STATUS_OK) == (f != NULL), "read or refused");
    if (outcome == STATUS_OK)
        check_read(text, f);
    else
        fuzz_must(mistake.at >= 0 && mistake.at <= (int)strlen(text) && mistake.what[0] != '\0',
                  "a rejected formula has a position and a reason");
    formula_free(f);
}

static void check_pieces(char *text)
{
    scene_function all = {0, NULL, 0}, copy = {0, NULL, 0};
    fault f = {""};
    double until = 0, time, one[3], two[3];
    int derivative;
    for (char *line = strtok(text, "\n"); line != NULL; line = strtok(NULL, "\n"))
        fuzz_must(function_add(&all, until += 0.25, line) == 0, "there is memory");
    if (all.pieces > 0 && function_check(&all, &f) == STATUS_OK) {
        fuzz_must(function_copy(&copy, &all) == 0, "there is memory");
        for (int i = 0; i < INSTANTS; i++) {
            function_at(&all, instant[i], one);
            function_at(&copy, instant[i], two);
            fuzz_must(same(one, two), "a copy is the same");
        }
        fuzz_must(function_finite(&all, 2, 2, &time) || (time >= 0 && time <= 2),
                  "a function that is not finite has a time at which it is not");
        fuzz_must(function_smooth(&all, 2, &time, &derivative) || derivative < 2, "what jumps");
    }
    function_free(&copy);
    function_free(&all);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = fuzz_text(data, size);
    check_formula(text);
    check_pieces(text);
    free(text);
    return 0;
}
