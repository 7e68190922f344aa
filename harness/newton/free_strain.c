/* Stress-free strains of elements, in addition to the strains of the undeformed state. Their causes
 * are temperatures and initial strains of members. For all formulations, the stress-free strains
 * are the strains D(x) of a free element, and the strains of a state are measured from them. A type
 * whose stresses also depend on the total curvature provides element_type.unstressed. */
#include "harness/newton/newton_impl.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"

enum {
    POINTS = 6
}; /* number of points along a part of an arc; the error is round-off for rotations up to 1 rad */

/* Elongation, and curvatures [1/m] about the principal axes y and z of the section. */
enum { ELONGATION, ABOUT_Y, ABOUT_Z, AMOUNTS };

static int are_same(const double a[AMOUNTS], const double b[AMOUNTS])
{
    return a[ELONGATION] == b[ELONGATION] && a[ABOUT_Y] == b[ABOUT_Y] && a[ABOUT_Z] == b[ABOUT_Z];
}

static void add_amounts(const model *m, int element, const scene_load *load, double scale,
                        double out[AMOUNTS])
{
    const int member = model_element(m, element)->member,
              number = element - model_first_element(m, member);
    const section *c = model_section(m, model_kind_of(m, element)->section);
    double part[2];
    if (load->kind != SCENE_TEMPERATURE || load->where != member)
        return;
    for (int i = 0; i < 2; i++)
        part[i] =
            fmin(1, fmax(0, division_inside(model_division(m), member, number, load->range[i])));
    const double strain = scale * c->expansion * (part[1] - part[0]), a = cos(c->axes_angle),
                 b = sin(c->axes_angle), *along = load->gradient;
    const double ends = division_place(model_division(m), member, number, 1) -
                        division_place(model_division(m), member, number, 0),
                 length =
                     model_kind_of(m, element)->length / ends * (load->range[1] - load->range[0]);
    out[ELONGATION] +=
        strain * load->temperature + scale * load->elongation / length * (part[1] - part[0]);
    out[ABOUT_Y] += strain * (a * along[1] - b * along[0]);
    out[ABOUT_Z] -= strain * (a * along[0] + b * along[1]);
}

static void heat_at(const equations *eq, int element, double path, double out[AMOUNTS])
{
    const scene *s = model_scene(eq->m);
    memset(out, 0, AMOUNTS * sizeof *out);
    for (int i = 0; i < s->loads; i++)
        if (s->load[i].kind == SCENE_TEMPERATURE)
            add_amounts(eq->m, element, &s->load[i], applied_factor(eq, &s->load[i], path), out);
}

static void amounts_at(const equations *eq, int element, double path, double out[AMOUNTS])
{
    const double *own = model_kind_of(eq->m, element)->free;
    heat_at(eq, element, path, out);
    for (int i = 0; i < AMOUNTS; i++)
        out[i] += own[i];
}

/* Computes the derivative of the result of heat_at with respect to the path parameter or time. */
static void rates_at(const equations *eq, int element, double path, double out[AMOUNTS])
{
    const scene *s = model_scene(eq->m);
    memset(out, 0, AMOUNTS * sizeof *out);
    for (int i = 0; i < s->loads; i++) {
        const scene_load *load = &s->load[i];
        if (load->kind == SCENE_TEMPERATURE)
            add_amounts(eq->m, element, load, applied_rate(eq, load, path), out);
    }
}

typedef struct free_element {
    double length, rotation[3], strained[3]; /* length of the arc; rotation; R^T r' */
    node_state x[ELEMENT_MAX_NODES];
} free_element;

