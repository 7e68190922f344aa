/* The line that a table of convergence comes to: order, ties, who is not there, who has no prices.
 */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/records/records.h"
#include "harness/study/study.h"

enum { LINE_MESHES = 5, SERIES = 4 };
static const parameter_type parameter[] = {{.name = NULL}};
static const case_type line_made_up = {
    .name = "made_up", .summary = "of the test", .source = "none", .parameters = {parameter}};
static const element_type type[SERIES] = {{.name = "red", .family = "red", .abi = ELEMENT_ABI},
                                          {.name = "blue", .family = "blue", .abi = ELEMENT_ABI},
                                          {.name = "green", .family = "green", .abi = ELEMENT_ABI},
                                          {.name = "grey", .family = "grey", .abi = ELEMENT_ABI}};

typedef struct reach_line_bench {
    sweep s;
    sweep_point p;
    series one[SERIES];
    cell_result cell[SERIES][LINE_MESHES];
    quantity_result quantity[SERIES][LINE_MESHES];
    truths t;
} reach_line_bench;

/* Values limit (1 + 0.1 n^-2), work evaluations on the coarsest mesh and twice as many on each next
 * one. */
static void add(reach_line_bench *b, double limit, long work)
{
    const int i = b->s.seriess++;
    b->one[i] =
        (series){.formulation = {.type = &type[i]}, .meshes = LINE_MESHES, .cell = b->cell[i]};
    strcpy(b->one[i].formulation.key, type[i].name);
    for (int k = 0; k < LINE_MESHES; k++) {
        const double n = b->one[i].mesh[k] = 2 << k;
        b->quantity[i][k].value = limit * (1 + 0.1 / n / n);
        b->cell[i][k].size.strains = 8;
        b->cell[i][k].counters.strain_evaluations = work << k;
        b->cell[i][k].solve.quantities = 1;
        b->cell[i][k].solve.quantity = &b->quantity[i][k];
    }
}

/* Three agree, the work of the second is `times` times that of the first; the fourth does not. */
static void line_make(reach_line_bench *b, double times)
{
    fault f;
    memset(b, 0, sizeof *b);
    b->p.type = &line_made_up;
    scene_init(&b->p.scene, "made_up");
    scene_quantity *q =
        scene_add_quantity(&b->p.scene, "load", "N", 0, scene_coordinate(0, SCENE_UX));
    q->tolerance = 1e-4;
    q->least_order = 2;
    b->s = (sweep){.points = 1, .point = &b->p, .series = b->one};
    add(b, 3, 1000000);
    add(b, 3, (long)(1000000 * times));
    add(b, 3, 9000000);
    add(b, 3.3, 10000);
    gsl_test(families_add_truths(&b->s, 0, &b->t, &f) != STATUS_OK || b->t.rows != 1, "agreed");
}

/* One more row: what another model has for the load. */
static void add_model(reach_line_bench *b, const char *kind, double value)
{
    truth *row = realloc(b->t.row, (size_t)(b->t.rows + 1) * sizeof *row);
    gsl_test(row == NULL, "room for a truth");
    b->t.row = row;
    row[b->t.rows++] = (truth){.type = &line_made_up,
                               .formulation = strdup(""),
                               .theory = strdup(""),
                               .quantity = strdup("load"),
                               .unit = strdup("N"),
                               .kind = strdup(kind),
                               .model = strdup("other"),
                               .convention = strdup(""),
                               .source = strdup("of the test"),
                               .value = value};
}

/* One more quantity, which no cell has a value of. */
static void add_quantity(reach_line_bench *b, const char *name, scene_reduction reduction)
{
    scene_quantity *q =
        scene_add_quantity(&b->p.scene, name, "N", 0, scene_coordinate(0, SCENE_UX));
    q->reduction = reduction;
}

static void finish(reach_line_bench *b)
{
    truths_free(&b->t);
    scene_free(&b->p.scene);
}

