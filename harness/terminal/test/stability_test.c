/* Where a path is stable, in words: runs of steps, of several analyses. */
#include <gsl/gsl_test.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/terminal/terminal_impl.h"

enum { STABILITY_MOST = 16 };

/* A letter for each step: o open, d no divergence, s stable, u unstable, h held; paths 0.5, 1, ...
 */
static void is(const char *letters, scene_analysis_kind kind, const char *expected)
{
    static const char letter[] = "odsugh";
    step_record step[STABILITY_MOST];
    scene_analysis analysis[2] = {{.kind = SCENE_LINEAR}, {.kind = kind}};
    const scene s = {.analyses = 2, .analysis = analysis};
    const int steps = (int)strlen(letters);
    char *text = NULL;
    size_t size = 0;
    memset(step, 0, sizeof step);
    for (int i = 0; i < steps; i++) {
        step[i].analysis = 1;
        step[i].path = 0.5 * (i + 1);
        step[i].stability = (step_stability)(strchr(letter, letters[i]) - letter);
        step[i].negative_pivots = letters[i] == 'u';
    }
    const solve_result r = {.steps = steps, .step = step};
    FILE *to = open_memstream(&text, &size);
    const int lines = table_stability_paths(to, &s, &r);
    fclose(to);
    gsl_test_int(lines, expected[0] != '\0', "%s: lines", letters);
    gsl_test_str(text, expected, "%s", letters);
    free(text);
}

int main(void)
{
    is("", SCENE_STATIC, "");
    is("ssss", SCENE_STATIC, "");
    is("oooo", SCENE_STATIC, "");
    is("uuu", SCENE_STATIC, "analysis 1: unstable all along (path)\n");
    is("dd", SCENE_STATIC, "analysis 1: no divergence all along (path)\n");
    is("ssus", SCENE_STATIC, "analysis 1: stable up to 1, unstable at 1.5, stable from 2 (path)\n");
    is("suuso", SCENE_CONTINUATION,
       "analysis 1: stable up to 0.5, unstable 1 to 1.5, stable at 2, not decided by pivots from "
       "2.5 (load\n  factor)\n");
    is("hg", SCENE_STATIC,
       "analysis 1: stable without damping up to 0.5, unstable from 1 (path)\n");
    is("sususus", SCENE_STATIC,
       "analysis 1: stable up to 0.5, unstable at 1, stable at 1.5, unstable at 2, stable at 2.5, "
       "unstable\n  at 3, and so on (path)\n");
    return gsl_test_summary();
}
