#include "harness/terminal/table_cheapest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/study/study.h"
#include "harness/terminal/paragraph.h"

static const rounds_reading *time_of(const sweep *s, const reached *r)
{
    return &s->series[r->series].timing[r->mesh].as_is;
}

static void way(FILE *to, const sweep *s, const reached *r)
{
    const series *one = &s->series[r->series];
    fprintf(to, "%s, n = %d", one->formulation.key, one->mesh[r->mesh]);
    if (time_of(s, r)->rounds > 0)
        fprintf(to, ", %.4g ms", 1e3 * rounds_least(time_of(s, r)));
    if (!isfinite(r->cost))
        fprintf(to, " (%s: no rank)", reach_unranked(one->formulation.type));
}

/* Behind those that pass: which of the others was faster in every round all the same. */
static void faster_ones(FILE *to, const sweep *s, const reached list[], int count, int ties)
{
    int told = 0;
    for (int i = ties; i < count && list[i].defect == NULL; i++)
        if (isfinite(list[i].cost) &&
            rounds_compare(time_of(s, &list[i]), time_of(s, &list[0])) < 0) {
            fputs(told++ > 0 ? "; " : "; more expensive by its counts, faster in every round: ",
                  to);
            way(to, s, &list[i]);
        }
}

/* Where none passes: those that are within the error, the ones of the same defect together. */
static void defective_ones(FILE *to, const sweep *s, const reached list[], int count)
{
    for (int i = 0; i < count; i++) {
        int told = 0;
        const char *words = reach_defect_words(list[i].defect->kind);
        for (int k = 0; k < i; k++)
            told |= strcmp(words, reach_defect_words(list[k].defect->kind)) == 0;
        for (int k = told ? count : i; k < count; k++)
            if (strcmp(words, reach_defect_words(list[k].defect->kind)) == 0) {
                if (k > i)
                    fputs("; ", to);
                else
                    fprintf(to, "; also within it, %s: ", words);
                way(to, s, &list[k]);
            }
    }
}

/* Behind those that rank: those that pass and do not. Returns how many pass. */
static int unranked_ones(FILE *to, const sweep *s, const reached list[], int count)
{
    int i = 0, told = 0;
    for (; i < count && list[i].defect == NULL; i++)
        if (!isfinite(list[i].cost)) {
            fputs(told++ > 0 ? "; " : "; also within it: ", to);
            way(to, s, &list[i]);
        }
    return i;
}

/* The cheapest by counted work among the formulations of a point, and those within its noise. A
 * text that the caller frees; NULL: out of memory. */
static char *cheapest(const reach_question *q, reached list[])
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    if (to == NULL)
        return NULL;
    const int count = reach_ranking(q, list), ties = reach_ties(list, count);
    for (int i = 0; i < ties; i++) {
        fputs(i > 0 ? "; " : "", to);
        way(to, q->s, &list[i]);
    }
    if (ties > 0) {
        fputs(ties > 1 ? ": within noise of each other" : "", to);
        faster_ones(to, q->s, list, count, ties);
        unranked_ones(to, q->s, list, count);
    } else {
        const int passes = count > 0 && list[0].defect == NULL;
        fputs(passes ? "none that ranks" : count > 0 ? "none that passes" : "none", to);
        const int sound = unranked_ones(to, q->s, list, count);
        defective_ones(to, q->s, list + sound, count - sound);
    }
    fclose(to);
    return text;
}

static int has_truth(const sweep *s, const judgement *j, int at, int quantity)
{
    for (int i = 0; i < j->verdicts; i++)
        if (s->series[j->verdict[i].series].point == at && j->verdict[i].quantity == quantity &&
            j->verdict[i].truth != NULL)
            return 1;
    return 0;
}

/* What is cheapest for a quantity at every level. */
typedef struct cheapest_answer {
    int quantity, told; /* 1: its lines are written */
    char *text[REACH_LEVELS];
} cheapest_answer;

static int same_text(const char *a, const char *b)
{
    return a != NULL && b != NULL && strcmp(a, b) == 0;
}

static int same_answer(const cheapest_answer *a, const cheapest_answer *b)
{
    int same = 1;
    for (int i = 0; i < REACH_LEVELS; i++)
        same &= same_text(a->text[i], b->text[i]);
    return same;
}

/* "u_x, F_y within 10, 1 %: collocation, n = 1": a line for the quantities whose answers are those
 * of the first, and in it neighbouring levels that say the same. */
static void write_together(FILE *out, const scene *here, cheapest_answer a[], int count)
{
    for (int level = 0, next; level < REACH_LEVELS; level = next) {
        paragraph words;
        FILE *to = paragraph_begin(&words, out);
        const char *before = "";
        for (int i = 0; i < count; i++)
            if (i == 0 || same_answer(&a[i], &a[0])) {
                a[i].told = 1;
                fprintf(to, "%s%s", before, here->quantity[a[i].quantity].name);
                before = ", ";
            }
        before = " within ";
        for (next = level;
             next == level || (next < REACH_LEVELS && same_text(a->text[next], a->text[level]));
             before = ", ")
            fprintf(to, "%s%g", before, 100 * reach_level[next++]);
        fprintf(to, " %%: %s", a->text[level] != NULL ? a->text[level] : "out of memory");
        paragraph_end(&words, 0, 2);
    }
}

int table_cheapest(FILE *to, const sweep *s, const judgement *j, int at, int every, reached list[])
{
    const scene *here = &s->point[at].scene;
    cheapest_answer *a = calloc((size_t)here->quantities + 1, sizeof *a);
    int count = 0;
    for (int q = 0; a != NULL && q < here->quantities && (every || count == 0); q++) {
        if (!has_truth(s, j, at, q))
            continue;
        a[count].quantity = q;
        for (int level = 0; level < REACH_LEVELS; level++) {
            const reach_question asked = {s, j->verdict, j->verdicts, at, q, reach_level[level]};
            a[count].text[level] = cheapest(&asked, list);
        }
        count++;
    }
    for (int i = 0; i < count; i++)
        if (!a[i].told)
            write_together(to, here, &a[i], count - i);
    for (int i = 0; i < count * REACH_LEVELS; i++)
        free(a[i / REACH_LEVELS].text[i % REACH_LEVELS]);
    free(a);
    return count;
}
