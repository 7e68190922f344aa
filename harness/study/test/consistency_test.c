/* Tests the check of run records. Other cells are computed, with every kind of analysis and of
 * Newton's method, and with elements that count their evaluations. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stddef.h>
#include <string.h>
#include <time.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study_impl.h"
#include "harness/tools/kit/cells.h"

enum { STEPS = 3, ELEMENTS = 5 };

typedef struct consistency_bench {
    scene s;
    cell_result cell;
    step_record step[STEPS];
} consistency_bench;

static void add_analysis(scene_analysis_kind kind, scene *s)
{
    const double end = 1;
    if (kind == SCENE_STATIC)
        scene_add_static(s, 1, &end, 1);
    else if (kind == SCENE_COMPLIANCE)
        scene_add_compliance(s, SCENE_NONE, (scene_compliance){.node = 0});
    else if (kind == SCENE_CONTINUATION)
        scene_add_continuation(s, 1, &end, (scene_control){.node = 0});
    else
        scene_add_rotation(s, 1, &end, 1, 0, (scene_rotating_frame){{0}, {0}});
}

static void make(scene_analysis_kind kind, consistency_bench *b)
{
    memset(b, 0, sizeof *b);
    scene_init(&b->s, "made_up");
    add_analysis(kind, &b->s);
    for (int i = 0; i < STEPS; i++)
        b->step[i] = (step_record){.iterations = 4, .correction = 1e-9, .remaining = NAN};
    const long iterations = 4 * STEPS,
               linearised = iterations - (kind == SCENE_CONTINUATION ? STEPS : 0),
               evaluations = linearised * ELEMENTS;
    b->cell.size.elements = ELEMENTS;
    b->cell.solve.steps = STEPS;
    b->cell.solve.step = b->step;
    b->cell.solve.iterations = (int)iterations;
    b->cell.counters = (counters){.strain_evaluations = evaluations,
                                  .stress_evaluations = evaluations,
                                  .factorisations = linearised,
                                  .numerics = {.solutions = iterations},
                                  .iterations = iterations,
                                  .steps = STEPS};
}

static void expect(const consistency_bench *b, int consistent, const char *what)
{
    char why[FAULT_TEXT] = "";
    gsl_test_int(record_is_consistent(&b->cell, &b->s, NEWTON_MIXED, why), consistent, "%s: %s",
                 what, why);
    gsl_test(!consistent && why[0] == '\0', "%s: it says why", what);
}

static void counts(scene_analysis_kind kind)
{
    const struct {
        size_t offset;
        int exact;
        const char *name;
    } row[] = {{offsetof(counters, strain_evaluations), 1, "strain evaluations"},
               {offsetof(counters, stress_evaluations), 1, "stress evaluations"},
               {offsetof(counters, factorisations), 1, "factorisations"},
               {offsetof(counters, numerics.solutions), 0, "solutions"}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++)
        for (int more = -1; more <= 1; more++) {
            consistency_bench b;
            make(kind, &b);
            long *count = (long *)(void *)((char *)&b.cell.counters + row[i].offset);
            *count += more;
            expect(&b, more == 0 || (more > 0 && !(row[i].exact && kind == SCENE_STATIC)),
                   row[i].name);
            b.cell.counters.rejected_steps = b.step[STEPS - 1].rejected = 1;
            expect(&b, more >= 0, "the same with a step in vain");
            scene_free(&b.s);
        }
}

static void steps(void)
{
    consistency_bench b;
    make(SCENE_STATIC, &b);
    expect(&b, 1, "a cell that is right");
    for (int i = 0; i < STEPS; i++) {
        b.step[i].correction = 1e-7;
        expect(&b, 0, "a step that ended too soon");
        b.step[i].remaining = 1e-14;
        expect(&b, 1, "a step whose next correction is predicted and negligible");
        b.step[i].remaining = 1e-13;
        expect(&b, 0, "a step whose next correction is predicted and is not");
        b.step[i].remaining = 1e-14;
        b.step[i].correction = 2e-6;
        expect(&b, 0, "a correction too large to predict from");
        b.step[i].remaining = NAN;
        b.step[i].correction = NAN;
        expect(&b, 0, "a step without a correction");
        b.step[i].correction = 1e-8;
        expect(&b, 1, "a step that just ended");
    }
    b.cell.counters.steps++;
    expect(&b, 0, "a step that was not kept");
    b.cell.counters.steps -= 2;
    expect(&b, 0, "a step that was not counted");
    b.cell.counters.steps++;
    for (int i = 0; i < STEPS; i++) {
        b.step[i].rejected = 2;
        expect(&b, 0, "rejected steps that were not counted");
        b.cell.counters.rejected_steps = 2 * (i + 1);
        expect(&b, 1, "rejected steps");
    }
    b.cell.counters.rejected_steps--;
    expect(&b, 0, "a rejected step that was not counted");
    for (int i = 0; i < STEPS; i++)
        b.step[i].rejected = 0;
    b.cell.counters.rejected_steps = 0;
    b.step[0].iterations++;
    expect(&b, 0, "an iteration that was not kept");
    b.step[0].iterations--;
    b.cell.solve.iterations++;
    expect(&b, 0, "an iteration that was not counted");
    b.cell.solve.status = STATUS_NOT_CONVERGED;
    expect(&b, 1, "a cell without a solution is not asked");
    scene_free(&b.s);
}

static const element_type *inner;
static long strains, stresses, inertias;

static void counted_strain(const element_data *d, const node_state x[], strain_output *out)
{
    strains++;
    inner->strain(d, x, out);
}

static status counted_stress(const element_data *d, const double e[], const double own[],
                             stress_output *out)
{
    stresses++;
    return inner->stress(d, e, own, out);
}

static status counted_inertia(const element_data *d, const node_state x[],
                              const element_rotating_frame *frame, inertia_output *out)
{
    inertias++;
    return inner->inertia(d, x, frame, out);
}

static void counted_strains(int count, const element_data *const data[], const node_state x[],
                            strain_output out[])
{
    strains += count;
    inner->strain_many(count, data, x, out);
}

static void counted_stresses(int count, const element_data *const data[], const double *const e[],
                             const double *const own[], stress_output out[], status outcome[])
{
    stresses += count;
    inner->stress_many(count, data, e, own, out, outcome);
}

static void counted_equations(int count, const element_data *const data[], const node_state x[],
                              const double *const e[], const double *const own[],
                              const double *const s[], equations_output out[], status outcome[])
{
    strains += count;
    stresses += count;
    inner->equations_many(count, data, x, e, own, s, out, outcome);
}

static void actual(const char *name, int elements, const char *formulation_name,
                   const char *parameters, newton_form newton, int reactions, int checks_flutter)
{
    cell_result cell;
    formulation chosen;
    fault f = {""};
    char why[FAULT_TEXT] = "";
    inner = formulation_find(formulation_name);
    element_type counted = *inner;
    counted.strain = counted_strain;
    counted.stress = counted_stress;
    counted.inertia = counted_inertia;
    counted.strain_many = inner->strain_many != NULL ? counted_strains : NULL;
    counted.stress_many = inner->stress_many != NULL ? counted_stresses : NULL;
    counted.equations_many = inner->equations_many != NULL ? counted_equations : NULL;
    formulation_default(inner, &chosen);
    cell_request request = {.type = case_find(name, &f),
                            .formulation = &counted,
                            .elements = elements,
                            .solve.newton = newton};
    memcpy(request.option, chosen.option, sizeof request.option);
    parameters_default(request.type, request.parameter);
    gsl_test(parameters_parse(request.type, parameters, request.parameter, NULL, &f) != STATUS_OK,
             "%s %s", name, f.text);
    strains = stresses = inertias = 0;
    gsl_test(cell_run(&request, &cell, &f) != STATUS_OK, "%s, %s, Newton %d: %s", name,
             formulation_name, newton, f.text);
    gsl_test(record_is_consistent(&cell, &cell.scene, newton, why) != 1, "%s, %s, Newton %d: %s",
             name, formulation_name, newton, why);
    /* if a path is unstable, the stiffness at rest is also evaluated, which does not count as work
     * of the solution */
    stresses -= checks_flutter * cell.size.elements;
    strains -= checks_flutter * cell.size.elements;
    gsl_test(cell.counters.stress_evaluations != stresses,
             "%s, %s, Newton %d: %ld stress evaluations counted, %ld done", name, formulation_name,
             newton, cell.counters.stress_evaluations, stresses);
    gsl_test(reactions ? cell.counters.strain_evaluations > strains
                       : cell.counters.strain_evaluations != strains,
             "%s, %s, Newton %d: %ld strain evaluations counted, %ld done", name, formulation_name,
             newton, cell.counters.strain_evaluations, strains);
    gsl_test(cell.counters.inertia_evaluations != inertias,
             "%s, %s, Newton %d: %ld inertia evaluations counted, %ld done", name, formulation_name,
             newton, cell.counters.inertia_evaluations, inertias);
    cell_result_free(&cell);
}

