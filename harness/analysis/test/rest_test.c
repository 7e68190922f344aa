/* Without loads, drives and initial strains, displacements and forces must be zero within `still`
 * and `unstressed`: in every case, with every formulation and its evaluated options. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/analysis/test/moves.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/study/study.h"

enum { COMPONENTS = 6, CHOICES = 64 };
/* Limits relative to the size of the structure (displacements), to 1 rad (rotations) and to the
 * largest EA (forces). They allow for round-off in the curvature of arcs. */
static const double still = 1e-10, unstressed = 1e-12;

enum { FORMULATIONS = 64 };

typedef struct rest_tally {
    int points, checked, not_offered;
    int of[FORMULATIONS];
} rest_tally;

static double dimension(const scene *s)
{
    double size = 0;
    for (int i = 0; i < s->members; i++)
        for (int k = 0; k < 3; k++)
            size = fmax(size, fabs(s->node[s->member[i].p].position[k] -
                                   s->node[s->member[i].q].position[k]));
    return size;
}

static double stiffest(const scene *s)
{
    double EA = 0;
    for (int i = 0; i < s->sections; i++) {
        section c;
        if (scene_constants(s, i, &c, NULL) == STATUS_OK)
            EA = fmax(EA, c.young * c.A);
    }
    return EA;
}

static void leave_alone(scene *s)
{
    for (int i = 0; i < s->loads; i++)
        memset(s->load[i].vector, 0, sizeof s->load[i].vector);
    for (int i = 0; i < s->drivers; i++)
        for (int k = 0; k < s->driver[i].stations; k++)
            if (s->driver[i].value != NULL)
                s->driver[i].value[k] = 0;
    for (int i = 0; i < s->members; i++)
        memset(s->member[i].strain, 0, sizeof s->member[i].strain);
    while (s->analyses > 0) {
        const scene_path *path = scene_path_of(&s->analysis[--s->analyses]);
        if (path != NULL)
            free(path->value);
    }
    s->quantities = 0;
}

static int carries(const scene_node *n, int component)
{
    if (n->attached != SCENE_NONE)
        return 0;
    return component < 3
               ? n->translation[component] != SCENE_FREE
               : n->rotation == SCENE_ROTATION_SPATIAL && n->angle[component - 3] != SCENE_FREE;
}

static void ask_for_all(scene *s)
{
    const double end = 1;
    const int path = scene_add_static(s, 1, &end, 1);
    for (int reaction = 0; reaction < 2; reaction++)
        for (int node = 0; node < s->nodes; node++)
            for (int c = 0; c < COMPONENTS; c++) {
                if (reaction && !carries(&s->node[node], c))
                    continue;
                char name[SCENE_NAME];
                snprintf(name, sizeof name, "%c%d_%d", reaction ? 'F' : 'u', c, node);
                scene_add_quantity(s, name, "1", path,
                                   reaction ? scene_reaction(node, c) : scene_coordinate(node, c));
            }
}

static double largest(const scene *s, const solve_result *r, const char **quantity_name)
{
    const double size = dimension(s), EA = stiffest(s);
    double worst = 0;
    for (int i = 0; i < s->quantities; i++) {
        const scene_quantity *q = &s->quantity[i];
        const int turns = scene_component_of(q)->component >= 3;
        const double limit = q->what.kind == SCENE_COORDINATE
                                 ? still * (turns ? 1 : size)
                                 : unstressed * EA * (turns ? size : 1);
        const double value =
            r->quantity[i].status == STATUS_OK ? fabs(r->quantity[i].value) / limit : INFINITY;
        if (!(value <= worst)) {
            worst = value;
            *quantity_name = q->name;
        }
    }
    return worst;
}

static void rests(const sweep_point *p, const formulation *chosen, int elements)
{
    const char *quantity_name = "nothing";
    scene s;
    model *m = NULL;
    solve_result r;
    fault f = {""};
    double worst = INFINITY;
    scene_init(&s, p->type->name);
    status outcome = case_build(p->type, p->parameter, &s, &f);
    leave_alone(&s);
    ask_for_all(&s);
    const model_request what = {&s, chosen->type, chosen->option, elements, 0, 0};
    if (outcome == STATUS_OK)
        outcome = model_alloc(&what, &m, &f);
    if (outcome == STATUS_OK) {
        outcome = solve_scene(&s, m, NULL, &r, &f);
        worst = outcome == STATUS_OK ? largest(&s, &r, &quantity_name) : INFINITY;
        if (outcome == STATUS_NOT_CONVERGED && chosen->type->limits & LIMIT_FLAT_ARC &&
            strstr(f.text, "radii of gyration") != NULL)
            worst = 0;
        result_free(&r);
    }
    gsl_test(!(worst <= 1), "%s/%s, %s, n = %d: at rest (%s: %.1e of its limit) %s", p->type->name,
             p->text[0] != '\0' ? p->text : "default", chosen->key, elements, quantity_name, worst,
             f.text);
    model_free(m);
    scene_free(&s);
}

static int choices_of(const element_type *type, formulation list[CHOICES])
{
    int count = 1;
    formulation_default(type, &list[0]);
    for (int k = 0; k < parameter_count(type->options); k++)
        for (int choice = 0;
             element_judged(type, k) != 0 &&
             choice < parameter_choices(parameter_at(type->options, k)) && count < CHOICES;
             choice++)
            count += formulation_choice(type, k, choice, &list[count]);
    return count;
}

static void every_formulation(const sweep_point *p, rest_tally *t)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        formulation list[CHOICES];
        char words[200];
        const int count = choices_of(registry_formulations[i], list);
        if (missing_words(&p->scene, registry_formulations[i], words, sizeof words)) {
            t->not_offered += count;
            continue;
        }
        gsl_test(i >= FORMULATIONS, "%d formulations", i + 1);
        t->of[i] += count;
        for (int k = 0; k < count; k++, t->checked++)
            for (int elements = 1; elements <= 2; elements++)
                rests(p, &list[k], elements);
    }
}

int main(void)
{
    const char *path =
        getenv("BEAMWORK_TRUTHS") != NULL ? getenv("BEAMWORK_TRUTHS") : "build/truths.h5";
    const sweep_request all = {0};
    truths known;
    sweep plan;
    fault f = {""};
    rest_tally t = {0};
    gsl_test(truths_read(path, &known, &f) != STATUS_OK, "truths: %s", f.text);
    if (plan_sweep(&all, &known, &plan, &f) != STATUS_OK) {
        gsl_test(1, "plan: %s", f.text);
        return gsl_test_summary();
    }
    for (int i = 0; i < plan.points; i++) {
        if (plan.point[i].status != STATUS_OK || moves_only(&plan.point[i].scene))
            continue;
        t.points++;
        every_formulation(&plan.point[i], &t);
    }
    printf("%d points, %d formulations at rest, %d not offered\n", t.points, t.checked,
           t.not_offered);
    gsl_test(t.checked < t.points, "%d points with %d formulations at rest, %d not offered",
             t.points, t.checked, t.not_offered);
    for (int i = 0; registry_formulations[i] != NULL; i++)
        gsl_test(t.of[i] == 0, "%s at rest at %d points", registry_formulations[i]->name, t.of[i]);
    sweep_free(&plan);
    truths_free(&known);
    return gsl_test_summary();
}
