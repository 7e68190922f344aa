#include "cases/scene/scene_impl.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

int scene_add_case(scene *s, const char *name)
{
    const int i = scene_grow(s, &s->load_case, &s->cases, sizeof *s->load_case);
    if (i >= 0)
        snprintf(s->load_case[i].name, SCENE_NAME, "%s", name);
    return i;
}

int scene_add_combination(scene *s, const char *name)
{
    const int i = scene_grow(s, &s->combination, &s->combinations, sizeof *s->combination);
    if (i >= 0)
        snprintf(s->combination[i].name, SCENE_NAME, "%s", name);
    return i;
}

void scene_add_term(scene *s, int combination, int load_case, double factor)
{
    if (combination < 0)
        return;
    scene_combination *c = &s->combination[combination];
    const int i = scene_grow(s, &c->term, &c->terms, sizeof *c->term);
    if (i >= 0)
        c->term[i] = (scene_term){load_case, factor};
}

/* Returns the one-based index of the active combination or load case; 0: there are no load cases.
 * Combinations come first. */
static int scene_acting_number(const scene *s, scene_acting what)
{
    if (what.combination != SCENE_NONE)
        return 1 + what.combination;
    return what.load_case != SCENE_NONE ? 1 + s->combinations + what.load_case : 0;
}

int scene_acting_of(const scene *s, int analysis)
{
    const scene_analysis *a = &s->analysis[analysis];
    return a->follows != SCENE_NONE ? scene_acting_of(s, a->follows)
                                    : scene_acting_number(s, a->acting);
}

int scene_solves_all(const scene *s, int analysis)
{
    return s->cases > 0 && s->analysis[analysis].kind == SCENE_LINEAR &&
           scene_acting_of(s, analysis) == 0;
}

int scene_acting_in(const scene *s, const scene_quantity *q, int i)
{
    if (q->envelope == SCENE_ENVELOPE_NONE)
        return i == 0 ? scene_acting_number(s, q->acting) : 0;
    if (q->overs > 0)
        return i < q->overs ? 1 + q->over[i] : 0;
    return i < (s->combinations > 0 ? s->combinations : s->cases) ? 1 + i : 0;
}

double scene_acting_factor(const scene *s, int number, int load_case)
{
    if (number == 0 || load_case == SCENE_NONE)
        return 1;
    if (number > s->combinations)
        return number - 1 - s->combinations == load_case;
    const scene_combination *c = &s->combination[number - 1];
    for (int i = 0; i < c->terms; i++)
        if (c->term[i].load_case == load_case)
            return c->term[i].factor;
    return 0;
}

scene_words scene_acting_called(const scene *s, int number)
{
    if (number == 0)
        return (scene_words){""};
    return number > s->combinations ? scene_called(s, SCENE_CASES, number - 1 - s->combinations)
                                    : scene_called(s, SCENE_COMBINATIONS, number - 1);
}

static status check_loads(const scene *s, fault *f)
{
    for (int i = 0; i < s->loads; i++)
        if (s->cases > 0 && s->load[i].load_case == SCENE_NONE)
            return fault_set(
                f, STATUS_REFUSED,
                "%s: this load has no load case, but other loads or motions have one; add "
                "a case, such as case: %s",
                scene_called(s, SCENE_LOADS, i).text, s->load_case[0].name);
    for (int i = 0; i < s->drivers; i++)
        if (s->driver[i].value == NULL && s->driver[i].load_case != SCENE_NONE)
            return fault_set(
                f, STATUS_REFUSED,
                "motion %s: its value is unknown and follows from the loads; remove its case",
                s->driver[i].name);
    return STATUS_OK;
}

static status check_combination(const scene *s, int i, fault *f)
{
    const scene_combination *c = &s->combination[i];
    const scene_words owner_name = scene_called(s, SCENE_COMBINATIONS, i);
    if (c->terms == 0)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: it contains no load case of this scene; give {CASE: FACTOR}, or the 'if' "
            "conditions of the loads",
            owner_name.text);
    for (int k = 0; k < s->cases; k++)
        if (strcmp(s->load_case[k].name, c->name) == 0)
            return fault_set(f, STATUS_REFUSED,
                             "%s: a load case has the same name; rename one of them",
                             owner_name.text);
    for (int k = 0; k < c->terms; k++) {
        if (c->term[k].load_case < 0 || c->term[k].load_case >= s->cases ||
            !isfinite(c->term[k].factor))
            return fault_set(f, STATUS_REFUSED,
                             "%s: term %d is not a load case with a finite factor; name a load "
                             "case and give a finite factor",
                             owner_name.text, k);
        for (int j = 0; j < k; j++)
            if (c->term[j].load_case == c->term[k].load_case)
                return fault_set(
                    f, STATUS_REFUSED,
                    "%s: load case %s is listed twice; list it once, with the sum of the factors",
                    owner_name.text, s->load_case[c->term[k].load_case].name);
    }
    return STATUS_OK;
}

