#include "harness/terminal/table_stability.h"

#include <string.h>

#include "cases/scene/names.h"
#include "harness/terminal/paragraph.h"

enum { MOST_RUNS = 6, WORDS = 400 };

const char *table_stability_word(step_stability which)
{
    static const char *const word[STEP_STABILITIES] = {"?", "?", "yes", "no", "no", "held"};
    return word[which];
}

static const char *const words_of[] = {[STEP_OPEN] = "not decided by pivots",
                                       [STEP_NO_DIVERGENCE] = "no divergence",
                                       [STEP_STABLE] = "stable",
                                       [STEP_UNSTABLE] = "unstable",
                                       [STEP_GROWS] = "unstable",
                                       [STEP_HELD] = "stable without damping"};

/* Appends as far as there is room. */
static void add(char *text, const char *word)
{
    const size_t used = strlen(text);
    snprintf(text + used, WORDS - used, "%s", word);
}

/* Steps `first` to `last` of a path are alike; `end`: they are its last. */
static void add_run(const solve_result *r, int first, int last, int begin, int end, char *text)
{
    const step_record *a = &r->step[first], *b = &r->step[last];
    char run[160];
    if (begin && end)
        snprintf(run, sizeof run, "%s all along", words_of[a->stability]);
    else if (begin)
        snprintf(run, sizeof run, "%s up to %.6g", words_of[a->stability], b->path);
    else if (end)
        snprintf(run, sizeof run, ", %s from %.6g", words_of[a->stability], a->path);
    else if (first == last)
        snprintf(run, sizeof run, ", %s at %.6g", words_of[a->stability], a->path);
    else
        snprintf(run, sizeof run, ", %s %.6g to %.6g", words_of[a->stability], a->path, b->path);
    add(text, run);
}

/* "stable up to 1.35, unstable 1.4 to 1.6, stable from 1.65"; "" where it is stable all along, or
 * says nothing. */
static void words_of_path(const solve_result *r, int analysis, char text[WORDS])
{
    int begin = -1, last = -1, runs = 0, told = 0;
    text[0] = '\0';
    for (int i = 0; i < r->steps; i++)
        if (r->step[i].analysis == analysis) {
            begin = begin < 0 ? i : begin;
            last = i;
            told |= r->step[i].stability != STEP_STABLE &&
                    (r->step[i].negative_pivots > 0 || r->step[i].stability != STEP_OPEN);
        }
    for (int i = begin; told && i >= 0 && i <= last; runs++) {
        int end = i;
        while (end < last && r->step[end + 1].stability == r->step[i].stability)
            end++;
        if (runs < MOST_RUNS)
            add_run(r, i, end, i == begin, end == last, text);
        else if (runs == MOST_RUNS)
            add(text, ", and so on");
        i = end + 1;
    }
}

int table_stability_paths(FILE *to, const scene *s, const solve_result *r)
{
    int lines = 0;
    for (int i = 0; i < s->analyses; i++) {
        char words[WORDS];
        words_of_path(r, i, words);
        if (words[0] == '\0')
            continue;
        const int column = fprintf(to, "%s: ", scene_called(s, SCENE_ANALYSES, i).text);
        paragraph_say(to, column, 2, "%s (%s)", words,
                      s->analysis[i].kind == SCENE_CONTINUATION ? "load factor" : "path");
        lines++;
    }
    return lines;
}

static int met_unstable(const solve_result *r)
{
    for (int i = 0; i < r->steps; i++)
        if (result_is_unstable(r->step[i].stability))
            return 1;
    return 0;
}

void table_stability_meshes(FILE *to, const sweep *s)
{
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const scene *what = &s->point[one->point].scene;
        int unstable = 0;
        for (int k = 0; k < one->meshes && one->missing[0] == '\0'; k++)
            unstable += met_unstable(&one->cell[k].solve);
        if (unstable == 0)
            continue;
        fprintf(to, "\n%s met unstable states:\n", one->formulation.key);
        for (int k = 0; k < one->meshes; k++) {
            const solve_result *r = &one->cell[k].solve;
            const int column = fprintf(to, "  n = %d: ", one->mesh[k]);
            char words[WORDS] = "";
            for (int a = 0; a < what->analyses && words[0] == '\0'; a++)
                words_of_path(r, a, words);
            paragraph_say(to, column, 4, "%s%s%s", words[0] != '\0' ? words : "stable all along",
                          r->status != STATUS_OK ? "; " : "",
                          r->status != STATUS_OK ? r->reason : "");
        }
    }
}