static void place(const model *m, int element, const double amounts[AMOUNTS], free_element *out)
{
    static const double along[3] = {1, 0, 0};
    const mesh_kind *k = model_kind_of(m, element);
    double drawn[3], strain[3];
    memset(out, 0, sizeof *out);
    out->length = k->length;
    for (int i = 0; i < 3; i++) {
        drawn[i] = k->curvature[i] * k->length;
        out->rotation[i] = drawn[i];
        if (i > 0)
            out->rotation[i] += amounts[i] * k->length;
        strain[i] = k->strain[i] + (i == 0 ? amounts[ELONGATION] : 0);
        out->strained[i] = along[i] + strain[i];
    }
    for (int n = 0; n < model_nodes(m); n++) {
        const double x = model_places(m)[n];
        double q[4], before[3], after[3], more[3];
        arc_at(out->rotation, out->strained, x, out->x[n].r, q);
        rotation_matrix(q, out->x[n].R);
        arc_beyond(drawn, along, x, before);
        arc_beyond(out->rotation, along, x, after);
        arc_at(out->rotation, strain, x, more, q);
        for (int i = 0; i < 3; i++) {
            out->x[n].r[i] *= k->length;
            out->x[n].u[i] = k->length * (after[i] - before[i] + more[i]);
        }
    }
}

/* Computes the linearised motion of the point at x due to a change of the amounts by `amounts`:
 * out[translation, rotation]. */
static void moved(const free_element *of, const double amounts[AMOUNTS], double x, double out[6])
{
    const double turn[3] = {0, amounts[ABOUT_Y] * of->length, amounts[ABOUT_Z] * of->length},
                 longer[3] = {amounts[ELONGATION], 0, 0};
    double at[POINTS], weight[POINTS], q[4];
    arc_at(of->rotation, longer, x, out, q);
    arc_at(of->rotation, turn, x, out + 3, q);
    quadrature_points(POINTS, at, weight);
    for (int g = 0; g < POINTS; g++) {
        double turned[3], axis[3], shift[3];
        const double t = x * at[g],
                     rotation[3] = {t * of->rotation[0], t * of->rotation[1], t * of->rotation[2]};
        arc_at(of->rotation, turn, t, turned, q);
        rotation_exp(rotation, q);
        rotation_apply(q, of->strained, axis);
        vec3_cross(turned, axis, shift);
        for (int i = 0; i < 3; i++)
            out[i] += x * weight[g] * shift[i];
    }
    for (int i = 0; i < 3; i++)
        out[i] *= of->length;
}

static void strains_by(const model *m, int element, const free_element *of,
                       const double amounts[AMOUNTS], double out[])
{
    double J[ELEMENT_MAX_STRAINS * ELEMENT_MAX_COORDINATES], dx[ELEMENT_MAX_COORDINATES] = {0};
    model_type(m)->strain(model_kind_of(m, element)->data, of->x, &(strain_output){.J = J});
    for (int n = 1; n < model_nodes(m); n++)
        moved(of, amounts, model_places(m)[n], dx + NODE_COORDINATES * n);
    dense_mul_vec(model_strains(m), model_own_coordinates(m), J, dx, out);
}

void free_strain_amounts(const equations *eq, int element, double path, double strain[3],
                         double curvature[3])
{
    double amounts[AMOUNTS];
    if (!model_frees(eq->m))
        return;
    amounts_at(eq, element, path, amounts);
    strain[0] += amounts[ELONGATION];
    curvature[1] += amounts[ABOUT_Y];
    curvature[2] += amounts[ABOUT_Z];
}

void free_strain_subtract(const equations *eq, int element, double path, double e[])
{
    static const double none[AMOUNTS];
    const model *m = eq->m;
    const mesh_kind *k = model_kind_of(m, element);
    double amounts[AMOUNTS], own[ELEMENT_MAX_STRAINS], rest[ELEMENT_MAX_STRAINS] = {0};
    free_element of;
    if (!model_frees(m) || model_type(m)->unstressed != NULL)
        return;
    amounts_at(eq, element, path, amounts);
    if (vec3_norm(amounts) == 0)
        return;
    place(m, element, amounts, &of);
    model_type(m)->strain(k->data, of.x, &(strain_output){.e = own});
    place(m, element, none, &of);
    if (vec3_norm(k->strain) > 0)
        model_type(m)->strain(k->data, of.x, &(strain_output){.e = rest});
    for (int i = 0; i < model_strains(m); i++)
        e[i] -= own[i] - rest[i];
}