/* The line without its costs. */
static void line_of(const reach_line_bench *b, double level, char out[1000])
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    reach_line_write(to, &b->s, &b->t, level);
    fclose(to);
    for (const char *at = text; *at != '\0';) {
        const char *end = strncmp(at, " (", 2) == 0 ? strchr(at, ')') : NULL;
        if (end != NULL && strncmp(end - 3, " ms", 3) == 0)
            at = end + 1;
        else
            *out++ = *at++;
    }
    *out = '\0';
    free(text);
}

static void line_expect(const reach_line_bench *b, double level, const char *right)
{
    char line[1000];
    line_of(b, level, line);
    gsl_test(strcmp(line, right) != 0, "'%s', not '%s'", line, right);
}

/* Without a reference they are named at once; curves do not count. */
static void not_every_quantity(void)
{
    reach_line_bench b;
    line_make(&b, 2 * price_noise);
    add_quantity(&b, "curve", SCENE_CURVE);
    line_expect(
        &b, 1e-9,
        "for 1e-07 % in every quantity: no formulation on these meshes; not reached by red "
        "(load: 0.0098 %), blue (load: 0.0098 %), green (load: 0.0098 %), grey (load: 10 %)\n");
    add_quantity(&b, "sway", SCENE_LAST);
    add_quantity(&b, "tilt", SCENE_LAST);
    b.s.seriess = 3;
    line_expect(
        &b, 0.01,
        "for 1 % in 1 of 3 quantities (without a reference: sway, tilt): red n = 4; blue n = 4; "
        "green n = 4; without cost coefficients of its own: red, blue, green\n");
    b.s.seriess = 1;
    b.t.rows--;
    line_expect(
        &b, 0.01,
        "for 1 % in no quantity (without a reference: load, sway, tilt): nothing to measure "
        "by\n");
    b.t.rows++;
    finish(&b);
}

/* The model error of those that are right, at the end; an agreement is no other model. */
static void other_models(void)
{
    reach_line_bench b;
    line_make(&b, 2 * price_noise);
    b.s.seriess = 1;
    add_model(&b, "agreement", 4);
    line_expect(
        &b, 0.01,
        "for 1 % in every quantity: red n = 4; without cost coefficients of its own: red\n");
    add_model(&b, "independent", 3.1);
    line_expect(
        &b, 0.01,
        "for 1 % in every quantity: red n = 4; without cost coefficients of its own: red; of "
        "another model "
        "(solid, plate): up to 3.2 % off (load)\n");
    line_expect(&b, 1e-9,
                "for 1e-07 % in every quantity: no formulation on these meshes; not reached by red "
                "(load: 0.0098 %)\n");
    b.s.seriess = 4;
    line_expect(
        &b, 0.2,
        "for 20 % in every quantity: grey n = 2; red n = 2; blue n = 2; green n = 2; without "
        "cost coefficients of its own: grey, red, blue, green; of another model (solid, plate): "
        "up to 6.5 "
        "% off (load)\n");
    finish(&b);
}

int main(void)
{
    reach_line_bench b;
    line_make(&b, 2 * price_noise);
    line_expect(&b, 0.01,
                "for 1 % in every quantity: red n = 4; blue n = 4; green n = 4; without cost "
                "coefficients of its "
                "own: red, blue, green; not reached by grey (load: 10 %)\n");
    line_expect(
        &b, 1e-9,
        "for 1e-07 % in every quantity: no formulation on these meshes; not reached by red "
        "(load: 0.0098 %), blue (load: 0.0098 %), green (load: 0.0098 %), grey (load: 10 %)\n");
    finish(&b);
    line_make(&b, 1 + (price_noise - 1) / 2);
    line_expect(
        &b, 0.2,
        "for 20 % in every quantity: grey n = 2; red n = 2; blue n = 2; green n = 2; without "
        "cost coefficients of its own: grey, red, blue, green\n");
    line_expect(
        &b, 0.03,
        "for 3 % in every quantity: red n = 2, blue n = 2: within noise of each other; green n "
        "= 2; without cost coefficients of its own: red, blue, green; not reached by grey "
        "(load: 10 %)\n");
    finish(&b);
    not_every_quantity();
    other_models();
    return gsl_test_summary();
}
