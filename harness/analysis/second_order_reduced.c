#include "harness/analysis/analysis_impl.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "harness/model/model.h"

static status no_memory(fault *f)
{
    return fault_memory(f, "a reduced model");
}

/* Reads the node name from `at` to the next comma. REFUSED: the name is empty, unknown, or already
 * in the list. */
static status read_node(const scene *s, const char *text, const char *list, const char *at,
                        int *node, fault *f)
{
    const size_t length = strcspn(at, ",");
    if (length == 0)
        return fault_set(f, STATUS_REFUSED,
                         "--reduce %.60s: the name of an interface node is missing; name the node, "
                         "as in 10:base,tip, or remove the colon or comma",
                         text);
    *node = SCENE_NONE;
    for (int i = 0; i < s->nodes; i++) {
        const scene_words name = scene_name(s, SCENE_NODES, i);
        if (strlen(name.text) == length && strncmp(name.text, at, length) == 0)
            *node = i;
    }
    if (*node == SCENE_NONE)
        return fault_set(f, STATUS_REFUSED,
                         "--reduce %.60s: the scene has no node %.*s; name nodes of the scene",
                         text, (int)length, at);
    for (const char *one = list; one < at; one += strcspn(one, ",") + 1)
        if (strcspn(one, ",") == length && strncmp(one, at, length) == 0)
            return fault_set(f, STATUS_REFUSED,
                             "--reduce %.60s: node %.*s is named twice; name it only once", text,
                             (int)length, at);
    return STATUS_OK;
}

/* Reads "MODES:NODE,NODE" into *modes, and sets edge to 1 for the coordinates of these nodes. */
static status read_interface(const vibration *v, const char *text, int *modes, char edge[],
                             fault *f)
{
    int index[KINEMATICS_MOST], node = SCENE_NONE;
    double T[6 * KINEMATICS_MOST];
    char *at;
    const long many = strtol(text, &at, 10);
    const char *const list = at + 1;
    *modes = many < INT_MAX ? (int)many : INT_MAX;
    if (at == text || many < 0 || (*at != '\0' && *at != ':'))
        return fault_set(f, STATUS_REFUSED,
                         "--reduce %.60s: write the number of modes, then the interface nodes if "
                         "there are any, as in 10:base,tip",
                         text);
    while (*at != '\0') {
        TRY(read_node(v->c->scene, text, list, ++at, &node, f));
        const int count =
            kinematics_node_jacobian(v->c->model, v->state, node, KINEMATICS_MOST, index, T);
        for (int k = 0; k < count; k++)
            if (index[k] < v->free)
                edge[index[k]] = 1;
        at += strcspn(at, ",");
    }
    return STATUS_OK;
}

/* Complex transfer functions [each] of the full and the reduced model at one frequency. */
typedef struct transfers_compared {
    size_t each;
    double *whole, *reduced;
    double *rounding; /* [each] rounding errors of the transfer functions of the full model */
    double *largest;  /* [each] largest absolute value of the full model over all frequencies */
    /* [each] 0: the transfer function is zero at all frequencies, apart from rounding errors */
    char *exists;
    /* [n + motions] kind of each coordinate of the full model: 0 m, 1 rad, 2 rad/m, 3 prescribed
     * motion */
    char *kind;
} transfers_compared;

static status transfers_alloc(const second_order *whole, transfers_compared *t, reduced_model *out,
                              fault *f)
{
    const size_t each = (size_t)whole->outputs * (size_t)whole->inputs;
    t->each = each;
    t->whole = calloc(6 * each + 1, sizeof *t->whole);
    t->exists = calloc(each + 1, 1);
    t->kind = malloc((size_t)whole->n + (size_t)whole->motions + 1);
    out->difference = calloc(each + 1, sizeof *out->difference);
    out->apart = calloc(each + 1, sizeof *out->apart);
    out->at = calloc(each + 1, sizeof *out->at);
    if (t->whole == NULL || t->exists == NULL || t->kind == NULL || out->difference == NULL ||
        out->apart == NULL || out->at == NULL)
        return no_memory(f);
    t->reduced = t->whole + 2 * each;
    t->rounding = t->whole + 4 * each;
    t->largest = t->whole + 5 * each;
    return STATUS_OK;
}

/* Sets kind[n + motions] from the units of the coordinates, because the scales of coordinates with
 * different units are not comparable. */