typedef struct run_free {
    size_t size;     /* number of doubles per element: the amounts, followed by the data */
    double *element; /* [elements x size] */
} run_free;

status free_strain_begin(const model *m, run_free **out, fault *f)
{
    size_t most = 0;
    *out = NULL;
    if (!model_frees(m) || model_type(m)->unstressed == NULL)
        return STATUS_OK;
    for (int i = 0; i < model_kinds(m); i++)
        most = model_kind(m, i)->data_size > most ? model_kind(m, i)->data_size : most;
    const size_t aligned = sizeof(max_align_t) / sizeof(double),
                 size = ((most + AMOUNTS * sizeof(double)) / sizeof(max_align_t) + 2) * aligned;
    run_free *made = calloc(1, sizeof *made);
    double *element = calloc((size_t)model_elements(m) * size + 1, sizeof *element);
    if (made == NULL || element == NULL) {
        free(made);
        free(element);
        return fault_memory(f, "stress-free strains of elements");
    }
    *made = (run_free){size, element};
    *out = made;
    return STATUS_OK;
}

void free_strain_end(run_free *r)
{
    if (r != NULL)
        free(r->element);
    free(r);
}

const element_data *free_strain_data(const equations *eq, int element, double path)
{
    enum {
        ALIGNED = (AMOUNTS * sizeof(double) / sizeof(max_align_t) + 1) *
                  (sizeof(max_align_t) / sizeof(double))
    };
    const model *m = eq->m;
    const mesh_kind *k = model_kind_of(m, element);
    const run_free *r = eq->run->free_strain;
    double amounts[AMOUNTS];
    if (r == NULL)
        return k->data;
    amounts_at(eq, element, path, amounts);
    if (vec3_norm(amounts) == 0)
        return k->data;
    double *kept = r->element + (size_t)element * r->size;
    element_data *data = (element_data *)(void *)(kept + ALIGNED);
    if (!are_same(kept, amounts)) {
        free_element of;
        place(m, element, amounts, &of);
        model_type(m)->unstressed(k->data, amounts, of.x, data);
        memcpy(kept, amounts, sizeof amounts);
    }
    return data;
}

void free_strain_linear(const equations *eq, int element, double path, double out[])
{
    static const double none[AMOUNTS];
    double amounts[AMOUNTS];
    free_element rest;
    heat_at(eq, element, path, amounts);
    place(eq->m, element, none, &rest);
    strains_by(eq->m, element, &rest, amounts, out);
}

void free_strain_own(const model *m, int element, double out[])
{
    static const double none[AMOUNTS];
    free_element rest;
    place(m, element, none, &rest);
    strains_by(m, element, &rest, model_kind_of(m, element)->free, out);
}

double free_strain_size(const equations *eq, double path)
{
    const model *m = eq->m;
    double largest = 0;
    for (int i = 0; i < model_elements(m) && model_frees(m); i++) {
        double amounts[AMOUNTS];
        heat_at(eq, i, path, amounts);
        largest = fmax(largest, fabs(amounts[ELONGATION]) +
                                    hypot(amounts[ABOUT_Y], amounts[ABOUT_Z]) * model_length(m));
    }
    return largest;
}

int free_strain_by_load(const equations *eq, const model_state *s, int element,
                        const scene_load *load, double scale, double out[])
{
    static const double none[AMOUNTS];
    const model *m = eq->m;
    double amounts[AMOUNTS] = {0}, present[AMOUNTS];
    free_element of;
    add_amounts(m, element, load, scale, amounts);
    if (vec3_norm(amounts) == 0)
        return 0;
    amounts_at(eq, element, s->path, present);
    place(m, element, s == kinematics_rest(m) ? none : present, &of);
    strains_by(m, element, &of, amounts, out);
    return 1;
}

