/* Compliance of a node whose prescribed motion is released: forces and moments of fixed axes are
 * dead, whether they are loads or reactions. What is a load is no reaction, so the compliance does
 * not depend on how both share what holds the node where it is. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>

#include "harness/formulations/formulations.h"
#include "harness/tools/kit/ask.h"

static const double young = 2e11, side = 0.02, length = 1;

typedef struct released_request {
    double force, moment; /* loads at the driven node, parts of EI/l^2, EI/l */
    unsigned driven;      /* components of the tip */
} released_request;

/* A cantilever, its tip driven away; all entries of the compliance that Fx .. Mz make of the driven
 * components. */
static void make(scene *s, const released_request *what)
{
    static const double to[6] = {-0.002, 0.06, -0.03, 0.04, 0.05, 0.1}, y[3] = {0, 1, 0.3},
                        path[2] = {0, 1};
    const double EI = young * pow(side, 4) / 12;
    section_spec spec = section_spec_rectangle(young, young / 2.6, 1.5 * side, side);
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, length, 0, 0);
    scene_add_member(s, root, tip, scene_add_section(s, &spec), y);
    scene_hold_all(s, root);
    for (int c = SCENE_UX; c <= SCENE_RZ; c++) {
        char name[SCENE_NAME];
        const double value[2] = {0, to[c] * (c < 3 ? length : 1)};
        snprintf(name, sizeof name, "drive_%d", c);
        if (what->driven >> c & 1U)
            scene_drive(s, tip, c, scene_add_driver(s, name, 2, path, value));
    }
    const double F = what->force * EI / (length * length), M = what->moment * EI / length;
    scene_add_load(s, SCENE_FORCE, tip, 0.5 * F, F, -0.7 * F);
    scene_add_load(s, SCENE_MOMENT, tip, -0.4 * M, M, 0.8 * M);
    const int compliance = scene_add_compliance(s, scene_add_static(s, 1, &path[1], 5),
                                                (scene_compliance){.node = tip,
                                                                   .moments = SCENE_MOMENTS_SPATIAL,
                                                                   .released = what->driven});
    for (int k = 0; k < 36; k++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "C_%d%d", k / 6, k % 6);
        scene_add_quantity(s, name, "", compliance, scene_compliance_entry(k / 6, k % 6));
    }
}

static void released_solve(const element_type *type, const released_request *what, answer *out)
{
    scene s;
    scene_init(&s, "released");
    make(&s, what);
    ask_scene(&s, type, NULL, 4, out);
    scene_free(&s);
}

/* Largest difference of an entry, by the geometric mean of its diagonal ones. */
static double apart(const answer *a, const answer *b)
{
    double worst = 0;
    for (int k = 0; k < 36; k++) {
        const double size = sqrt(fabs(a->value[7 * (k / 6)] * a->value[7 * (k % 6)])),
                     difference = fabs(a->value[k] - b->value[k]) / size;
        worst = isnan(difference) || difference > worst ? difference : worst;
    }
    return worst;
}

int main(void)
{
    static const released_request driven[] = {{0, 0, 0x3f}, {0.5, 0, 0x38}};
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *type = registry_formulations[i];
        ask_tally t = {.values = 0};
        for (int k = 0; k < 2; k++) {
            answer without, with;
            released_request loaded = driven[k];
            loaded.moment += 0.9;
            loaded.force += (loaded.driven & 7U) != 0 ? 0.6 : 0;
            released_solve(type, &driven[k], &without);
            released_solve(type, &loaded, &with);
            if (!ask_count(&t, &without, "reactions alone") ||
                !ask_count(&t, &with, "a load beside them"))
                continue;
            const double difference = apart(&without, &with);
            gsl_test(!(difference < 1e-9),
                     "%s, driven %02x: a load in place of a part of the reaction (%.1e)",
                     type->name, driven[k].driven, difference);
        }
        ask_conclude(&t, type, "released");
    }
    return gsl_test_summary();
}