status scene_validate_cases(const scene *s, fault *f)
{
    TRY(check_loads(s, f));
    for (int i = 0; i < s->combinations; i++)
        TRY(check_combination(s, i, f));
    return STATUS_OK;
}

static scene_words example(const scene *s)
{
    scene_words out;
    if (s->combinations > 0)
        snprintf(out.text, sizeof out.text, "combination: %s", s->combination[0].name);
    else
        snprintf(out.text, sizeof out.text, "case: %s", s->load_case[0].name);
    return out;
}

status scene_validate_acting(const scene *s, int i, fault *f)
{
    const scene_analysis *a = &s->analysis[i];
    const int own = scene_acting_number(s, a->acting), loaded = a->kind != SCENE_MODAL &&
                                                                a->kind != SCENE_COMPLIANCE &&
                                                                a->kind != SCENE_HARMONIC;
    if (own > 0 && a->follows != SCENE_NONE)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: its base state is that of %s, whose loads also act here; remove the key '%s'",
            scene_called(s, SCENE_ANALYSES, i).text,
            scene_called(s, SCENE_ANALYSES, a->follows).text,
            a->acting.combination != SCENE_NONE ? "combination" : "case");
    if (own > 0 && !loaded)
        return fault_set(f, STATUS_REFUSED,
                         "%s: no load acts in this analysis; name a base state with 'about', and "
                         "apply the loads in the analysis of that state",
                         scene_called(s, SCENE_ANALYSES, i).text);
    if (a->follows != SCENE_NONE && scene_solves_all(s, a->follows))
        return fault_set(f, STATUS_REFUSED,
                         "%s: its base state is that of %s, which solves every load case and "
                         "combination; in that analysis, select one with %s",
                         scene_called(s, SCENE_ANALYSES, i).text,
                         scene_called(s, SCENE_ANALYSES, a->follows).text, example(s).text);
    if (s->cases == 0 || own > 0 || !loaded || a->follows != SCENE_NONE || scene_solves_all(s, i))
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "%s: the loads have cases, but this analysis does not select one; add %s%s",
                     scene_called(s, SCENE_ANALYSES, i).text, example(s).text,
                     s->combinations > 0 ? "" : ", or combinations: {all: {CASE: 1, CASE: 1}}");
}

status scene_validate_case_of(const scene *s, const scene_quantity *q, fault *f)
{
    if (q->what.kind == SCENE_ENVELOPE_OF)
        return STATUS_OK;
    const int all = scene_solves_all(s, q->analysis),
              has_envelope =
                  q->envelope != SCENE_ENVELOPE_NONE || scene_acting_number(s, q->acting) > 0;
    const scene_words of = scene_called(s, SCENE_ANALYSES, q->analysis);
    if (all && !has_envelope)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: %s solves every load case and combination; select one with "
                         "%s, or request an envelope: max, min or largest",
                         q->name, of.text, example(s).text);
    if (!all && has_envelope && scene_acting_of(s, q->analysis) == 0)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: %s has no load cases or combinations; remove 'case', "
                         "'combination' and 'envelope'",
                         q->name, of.text);
    if (!all && has_envelope)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: %s is solved only for %s; remove 'case', 'combination' and "
                         "'envelope', or name a linear analysis that selects no load case",
                         q->name, of.text,
                         scene_acting_called(s, scene_acting_of(s, q->analysis)).text);
    for (int i = 0; i < q->overs; i++)
        if (q->over[i] < 0 || q->over[i] >= s->combinations)
            return fault_set(f, STATUS_REFUSED,
                             "quantity %s: combination %d does not exist; add it first", q->name,
                             q->over[i]);
    return STATUS_OK;
}
