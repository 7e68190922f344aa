#include "harness/analysis/collect.h"

#include <stdlib.h>
#include <string.h>

#include "elements/math/pi.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

static int least(int a, int b)
{
    return a < b ? a : b;
}

/* States of one analysis that are kept; most: of a path. */
static int count_of(const analysis_outcome *o, int most)
{
    if (o->kind == SCENE_MOTION)
        return outcome_motion_of(o)->frames.reached;
    if (outcome_has_path(o))
        return outcome_path_of(o)->state != NULL ? least(outcome_path_of(o)->reached, most) : 0;
    if (!outcome_has_spectrum(o))
        return outcome_displacements(o) != NULL;
    const outcome_side *positive = &outcome_spectrum_of(o)->positive,
                       *negative = &outcome_spectrum_of(o)->negative;
    return least(positive->count, SHAPES_MODES) * (positive->mode != NULL) +
           least(negative->count, SHAPES_MODES) * (negative->mode != NULL);
}

static void keep(const analysis_context *c, shapes *s, const shape_state *what,
                 const model_state *state)
{
    s->state[s->states] = *what;
    centreline_fill(c->model, state, s->point + (size_t)s->states * (size_t)s->points);
    centreline_nodes(c->model, state, s->node + 3 * (size_t)s->states * (size_t)s->nodes);
    s->states++;
}

static void keep_path(const analysis_context *c, int analysis, int most, shapes *s)
{
    const outcome_path *o = outcome_path_of(&c->outcomes[analysis]);
    const int count = count_of(&c->outcomes[analysis], most);
    for (int i = 0; i < count; i++) {
        const int at = count > 1 ? (int)((long)i * (o->reached - 1) / (count - 1)) : o->reached - 1;
        keep(c, s, &(shape_state){SHAPE_PATH, analysis, o->value[at], 1}, o->state[at]);
    }
}

static void keep_motion(const analysis_context *c, int analysis, shapes *s)
{
    const outcome_path *o = &outcome_motion_of(&c->outcomes[analysis])->frames;
    for (int i = 0; i < o->reached; i++)
        keep(c, s, &(shape_state){SHAPE_MOTION, analysis, o->value[i], 1}, o->state[i]);
}

/* x[free + driven]; the state the analysis is about is the last of the path it follows. */
static status keep_displaced(const analysis_context *c, shape_state *what, const double x[],
                             const double sigma[], shapes *s, fault *f)
{
    const int follows = c->scene->analysis[what->analysis].follows;
    const outcome_path *path = follows != SCENE_NONE && outcome_has_path(&c->outcomes[follows])
                                   ? outcome_path_of(&c->outcomes[follows])
                                   : NULL;
    const model_state *about = path != NULL && path->reached > 0 && path->state != NULL
                                   ? path->state[path->reached - 1]
                                   : kinematics_rest(c->model);
    model_state *moved = NULL;
    const status outcome = centreline_displaced(c->model, about, x, sigma, &what->scale, &moved, f);
    if (outcome == STATUS_OK)
        keep(c, s, what, moved);
    kinematics_state_free(moved);
    return outcome;
}

/* sigma[stresses] is work space. */
static status keep_displacements(const analysis_context *c, int analysis, double sigma[], shapes *s,
                                 fault *f)
{
    const double *x = outcome_displacements(&c->outcomes[analysis]);
    shape_state what = {SHAPE_LINEAR, analysis, 1, 1};
    TRY(linear_whole_stresses(&c->eq, x, sigma, f));
    return keep_displaced(c, &what, x, sigma, s, f);
}

static status keep_linear(const analysis_context *c, int analysis, shapes *s, fault *f)
{
    double *sigma = calloc((size_t)model_stresses(c->model) + 1, sizeof *sigma);
    if (sigma == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for the shape of a linear solution");
    const status outcome = keep_displacements(c, analysis, sigma, s, f);
    free(sigma);
    return outcome;
}

/* x[free + driven] is work space. */
static status keep_modes_in(const analysis_context *c, int analysis, const outcome_side *side,
                            double x[], shapes *s, fault *f)
{
    const size_t n = (size_t)model_sizes(c->model).free;
    const int buckling = c->scene->analysis[analysis].kind == SCENE_BUCKLING;
    for (int i = 0; i < least(side->count, SHAPES_MODES); i++) {
        shape_state what = {buckling ? SHAPE_BUCKLING : SHAPE_MODE, analysis,
                            buckling ? side->value[i] : side->value[i] / (2 * PI), 0};
        memcpy(x, side->mode + n * (size_t)i, n * sizeof *x);
        TRY(keep_displaced(c, &what, x, NULL, s, f));
    }
    return STATUS_OK;
}

/* mode[count x free] */
static status keep_modes(const analysis_context *c, int analysis, const outcome_side *side,
                         shapes *s, fault *f)
{
    const model_size size = model_sizes(c->model);
    if (side->mode == NULL)
        return STATUS_OK;
    double *x = calloc((size_t)(size.free + size.driven) + 1, sizeof *x);
    const status outcome =
        x != NULL ? keep_modes_in(c, analysis, side, x, s, f)
                  : fault_set(f, STATUS_FAULT, "out of memory for the shape of a mode");
    free(x);
    return outcome;
}

/* With what collect_shapes frees. */
static status keep_all(const analysis_context *c, int most, shapes *s, fault *f)
{
    TRY(shapes_alloc(s, f));
    s->states = 0; /* counted again as they are filled */
    centreline_points(c->model, s->first);
    keep(c, s, &(shape_state){SHAPE_UNDEFORMED, -1, 0, 1}, kinematics_rest(c->model));
    for (int i = 0; i < c->scene->analyses; i++) {
        const analysis_outcome *o = &c->outcomes[i];
        const analysis_context own = context_of(c, i);
        if (o->kind == SCENE_MOTION) {
            keep_motion(&own, i, s);
        } else if (outcome_has_path(o)) {
            keep_path(&own, i, most, s);
        } else if (outcome_has_spectrum(o)) {
            TRY(keep_modes(&own, i, &outcome_spectrum_of(o)->positive, s, f));
            TRY(keep_modes(&own, i, &outcome_spectrum_of(o)->negative, s, f));
        } else if (outcome_displacements(o) != NULL) {
            TRY(keep_linear(&own, i, s, f));
        }
    }
    return STATUS_OK;
}

status collect_shapes(const analysis_context *c, int most, shapes *s, fault *f)
{
    memset(s, 0, sizeof *s);
    s->members = c->scene->members;
    s->nodes = c->scene->nodes;
    s->points = centreline_points(c->model, NULL);
    s->states = 1;
    for (int i = 0; i < c->scene->analyses; i++)
        s->states += count_of(&c->outcomes[i], most);
    const status outcome = keep_all(c, most, s, f);
    if (outcome != STATUS_OK)
        shapes_free(s);
    return outcome;
}
