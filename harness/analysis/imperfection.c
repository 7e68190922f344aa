/* Modes as initial shapes. */
#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"

int imperfection_modes(const scene *s, int analysis)
{
    int wanted = 0;
    for (int i = 0; i < s->imperfections; i++) {
        const scene_imperfection *p = &s->imperfection[i];
        if (p->analysis == analysis && p->order + 3 > wanted)
            wanted = p->order + 3;
    }
    return wanted;
}

/* Modes with the same critical load or frequency: their number, and the first two of them. */
typedef struct same_modes {
    int count, mode[2];
} same_modes;

static same_modes same_as(const outcome_side *side, int mode)
{
    const double within = 1e-6;
    same_modes out = {0};
    for (int i = 0; i < side->count; i++)
        if (i == mode ||
            fabs(side->value[i] - side->value[mode]) <= within * fabs(side->value[mode])) {
            if (out.count < 2)
                out.mode[out.count] = i;
            out.count++;
        }
    return out;
}

/* Finds the combination part[0], part[1] of two modes, u[vertices x 7] each, whose displacements
 * are closest to a direction. Returns 0 if no combination is closer than the others. */
static int most_along(int vertices, const double *const u[2], const double direction[3],
                      double part[2])
{
    const double same = 1e-6;
    double along[3] = {0}, all[3] = {0}; /* scalar products of u[0] with itself, of u[0] with u[1],
                                            and of u[1] with itself */
    for (int v = 0; v < vertices; v++)
        for (int k = 0; k < 3; k++) {
            const double *a = u[k == 2] + NODE_COORDINATES * v,
                         *b = u[k != 0] + NODE_COORDINATES * v;
            along[k] += vec3_dot(a, direction) * vec3_dot(b, direction);
            all[k] += vec3_dot(a, b);
        }
    const double l = sqrt(all[0]), m = all[1] / l, n = sqrt(all[2] - m * m);
    const double p = along[0] / (l * l), q = (along[1] / l - m * p) / n,
                 r = (along[2] - 2 * m / l * along[1] + m * m * p) / (n * n);
    if (!(hypot(p - r, 2 * q) > same * (p + r)))
        return 0;
    const double turn = atan2(2 * q, p - r) / 2;
    part[1] = sin(turn) / n;
    part[0] = (cos(turn) - m * part[1]) / l;
    return 1;
}

static void name_mode(const scene *s, const scene_imperfection *p, char text[FAULT_TEXT])
{
    snprintf(text, FAULT_TEXT, "mode %d of %s", p->order,
             scene_called(s, SCENE_ANALYSES, p->analysis).text);
}

static status mode_of(const analysis_context *c, int index, double out[], fault *f)
{
    const scene_imperfection *p = &c->scene->imperfection[index];
    const analysis_outcome *o = &c->outcomes[p->analysis];
    const scene_words owner_name = scene_called(c->scene, SCENE_IMPERFECTIONS, index);
    const model_size size = model_sizes(c->model);
    const size_t n = (size_t)size.free;
    char mode[FAULT_TEXT];
    name_mode(c->scene, p, mode);
    if (o->status != STATUS_OK)
        return fault_set(f, o->status, "%s: %s has failed: %.200s", owner_name.text, mode,
                         o->reason);
    const outcome_side *side = &outcome_spectrum_of(o)->positive;
    if (p->order >= side->count || side->mode == NULL || isnan(side->value[p->order]))
        return fault_set(f, STATUS_REFUSED, "%s: there is no %s%s%.150s", owner_name.text, mode,
                         side->reason[0] != '\0' ? ": " : "", side->reason);
    const same_modes same = same_as(side, p->order);
    memcpy(out, side->mode + n * (size_t)p->order, n * sizeof *out);
    if (same.count == 1)
        return STATUS_OK;
    if (same.count > 2 || vec3_norm(p->direction) == 0)
        return fault_set(f, STATUS_REFUSED, "%s: %s is one of %d modes with the same value; %s",
                         owner_name.text, mode, same.count,
                         same.count > 2
                             ? "give shifts of nodes, or make the structure less symmetric"
                             : "give its direction as [x, y, z]");
    double *u = calloc(2 * ((size_t)size.vertices * NODE_COORDINATES + n + (size_t)size.driven) + 1,
                       sizeof *u);
    if (u == NULL)
        return fault_memory(f, "imperfections");
    const double *const both[2] = {u, u + (size_t)size.vertices * NODE_COORDINATES};
    double *x = u + 2 * (size_t)size.vertices * NODE_COORDINATES, part[2];
    for (int k = 0; k < 2; k++) {
        memcpy(x, side->mode + n * (size_t)same.mode[k], n * sizeof *x);
        model_shape(c->model, x, u + (size_t)k * (size_t)size.vertices * NODE_COORDINATES, NULL);
    }
    const int found = most_along(size.vertices, both, p->direction, part);
    for (size_t i = 0; i < n && found; i++)
        out[i] = part[0] * side->mode[n * (size_t)same.mode[0] + i] +
                 part[1] * side->mode[n * (size_t)same.mode[1] + i];
    free(u);
    return found ? STATUS_OK
                 : fault_set(f, STATUS_REFUSED,
                             "%s: modes %d and %d have the same value, and all their combinations "
                             "are equally close to the direction; give another direction",
                             owner_name.text, same.mode[0], same.mode[1]);
}

/* Returns the sign, 1 or -1, for which the largest displacement of the shift is along the requested
 * direction; 0: it is perpendicular to this direction. If no direction is given, the largest
 * component of the shift becomes positive. */
static double sign_of(const scene_imperfection *p, const double shift[3])
{
    const double least = 1e-6, size = vec3_norm(shift), along = vec3_dot(shift, p->direction);
    if (vec3_norm(p->direction) > 0)
        return fabs(along) <= least * size * vec3_norm(p->direction) ? 0 : copysign(1, along);
    int k = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(shift[i]) > fabs(shift[k]) + least * size)
            k = i;
    return copysign(1, shift[k]);
}

static status add_mode(const analysis_context *c, int index, double mode[], double x[], fault *f)
{
    const scene_imperfection *p = &c->scene->imperfection[index];
    const model_size size = model_sizes(c->model);
    double shift[3];
    TRY(mode_of(c, index, mode, f));
    model_largest_shift(c->model, mode, shift);
    const double most = vec3_norm(shift), sign = sign_of(p, shift);
    if (!(most > 0) || sign == 0)
        return fault_set(f, STATUS_REFUSED, "%s: the mode %s; give another mode%s",
                         scene_called(c->scene, SCENE_IMPERFECTIONS, index).text,
                         most > 0
                             ? "has its largest displacement perpendicular to the given direction"
                             : "shifts no member",
                         most > 0 ? " or direction" : "");
    for (int i = 0; i < size.free; i++)
        x[i] += sign * p->amplitude / most * mode[i];
    return STATUS_OK;
}

status imperfection_of_modes(const analysis_context *c, double x[], fault *f)
{
    const model_size size = model_sizes(c->model);
    double *mode = calloc((size_t)(size.free + size.driven) + 1, sizeof *mode);
    status outcome = mode != NULL ? STATUS_OK : fault_memory(f, "imperfections");
    for (int i = 0; i < c->scene->imperfections && outcome == STATUS_OK; i++)
        if (c->scene->imperfection[i].analysis != SCENE_NONE)
            outcome = add_mode(c, i, mode, x, f);
    free(mode);
    return outcome;
}
