/* The program with one injected fault, whose size the environment specifies:
 *   BEAMWORK_PLANT=NAME=SIZE   multiplies one constant of all elements, or one kind of loads, by
 *                              1 + SIZE; not set: no fault
 *   BEAMWORK_PLANT_MESHES=N    uses only the N coarsest meshes, without measuring their scatter
 * It wraps functions at link time (Makefile: --wrap), so the sources of the program do not
 * change. A fault in a stiffness affects only stresses, a fault in a mass only inertia: each
 * element is prepared twice, and other uses of the section do not change. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/case.h"
#include "elements/element.h"
#include "elements/shared/masses.h"
#include "harness/study/study.h"

status __real_adapters_complete(const element_type *, const double[], element_type *, fault *);
status __wrap_adapters_complete(const element_type *, const double[], element_type *, fault *);
status __real_case_build(const case_type *, const double[], scene *, fault *);
status __wrap_case_build(const case_type *, const double[], scene *, fault *);
lumped_mass __real_lumped_of(const section *, unsigned, double);
lumped_mass __wrap_lumped_of(const section *, unsigned, double);
int __real_evaluation_needs_scatter(const sweep *, const truths *, int);
int __wrap_evaluation_needs_scatter(const sweep *, const truths *, int);

/* Returns 1 + size if this fault is injected, otherwise 1. */
static double grown(const char *name)
{
    const char *planted = getenv("BEAMWORK_PLANT");
    const size_t length = strlen(name);
    const int here =
        planted != NULL && strncmp(planted, name, length) == 0 && planted[length] == '=';
    return here ? 1 + strtod(planted + length + 1, NULL) : 1;
}

static void scale(double M[], int size, int at, double by)
{
    for (int i = 0; i < size; i++) {
        M[i * size + at] *= sqrt(by);
        M[at * size + i] *= sqrt(by);
    }
}

static void scale_shear(section *c, int at, double by)
{
    scale(c->D, 3, at, by);
    scale(c->F, 3, at, 1 / by);
}

/* stiff returns the section with a changed stiffness, and heavy returns the section with a changed
 * mass. Neither change affects the other property. */
static section stiff(const section *given)
{
    /* names in the order of the rows of a section given by matrices: N, Qy, Qz, Mx, My, Mz */
    static const char *const names[] = {"EA", "GAy", "GAz", "GIt", "EIy", "EIz"};
    section c = *given;
    for (int i = 0; c.matrices && i < 6; i++)
        scale(c.stiffness, 6, i, grown(names[i]));
    if (c.matrices)
        return c;
    c.A *= grown("EA");
    c.Ip *= grown("EA"); /* Ip/A determines the shortening due to twist */
    c.Iy *= grown("EIy");
    c.wagner_z *= grown("EIy");
    c.Iz *= grown("EIz");
    c.wagner_y *= grown("EIz");
    c.It *= grown("GIt");
    c.Iw *= grown("EIw");
    c.wagner_torque *= grown("wagner_torque");
    scale_shear(&c, 0, grown("GAy"));
    scale_shear(&c, 1, grown("GAz"));
    scale_shear(&c, 2, grown("GAw"));
    return c;
}

static section heavy(const section *given)
{
    const double mass = grown("mass"), rotary = grown("rotary") / mass;
    section c = *given;
    for (int i = 0; c.matrices && i < 6; i++)
        scale(c.mass, 6, i, grown(i < 3 ? "mass" : "rotary"));
    c.density *= mass;
    c.young /= rotary; /* the displacement field on which the mass depends does not change */
    c.Iy *= rotary;
    c.Iz *= rotary;
    c.Ip *= rotary;
    c.Iw *= rotary;
    return c;
}

/* Capacity for the data of an element [bytes]. The data of the same element with the fault in its
 * mass follow. */
enum { ROOM = 1 << 16 };

typedef struct second {
    status (*inertia)(const element_data *, const node_state[], const element_rotating_frame *,
                      inertia_output *);
    double own[];
} second;

static _Thread_local int preparing;

static size_t data_size(const element_request *request)
{
    element_type whole;
    __real_adapters_complete(request->type, request->options, &whole, NULL);
    return ROOM + sizeof(second) + whole.data_size(request);
}

static status prepare(const element_request *request, element_data *out, fault *f)
{
    element_type whole;
    element_request here = *request;
    second *behind = (second *)((char *)out + ROOM);
    const section faulty = stiff(request->section), mass = heavy(request->section);
    TRY(__real_adapters_complete(request->type, request->options, &whole, f));
    if (whole.data_size(request) > ROOM)
        return fault_set(f, STATUS_FAULT, "%s: the data of the element take more than %d bytes",
                         request->type->name, ROOM);
    behind->inertia = whole.inertia;
    preparing = 1;
    here.section = &mass;
    status outcome = whole.prepare(&here, (element_data *)behind->own, f);
    here.section = &faulty;
    if (outcome == STATUS_OK)
        outcome = whole.prepare(&here, out, f);
    preparing = 0;
    return outcome;
}

static status inertia(const element_data *d, const node_state x[],
                      const element_rotating_frame *frame, inertia_output *out)
{
    const second *behind = (const second *)((const char *)d + ROOM);
    return behind->inertia((const element_data *)behind->own, x, frame, out);
}

status __wrap_adapters_complete(const element_type *given, const double options[],
                                element_type *out, fault *f)
{
    TRY(__real_adapters_complete(given, options, out, f));
    out->data_size = data_size;
    out->prepare = prepare;
    out->inertia = inertia;
    return STATUS_OK;
}

/* Changes masses that are lumped at nodes. `prepare` changes the masses of elements. */
lumped_mass __wrap_lumped_of(const section *given, unsigned features, double length)
{
    const section c = heavy(given);
    return __real_lumped_of(preparing ? given : &c, features, length);
}

static const char *name_of(const scene_load *load)
{
    switch (load->kind) {
    case SCENE_FORCE:
    case SCENE_MEMBER_FORCE:
        return "force";
    case SCENE_MOMENT:
    case SCENE_MEMBER_MOMENT:
        return "moment";
    case SCENE_GRAVITY:
    case SCENE_WEIGHT:
        return "weight";
    default:
        return "distributed";
    }
}

static void plant(scene *s)
{
    for (int i = 0; i < s->loads; i++)
        for (int k = 0; k < 3; k++) {
            s->load[i].vector[k] *= grown(name_of(&s->load[i]));
            s->load[i].last[k] *= grown(name_of(&s->load[i]));
        }
    for (int i = 0; i < s->nodes; i++) {
        s->node[i].body.mass *= grown("body");
        s->node[i].body.inertia[0] *= grown("body_inertia");
    }
    for (int i = 0; i < s->springs; i++)
        for (int k = 0; k < 36; k++)
            s->spring[i].stiffness[k] *= grown("spring");
}

static void cut_meshes(scene *s)
{
    const char *most = getenv("BEAMWORK_PLANT_MESHES");
    const int count = most != NULL ? atoi(most) : s->meshes;
    s->meshes = count < s->meshes ? count : s->meshes;
}

status __wrap_case_build(const case_type *type, const double value[], scene *out, fault *f)
{
    TRY(__real_case_build(type, value, out, f));
    plant(out);
    cut_meshes(out);
    return STATUS_OK;
}

int __wrap_evaluation_needs_scatter(const sweep *s, const truths *t, int series_index)
{
    return getenv("BEAMWORK_PLANT_MESHES") == NULL &&
           __real_evaluation_needs_scatter(s, t, series_index);
}