/* Returns the energy of an element for the given amounts, and for its strains and inner unknowns in
 * the state. The type must have `unstressed`. room: memory for the data. */
static double energy_with(const equations *eq, const model_state *s, int element,
                          const double amounts[AMOUNTS], element_data *room)
{
    const model *m = eq->m;
    double energy = 0;
    free_element of;
    place(m, element, amounts, &of);
    model_type(m)->unstressed(model_kind_of(m, element)->data, amounts, of.x, room);
    (void)model_type(m)->stress(room, &s->e[(size_t)element * (size_t)model_strains(m)],
                                &s->inner[(size_t)element * (size_t)model_inner(m)],
                                &(stress_output){.energy = &energy});
    return energy;
}

/* Returns the energy gained by an element in a state when its free strains change from `before` to
 * `after` at constant stresses. */
static double counted(const equations *eq, const model_state *s, int element,
                      const double before[AMOUNTS], const double after[AMOUNTS])
{
    const model *m = eq->m;
    const double *sigma = &s->sigma[(size_t)element * (size_t)model_strains(m)];
    double first[ELEMENT_MAX_STRAINS], last[ELEMENT_MAX_STRAINS], sum = 0;
    free_element of;
    place(m, element, before, &of);
    model_type(m)->strain(model_kind_of(m, element)->data, of.x, &(strain_output){.e = first});
    place(m, element, after, &of);
    model_type(m)->strain(model_kind_of(m, element)->data, of.x, &(strain_output){.e = last});
    for (int k = 0; k < model_strains(m); k++)
        sum -= sigma[k] * (last[k] - first[k]);
    return sum;
}

static double gained(const equations *eq, const model_state *s, int element,
                     const double before[AMOUNTS], const double after[AMOUNTS])
{
    const mesh_kind *k = model_kind_of(eq->m, element);
    if (model_type(eq->m)->unstressed == NULL)
        return counted(eq, s, element, before, after);
    max_align_t *room = malloc(k->data_size + sizeof *room);
    if (room == NULL)
        return NAN;
    const double energy = energy_with(eq, s, element, after, (element_data *)(void *)room) -
                          energy_with(eq, s, element, before, (element_data *)(void *)room);
    free(room);
    return energy;
}

double free_strain_power(const equations *eq, const model_state *s, double time)
{
    const double small = 1e-4;
    const model *m = eq->m;
    double power = 0;
    for (int i = 0; i < model_elements(m) && model_frees(m); i++) {
        double amounts[AMOUNTS], rates[AMOUNTS], before[AMOUNTS], after[AMOUNTS];
        rates_at(eq, i, time, rates);
        const double l = model_kind_of(m, i)->length,
                     size = fabs(rates[ELONGATION]) + l * hypot(rates[ABOUT_Y], rates[ABOUT_Z]);
        if (size == 0)
            continue;
        amounts_at(eq, i, time, amounts);
        for (int k = 0; k < AMOUNTS; k++) {
            before[k] = amounts[k] - small / size * rates[k];
            after[k] = amounts[k] + small / size * rates[k];
        }
        power += gained(eq, s, i, before, after) / (2 * small / size);
    }
    return power;
}

double free_strain_work(const equations *eq, const model_state *from, double begin,
                        const model_state *to, double end)
{
    const model *m = eq->m;
    double work = 0;
    for (int i = 0; i < model_elements(m) && model_frees(m); i++) {
        double before[AMOUNTS], after[AMOUNTS];
        amounts_at(eq, i, begin, before);
        amounts_at(eq, i, end, after);
        if (!are_same(before, after))
            work += (gained(eq, from, i, before, after) + gained(eq, to, i, before, after)) / 2;
    }
    return work;
}