static void consistency_tests(void)
{
    static const scene_analysis_kind kind[] = {SCENE_STATIC, SCENE_COMPLIANCE, SCENE_CONTINUATION,
                                               SCENE_ROTATION};
    for (size_t i = 0; i < sizeof kind / sizeof kind[0]; i++)
        counts(kind[i]);
    steps();
    for (int newton = 0; newton < NEWTON_FORMS; newton++) {
        actual("elastica", 3, "beamw_consistent", "", newton, 0, 0);
        actual("bend_45", 3, "geometrically_exact", "", newton, 0, 0);
        actual("sheet_cantilever", 3, "sheet_third", "", newton, 1, 0);
    }
    actual("c_column", 3, "beamw_consistent", "", NEWTON_MIXED, 0, 0);
    actual("lateral_buckling", 3, "collocation", "prebuckling=included;ratio=4", NEWTON_MIXED, 0,
           0);
    actual("rotating_cantilever", 3, "geometrically_exact", "", NEWTON_MIXED, 1, 0);
    actual("snap_through", 3, "collocation", "", NEWTON_MIXED, 0, 1);
    actual("shear_elastica", 1, "beamw_consistent", "", NEWTON_MIXED, 0, 0);
    actual("roll_up", 4, "sheet_third", "", NEWTON_MIXED, 0, 0);
    actual("c_cantilever", 6, "beamw_vlasov", "w=1.0;step=0.15", NEWTON_MIXED, 0, 0);
    actual("hexapod", 3, "sheet_third", "steps=3", NEWTON_MIXED, 1, 0);
}

