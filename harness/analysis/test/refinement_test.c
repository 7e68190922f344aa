/* Iterative refinement: what ends it; slender bars along oblique axes, whose solutions settle where
 * the rounding of their forces keeps them; and compliances of so many elements that two refinements
 * do not reach them. */
#include <float.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/newton/newton.h"
#include "harness/tools/kit/accepted.h"
#include "harness/tools/kit/ask.h"

static const double length = 1;

/* Corrections in this order end in that state, with the last of them. */
static void sequences(void)
{
    static const struct {
        const char *what;
        int count;
        double correction[6];
        refinement_state end;
    } row[] = {
        {"exact at once, twice refined all the same", 3, {1, 0, 0}, REFINEMENT_ENDS},
        {"digits to spare", 3, {1, 1e-8, 1e-16}, REFINEMENT_ENDS},
        {"slow, and it arrives", 6, {1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10}, REFINEMENT_ENDS},
        {"settles with enough digits", 5, {1, 1e-4, 1e-7, 3e-8, 2e-8}, REFINEMENT_ENDS},
        {"settles with too few", 4, {1, 1e-2, 1e-4, 8e-5}, REFINEMENT_LOST},
        {"grows", 4, {1, 0.1, 0.5, 3}, REFINEMENT_LOST},
        {"no number", 4, {1, 0.1, NAN, NAN}, REFINEMENT_LOST},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        solution_refinement r = {0};
        for (int k = 0; k < row[i].count; k++)
            gsl_test_int((int)refinement_next(&r, row[i].correction[k]),
                         (int)(k == row[i].count - 1 ? row[i].end : REFINEMENT_GOES_ON),
                         "%s: correction %d", row[i].what, k);
    }
    solution_refinement r = {0};
    double correction = 1;
    int steps = 1;
    while (refinement_next(&r, correction *= 0.9) == REFINEMENT_GOES_ON && steps < 1000)
        steps++;
    gsl_test(steps > 100, "what falls slowly ends after %d corrections", steps);
}

/* A square bar pushed along its axis at its tip: displacements of the tip. */
static void bar(scene *s, double side, const double direction[3])
{
    static const double y_axis[3] = {0.1, 1, 0.05};
    section_spec spec = section_spec_rectangle(2e11, 2e11 / 2.6, side, side);
    scene_init(s, "bar");
    const int root = scene_add_node(s, 0, 0, 0),
              tip = scene_add_node(s, length * direction[0], length * direction[1],
                                   length * direction[2]);
    scene_add_member(s, root, tip, scene_add_section(s, &spec), y_axis);
    scene_hold_all(s, root);
    scene_add_load(s, SCENE_FORCE, tip, direction[0], direction[1], direction[2]);
    const int linear = scene_add_linear(s);
    static const char *const name[3] = {"u_x", "u_y", "u_z"};
    for (int k = 0; k < 3; k++)
        scene_add_quantity(s, name[k], "m", linear, scene_coordinate(tip, k));
}

static void pushed(const element_type *e, ask_tally *tally, double slenderness,
                   const double direction[3], int n)
{
    static answer a;
    scene s;
    const double side = length / slenderness, exact = length / (2e11 * side * side);
    bar(&s, side, direction);
    ask_scene(&s, e, NULL, n, &a);
    scene_free(&s);
    if (slenderness > 2e4) { /* at the edge: within what rounding moves, or refused by name */
        if (a.status == STATUS_SINGULAR)
            gsl_test(strstr(a.reason, "round-off") == NULL,
                     "%s, slenderness %g, %d elements: the cause is named: %s", e->name,
                     slenderness, n, a.reason);
        if (a.status != STATUS_OK)
            return;
    } else if (!ask_count(tally, &a, "bar of slenderness %g, %d elements", slenderness, n)) {
        return;
    }
    /* eps (L/side)^2 from the forces, with room, and what the mesh rounds */
    const double settles = 64 * DBL_EPSILON * slenderness * slenderness + 1e-14 * n;
    for (int k = 0; k < 3; k++)
        gsl_test(!(fabs(a.value[k] / exact - direction[k]) <= settles),
                 "%s, slenderness %g, %d elements: component %d is off by %.1e of the displacement",
                 e->name, slenderness, n, k, a.value[k] / exact - direction[k]);
}

/* No correction shows it in one element, whose forces are rounded alike each time. */
static void too_slender(const element_type *e)
{
    static const double direction[3] = {0.8, 0.6, 0};
    static answer a;
    scene s;
    bar(&s, 1e-6, direction);
    ask_scene(&s, e, NULL, 1, &a);
    scene_free(&s);
    gsl_test(a.status != STATUS_SINGULAR && a.outcome != ASK_REFUSED &&
                 a.outcome != ASK_NOT_OFFERED,
             "%s: a bar of slenderness 1e6 has too few digits (%s)", e->name, a.reason);
}

static void slender_bars(const element_type *e, ask_tally *tally)
{
    static const double direction[][3] = {{1, 0, 0}, {2.0 / 3, -1.0 / 3, 2.0 / 3}, {0.8, 0.6, 0}};
    for (double slenderness = 10; slenderness < 2e6; slenderness *= 10)
        for (int d = 0; d < 3; d++)
            for (int n = 1; n <= 64; n *= 8)
                pushed(e, tally, slenderness, direction[d], n);
}

/* Where factors have no more than two digits: the same as with fewer elements, which settle. */
static void compliance_of_many(void)
{
    static answer coarse, fine;
    const question many = {.type = case_find("sheet_cantilever", NULL),
                           .parameters = "stations=1",
                           .formulation = registry_formulations[0],
                           .elements = 12000};
    question few = many;
    few.elements = 1500;
    ask(&few, &coarse);
    ask(&many, &fine);
    gsl_test(coarse.outcome != ASK_ANSWERED || fine.outcome != ASK_ANSWERED, "sheets: %s %s",
             coarse.reason, fine.reason);
    const char *const quantity[] = {"C_xx", "C_uy_Fy", "C_thz_Mz", "C_uz_Fz"};
    for (int i = 0; i < 4; i++)
        gsl_test_rel(answer_of(&fine, quantity[i]), answer_of(&coarse, quantity[i]), 3e-7,
                     "%s of 12000 sheets is that of 1500", quantity[i]);
}

int main(void)
{
    sequences();
    for (int i = 0; accepted_at(i) != NULL; i++) {
        ask_tally tally = {0};
        slender_bars(accepted_at(i), &tally);
        too_slender(accepted_at(i));
        ask_conclude(&tally, accepted_at(i), "slender bars");
    }
    compliance_of_many();
    return gsl_test_summary();
}
