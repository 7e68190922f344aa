#include "harness/study/narrow.h"

#include <stdlib.h>

#include "elements/shared/choice.h"
#include "harness/formulations/formulations.h"
#include "harness/study/plan.h"

/* Which are kept: of the point's quantities and of the series. */
typedef struct kept {
    char *quantity, *series;
} kept;

static void mark(const sweep *s, const char *select, select_words *words, kept *out)
{
    const sweep_point *p = &s->point[0];
    char text[SWEEP_TEXT];
    for (int i = 0; i < s->seriess; i++)
        for (int q = 0; q < p->scene.quantities; q++) {
            sweep_text(p, &s->series[i].formulation, p->scene.quantity[q].name, text);
            select_meet(select, text, words);
            if (select_matches(select, text) == 1)
                out->quantity[q] = out->series[i] = 1;
        }
}

static void drop(sweep *s, const kept *k)
{
    scene *wanted = &s->point[0].scene;
    int quantities = 0, seriess = 0;
    for (int q = 0; q < wanted->quantities; q++) /* with what their curves are over */
        if (k->quantity[q] && scene_abscissa_of(wanted, &wanted->quantity[q]) != SCENE_NONE)
            k->quantity[scene_abscissa_of(wanted, &wanted->quantity[q])] = 1;
    for (int q = 0; q < wanted->quantities; q++)
        if (k->quantity[q])
            wanted->quantity[quantities++] = wanted->quantity[q];
    for (int i = 0; i < s->seriess; i++)
        if (k->series[i])
            s->series[seriess++] = s->series[i];
        else
            sweep_series_free(&s->series[i]);
    wanted->quantities = quantities;
    s->seriess = seriess;
}

static const char *quantity_at(const void *context, int i)
{
    const scene *s = context;
    return i < s->quantities ? s->quantity[i].name : NULL;
}

/* The nearest of the point's quantities, else of the names that there are. */
static status check_words(const sweep *s, const char *select, const select_words *words, fault *f)
{
    const sweep_point *p = &s->point[0];
    char word[SELECT_WORD];
    if (!select_unmet(select, words, word))
        return STATUS_OK;
    const char *near = choice_nearest(word, quantity_at, &p->scene);
    if (near == NULL)
        return select_all_met(select, words, f);
    return fault_set(f, STATUS_REFUSED,
                     "selection '%.60s': nothing is called '%.60s', did you mean '%s'?; 'beamwork "
                     "list %.60s' shows names",
                     select, word, near, p->type->name);
}

static status narrow(sweep *s, const char *select, kept *k, fault *f)
{
    select_words words;
    TRY(select_begin(select, &words, f));
    mark(s, select, &words, k);
    TRY(check_words(s, select, &words, f));
    drop(s, k);
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].without.what != 0) {
            plan_omissions(s, s->series[i].point);
            break; /* there is one point */
        }
    return s->seriess > 0 ? STATUS_OK
                          : fault_set(f, STATUS_REFUSED,
                                      "-k '%.100s' holds for no quantity of %.60s; 'beamwork list "
                                      "%.60s' shows them",
                                      select, s->point[0].type->name, s->point[0].type->name);
}

status narrow_to(sweep *s, const char *select, fault *f)
{
    if (select == NULL)
        return STATUS_OK;
    kept k = {.quantity = calloc((size_t)s->point[0].scene.quantities + 1, 1),
              .series = calloc((size_t)s->seriess + 1, 1)};
    const status outcome = k.quantity != NULL && k.series != NULL
                               ? narrow(s, select, &k, f)
                               : fault_set(f, STATUS_FAULT, "out of memory for a selection");
    free(k.quantity);
    free(k.series);
    return outcome;
}

status narrow_scene(scene *s, const case_type *type, const double parameter[],
                    const formulation *chosen, const char *select, fault *f)
{
    fault unmet = {""};
    sweep_point p = {.type = type, .scene = *s};
    series one = {.formulation = *chosen};
    sweep whole = {.points = 1, .seriess = 1, .point = &p, .series = &one};
    parameters_text(type, parameter, p.text, sizeof p.text);
    const status outcome = narrow_to(&whole, select, chosen->type != NULL ? f : &unmet);
    if (outcome == STATUS_OK)
        s->quantities = p.scene.quantities;
    return outcome == STATUS_REFUSED && chosen->type == NULL ? STATUS_OK : outcome;
}