static void set_kinds(const system_matrices *s, const second_order *whole, char kind[])
{
    static const char *const unit[] = {"m", "rad", "rad/m"};
    enum { UNITS = sizeof unit / sizeof unit[0] };
    for (int i = 0; i < whole->n + whole->motions; i++) {
        kind[i] = 0;
        while (kind[i] < UNITS &&
               (i >= whole->n || strcmp(s->label[i].unit, unit[(int)kind[i]]) != 0))
            kind[i]++;
    }
}

static void compare_at(transfers_compared *t, double frequency, reduced_model *out)
{
    for (size_t k = 0; k < t->each; k++) {
        const double *a = t->whole + 2 * k, *b = t->reduced + 2 * k, size = hypot(a[0], a[1]),
                     off = hypot(a[0] - b[0], a[1] - b[1]);
        t->largest[k] = fmax(t->largest[k], size);
        if (size > t->rounding[k])
            t->exists[k] = 1;
        if (off > out->difference[k]) {
            out->difference[k] = off;
            out->at[k] = frequency;
        }
    }
}

static status compare_transfer(const vibration *v, const system_matrices *s,
                               const second_order *whole, const second_order *small,
                               reduced_model *out, fault *f)
{
    const scene_path *path = scene_path_of(&v->c->scene->analysis[v->analysis]);
    transfers_compared t = {0};
    status outcome = transfers_alloc(whole, &t, out, f);
    if (outcome == STATUS_OK)
        set_kinds(s, whole, t.kind);
    for (int i = 0; outcome == STATUS_OK && i < path->stations; i++) {
        const double w = 2 * PI * path->value[i];
        if (w == 0 && whole->motions > 0)
            continue; /* the response to a constant acceleration is infinite */
        outcome = second_order_transfer(whole, w, t.whole, t.kind, t.rounding, f);
        if (outcome == STATUS_SINGULAR) {
            outcome = STATUS_OK;
            continue; /* the response at a resonance without damping is infinite */
        }
        if (outcome == STATUS_OK)
            outcome = second_order_transfer(small, w, t.reduced, NULL, NULL, f);
        if (outcome == STATUS_OK)
            compare_at(&t, path->value[i], out);
    }
    for (size_t k = 0; k < t.each && outcome == STATUS_OK; k++)
        out->apart[k] = t.exists[k] ? out->difference[k] / t.largest[k] : (double)NAN;
    free(t.whole);
    free(t.exists);
    free(t.kind);
    return outcome;
}

static status compare_frequencies(const second_order *whole, const second_order *small, int modes,
                                  reduced_model *out, fault *f)
{
    out->whole = calloc((size_t)whole->n + 1, sizeof *out->whole);
    out->reduced = calloc((size_t)small->n + 1, sizeof *out->reduced);
    if (out->whole == NULL || out->reduced == NULL)
        return no_memory(f);
    TRY(second_order_frequencies(whole, out->whole, f));
    TRY(second_order_frequencies(small, out->reduced, f));
    while (out->modes < modes && out->modes < small->n && isfinite(out->whole[out->modes]) &&
           isfinite(out->reduced[out->modes]))
        out->modes++;
    return STATUS_OK;
}

status second_order_keep_reduced(const vibration *v, const system_matrices *s,
                                 const second_order *whole, reduced_model *out, fault *f)
{
    second_order small = {0};
    double *T = NULL;
    int modes = 0;
    char *edge = calloc((size_t)v->free + 1, sizeof *edge);
    fault why = {""};
    if (edge == NULL)
        return no_memory(f);
    status outcome = read_interface(v, v->c->options->reduce, &modes, edge, f);
    if (outcome == STATUS_OK) {
        out->requested = modes;
        outcome = second_order_reduce(whole, edge, &modes, &small, &T, &why);
        out->taken = modes;
        if (outcome != STATUS_OK)
            fault_set(f, outcome, "--reduce %.60s: %s", v->c->options->reduce, why.text);
    }
    if (outcome == STATUS_OK)
        outcome = second_order_triplets(whole->n + whole->motions, small.n + small.motions, T,
                                        &out->T, f);
    if (outcome == STATUS_OK)
        outcome = second_order_take(&small, s->outputs, &out->of, f);
    if (outcome == STATUS_OK)
        outcome = second_order_state_space(v, s, &small, 1, &out->of, f);
    if (outcome == STATUS_OK)
        outcome = compare_frequencies(whole, &small, modes, out, f);
    if (outcome == STATUS_OK && v->analysis != SCENE_NONE &&
        v->c->scene->analysis[v->analysis].kind == SCENE_HARMONIC)
        outcome = compare_transfer(v, s, whole, &small, out, f);
    second_order_free(&small);
    free(T);
    free(edge);
    return outcome;
}
