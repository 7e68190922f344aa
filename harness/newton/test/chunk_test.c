/* Elements in lanes: members of two sections by turns have the answers of one element at a time,
 * and what cannot be evaluated is named. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/analysis/analysis.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

enum { ELEMENTS = 7, MEMBERS = 3, QUANTITIES = 6 };

/* Three members in a line, the first and the last of one section, bent by a force at the end. */
static void set_up(scene *s)
{
    const double y[3] = {0, 1, 0}, end = 1;
    const section_spec spec[2] = {section_spec_rectangle(2e11, 8e10, 0.02, 0.002),
                                  section_spec_rectangle(2e11, 8e10, 0.03, 0.001)};
    int node[MEMBERS + 1], of[2];
    scene_init(s, "line");
    for (int k = 0; k < 2; k++)
        of[k] = scene_add_section(s, &spec[k]);
    for (int k = 0; k <= MEMBERS; k++)
        node[k] = scene_add_node(s, 0.2 * k, 0, 0);
    for (int k = 0; k < MEMBERS; k++)
        scene_add_member(s, node[k], node[k + 1], of[k % 2], y);
    scene_hold_all(s, node[0]);
    scene_add_load(s, SCENE_FORCE, node[MEMBERS], 0.1, 0.4, 0.2);
    scene_add_static(s, 1, &end, 1);
    for (int k = 0; k < QUANTITIES; k++) {
        const char name[2] = {(char)('a' + k), 0};
        scene_add_quantity(s, name, "1", 0, scene_coordinate(node[MEMBERS], k));
    }
}

static void solved(const element_type *type, double value[QUANTITIES])
{
    scene s;
    model *m = NULL;
    solve_result r = {0};
    fault f = {""};
    set_up(&s);
    const model_request request = {&s, type, NULL, ELEMENTS, 0};
    gsl_test(model_alloc(&request, &m, &f) != STATUS_OK ||
                 solve_scene(&s, m, NULL, &r, &f) != STATUS_OK,
             "%s: %s", type->name, f.text);
    for (int k = 0; k < QUANTITIES; k++)
        value[k] = r.quantities > k ? r.quantity[k].value : NAN;
    result_free(&r);
    model_free(m);
    scene_free(&s);
}

static void same_answers(const element_type *type)
{
    double together[QUANTITIES], alone[QUANTITIES];
    element_type one = *type;
    one.lanes = 0;
    one.strain_many = NULL;
    one.stress_many = NULL;
    one.equations_many = NULL;
    solved(type, together);
    solved(&one, alone);
    gsl_test(memcmp(together, alone, sizeof alone) != 0, "%s: in lanes %.17g, one at a time %.17g",
             type->name, together[1], alone[1]);
}

static const element_type *inner;
static int asked; /* processors without AVX2 evaluate one at a time */
static const double failing =
    0.4 + 0.2 * 3 / ELEMENTS; /* [m] where the fourth of the last begins */

/* One element cannot be evaluated. */
static void fail(int count, const node_state x[], int nodes, status outcome[])
{
    for (int k = 0; k < count; k++)
        if (fabs(x[k * nodes].r[0] - failing) < 1e-9)
            outcome[k] = STATUS_SINGULAR;
}

static void failing_equations(int count, const element_data *const data[], const node_state x[],
                              const double *const e[], const double *const own[],
                              const double *const s[], equations_output out[], status outcome[])
{
    asked++;
    inner->equations_many(count, data, x, e, own, s, out, outcome);
    fail(count, x, element_nodes(inner, NULL), outcome);
}

static void named(const element_type *type)
{
    scene s;
    model *m = NULL;
    model_state *state = NULL;
    fault f = {""};
    element_type wrong = *type;
    inner = type;
    wrong.equations_many = failing_equations;
    set_up(&s);
    const model_request request = {&s, &wrong, NULL, ELEMENTS, 0};
    if (model_alloc(&request, &m, &f) == STATUS_OK &&
        kinematics_state_alloc(m, &state, &f) == STATUS_OK) {
        const model_size size = model_sizes(m);
        double *residual = calloc((size_t)(size.free + size.driven) + 1, sizeof *residual);
        run_state run;
        model_linearisation lin = {.residual = residual};
        run_state_begin(&run, m, 1, NULL);
        equations eq = {.m = m, .run = &run};
        asked = 0;
        const status outcome =
            residual != NULL ? linearise_state(&eq, &run.memory, state, &lin, &f) : STATUS_FAULT;
        gsl_test(outcome != (asked > 0 ? STATUS_SINGULAR : STATUS_OK),
                 "%s: an element that cannot be evaluated", type->name);
        gsl_test(asked > 0 && strstr(f.text, "element 17 of member 2") == NULL, "%s: '%s'",
                 type->name, f.text);
        run_state_end(&run);
        free(residual);
    } else {
        gsl_test(1, "%s: %s", type->name, f.text);
    }
    kinematics_state_free(state);
    model_free(m);
    scene_free(&s);
}

int main(void)
{
    int found = 0;
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *type = registry_formulations[i];
        if (type->lanes == 0)
            continue;
        same_answers(type);
        if (type->equations_many != NULL) {
            named(type);
            found++;
        }
    }
    gsl_test(found == 0, "a formulation with equations in lanes");
    return gsl_test_summary();
}
