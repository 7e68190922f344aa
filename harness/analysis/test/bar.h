#ifndef BEAMWORK_TEST_BAR_H
#define BEAMWORK_TEST_BAR_H

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "harness/tools/kit/ask.h"

enum { WANTED = 4, ELEMENTS = 16 };

static const double young = 2e11, side = 1e-3, length = 1;

static inline double bar_rigidity(void)
{
    return young * pow(side, 4) / 12;
}

static inline double bar_euler(void)
{
    return PI * PI * bar_rigidity() / (length * length);
}

static inline int bar_section(scene *s)
{
    section_spec spec = section_spec_rectangle(young, young / 2.6, side, side);
    spec.density = 7800;
    return scene_add_section(s, &spec);
}

/* Critical loads of one scene. value[sign][order] is NAN if there is no such load. */
typedef struct loads {
    char why[2][WANTED][FAULT_TEXT];
    double value[2][WANTED];
} loads;

typedef void build(scene *s, const double direction[3]);

static inline void bar_ask(scene *s, int signs)
{
    const int buckling = scene_add_buckling(s, SCENE_NONE);
    for (int sign = 0; sign < signs; sign++)
        for (int i = 0; i < WANTED; i++) {
            char name[SCENE_NAME];
            snprintf(name, sizeof name, "%s_%d", sign == 0 ? "positive" : "negative", i + 1);
            scene_add_quantity(s, name, "N", buckling,
                               scene_critical_factor(sign == 0 ? 1 : -1, i));
        }
}

/* Finds the positive critical loads (signs 1), or those of both signs (signs 2). Returns 1 if the
 * formulation supports the analysis. */
static inline int bar_find_signs(const element_type *e, ask_tally *tally, build *make,
                                 const double direction[3], int n, int signs, loads *out)
{
    static answer a;
    scene s;
    memset(out, 0, sizeof *out);
    scene_init(&s, "bar");
    scene_omit(&s, SCENE_OMITTABLE);
    make(&s, direction);
    bar_ask(&s, signs);
    ask_scene(&s, e, NULL, n, &a);
    scene_free(&s);
    for (int i = 0; i < a.count; i++) {
        out->value[i / WANTED][i % WANTED] = a.value[i];
        snprintf(out->why[i / WANTED][i % WANTED], FAULT_TEXT, "%s", a.why[i]);
    }
    return ask_count(tally, &a, "bar of %d elements", n);
}

static inline int bar_find(const element_type *e, ask_tally *tally, build *make,
                           const double direction[3], int n, loads *out)
{
    return bar_find_signs(e, tally, make, direction, n, 2, out);
}

static inline int bar_end(scene *s, const double direction[3], double at)
{
    return scene_add_node(s, at * direction[0], at * direction[1], at * direction[2]);
}

static const double along_x[3] = {1, 0, 0}, oblique[3] = {2.0 / 3, -1.0 / 3, 2.0 / 3},
                    y_axis[3] = {0.1, 1, 0.05};

static inline void bar_push(scene *s, int node, const double direction[3], double force)
{
    scene_add_load(s, SCENE_FORCE, node, force * direction[0], force * direction[1],
                   force * direction[2]);
}

static inline int bar_cantilever(scene *s, const double direction[3])
{
    const int root = scene_add_node(s, 0, 0, 0), tip = bar_end(s, direction, length);
    scene_add_member(s, root, tip, bar_section(s), y_axis);
    scene_hold_all(s, root);
    return tip;
}

#endif