static const element_type *without_strain_type;

static void sleep_and_strain(const element_data *data, const node_state x[], strain_output *out)
{
    const struct timespec pause = {.tv_nsec = 1000000};
    nanosleep(&pause, NULL);
    without_strain_type->strain(data, x, out);
}

/* Makes a type that sleeps for a millisecond in each evaluation, which otherwise takes
 * microseconds. */
static element_type make_without_strain(const element_type *type)
{
    element_type without_strain = *type;
    without_strain_type = type;
    without_strain.strain = sleep_and_strain;
    without_strain.strain_many = NULL;
    return without_strain;
}

static void parts_are_the_whole(const cell_request *request, const char *what)
{
    cell_result cell;
    fault f = {""};
    double sum = 0;
    gsl_test(cell_run(request, &cell, &f) != STATUS_OK, "%s: solved %s", what, f.text);
    for (int k = 0; k < PHASES; k++) {
        sum += cell.solve.phase[k];
        gsl_test(!(cell.solve.phase[k] >= 0), "%s: %s is a part of the whole (%g of %g s)", what,
                 phase_name((newton_phase)k), cell.solve.phase[k], cell.solve.seconds_solve);
    }
    gsl_test(!(cell.solve.phase[PHASE_ELEMENTS] > 0), "%s: elements take time", what);
    gsl_test(!(sum <= cell.solve.seconds_solve && sum > 0.2 * cell.solve.seconds_solve),
             "%s: the parts, %g s, are the whole, %g s, but for the readings", what, sum,
             cell.solve.seconds_solve);
    cell_result_free(&cell);
}

static void parts_of(const char *name, const char *key, int elements)
{
    cell_request request = cells_of(case_find(name, NULL), key, elements);
    const element_type without_strain = make_without_strain(request.formulation);
    request.solve.phases = 1;
    parts_are_the_whole(&request, key);
    request.formulation = &without_strain;
    parts_are_the_whole(&request, "asleep at times");
}

static void nothing_unrequested(void)
{
    const cell_request request = cells_of(case_find("elastica", NULL), "collocation", 2);
    cell_result cell;
    fault f = {""};
    gsl_test(cell_run(&request, &cell, &f) != STATUS_OK, "solved %s", f.text);
    for (int k = 0; k < PHASES; k++)
        gsl_test_abs(cell.solve.phase[k], 0, 0, "%s unasked", phase_name((newton_phase)k));
    cell_result_free(&cell);
}

static void phases_tests(void)
{
    parts_of("sheet_cantilever", "sheet_third", 1);
    parts_of("elastica", "collocation", 2);
    parts_of("elastica", "sheet_third:newton=dense", 2);
    parts_of("snap_through", "geometrically_exact", 4);
    nothing_unrequested();
}

int main(void)
{
    consistency_tests();
    phases_tests();
    return gsl_test_summary();
}
