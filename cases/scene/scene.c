#include "cases/scene/scene_impl.h"

#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

void scene_init(scene *s, const char *name)
{
    memset(s, 0, sizeof *s);
    snprintf(s->name, sizeof s->name, "%s", name);
}

void scene_free(scene *s)
{
    for (int i = 0; i < s->drivers; i++) {
        free(s->driver[i].path);
        free(s->driver[i].value);
        function_free(&s->driver[i].function);
    }
    for (int i = 0; i < s->loads; i++) {
        free(s->load[i].path);
        free(s->load[i].factor);
        function_free(&s->load[i].function);
    }
    for (int i = 0; i < s->analyses; i++) {
        if (scene_path_of(&s->analysis[i]) != NULL)
            free(scene_path_of(&s->analysis[i])->value);
        free(s->analysis[i].damping.ratios.value);
    }
    for (int i = 0; i < s->quantities; i++)
        free(s->quantity[i].over);
    for (int i = 0; i < s->combinations; i++)
        free(s->combination[i].term);
    for (int i = 0; i < s->constraints; i++)
        free(s->constraint[i].node);
    free(s->constraint);
    for (int i = 0; i < s->imperfections; i++) {
        free(s->imperfection[i].node);
        free(s->imperfection[i].shift);
    }
    free(s->imperfection);
    free(s->load_case);
    free(s->combination);
    free(s->section);
    free(s->computed);
    free(s->node);
    free(s->member);
    for (int i = 0; i < s->springs; i++)
        for (int k = 0; k < 6; k++) {
            free(s->spring[i].table[k].at.value);
            free(s->spring[i].table[k].value.value);
        }
    free(s->spring);
    free(s->driver);
    free(s->load);
    free(s->analysis);
    free(s->quantity);
    memset(s, 0, sizeof *s);
}

int scene_add_section(scene *s, const section_spec *spec)
{
    const int i = scene_grow(s, &s->section, &s->sections, sizeof *s->section);
    if (i >= 0)
        s->section[i] = *spec;
    if (i >= 0)
        scene_grow(s, &s->computed, &s->computeds, sizeof *s->computed);
    return i;
}

/* Compares bits, so that equal NaNs are equal. Different padding only causes an unnecessary
 * computation. */
static int same_bits(const void *a, const void *b, size_t size)
{
    return memcmp(a, b, size) == 0;
}

status scene_constants(const scene *s, int i, section *out, fault *f)
{
    scene_computed *c = i < s->computeds ? &s->computed[i] : NULL;
    if (c != NULL && c->known && same_bits(&c->of, &s->section[i], sizeof c->of)) {
        *out = c->constants;
        return STATUS_OK;
    }
    TRY(section_compute(&s->section[i], out, f));
    if (c != NULL) {
        memcpy(&c->of, &s->section[i], sizeof c->of);
        c->constants = *out;
        c->known = 1;
    }
    return STATUS_OK;
}

scene_node *scene_node_at(scene *s, int i)
{
    return i >= 0 && i < s->nodes ? &s->node[i] : &s->scrap.node;
}

scene_member *scene_member_at(scene *s, int i)
{
    return i >= 0 && i < s->members ? &s->member[i] : &s->scrap.member;
}

int scene_add_node(scene *s, double x, double y, double z)
{
    const int i = scene_grow(s, &s->node, &s->nodes, sizeof *s->node);
    scene_node *n = scene_node_at(s, i);
    n->position[0] = x;
    n->position[1] = y;
    n->position[2] = z;
    n->attached = SCENE_NONE;
    for (int k = 0; k < 3; k++)
        n->translation[k] = n->angle[k] = SCENE_FREE;
    return i;
}

int scene_add_attached(scene *s, int body, double x, double y, double z)
{
    const int i = scene_add_node(s, x, y, z);
    scene_node_at(s, i)->attached = body;
    return i;
}

int scene_add_member(scene *s, int p, int q, int profile, const double y_axis[3])
{
    const int i = scene_grow(s, &s->member, &s->members, sizeof *s->member);
    scene_member *m = scene_member_at(s, i);
    m->p = p;
    m->q = q;
    m->section = m->section_q = profile;
    memcpy(m->y_axis, y_axis, sizeof m->y_axis);
    m->warp_p = m->warp_q = SCENE_WARP_FREE;
    m->half_waves = 1;
    return i;
}

int scene_member_tapers(const scene_member *m)
{
    return m->section_q != m->section;
}

int scene_tapers(const scene *s)
{
    for (int i = 0; i < s->members; i++)
        if (scene_member_tapers(&s->member[i]))
            return 1;
    return 0;
}

void scene_end(const scene *s, int member, int end, double at[3])
{
    const scene_member *m = &s->member[member];
    for (int k = 0; k < 3; k++)
        at[k] = s->node[end ? m->q : m->p].position[k] + m->offset[end][k];
}

void scene_chord(const scene *s, int member, double chord[3])
{
    double p[3], q[3];
    scene_end(s, member, 0, p);
    scene_end(s, member, 1, q);
    for (int k = 0; k < 3; k++)
        chord[k] = q[k] - p[k];
}

int scene_is_beside(const scene_member *m, int end)
{
    return vec3_norm(m->offset[end]) > 0;
}

int scene_is_founded(const scene_member *m)
{
    return vec3_norm(m->foundation) + vec3_norm(m->foundation + 3) > 0;
}

void scene_release_end(scene *s, int member, int end, int component)
{
    scene_release *r = &scene_member_at(s, member)->release[end];
    if (r->count < SCENE_RELEASED)
        r->component[r->count] = component;
    r->count++;
}

static int add_driver(scene *s, const char *name)
{
    const int i = scene_grow(s, &s->driver, &s->drivers, sizeof *s->driver);
    if (i >= 0) {
        snprintf(s->driver[i].name, SCENE_NAME, "%s", name);
        s->driver[i].condition_node = s->driver[i].condition_driver = SCENE_NONE;
        s->driver[i].load_case = SCENE_NONE;
    }
    return i;
}

int scene_add_driver(scene *s, const char *name, int stations, const double path[],
                     const double value[])
{
    const int i = add_driver(s, name);
    if (i >= 0) {
        s->driver[i].stations = stations;
        s->driver[i].path = scene_copy(s, stations, path);
        s->driver[i].value = scene_copy(s, stations, value);
    }
    return i;
}

int scene_add_moving_driver(scene *s, const char *name)
{
    const double none = 0;
    return scene_add_driver(s, name, 1, &none, &none);
}

void scene_drive_piece(scene *s, int driver, double until, const char *text)
{
    if (driver >= 0 && function_add(&s->driver[driver].function, until, text) < 0)
        s->out_of_memory = 1;
}

void scene_load_piece(scene *s, int load, double until, const char *text)
{
    if (load >= 0 && function_add(&s->load[load].function, until, text) < 0)
        s->out_of_memory = 1;
}

int scene_add_unknown_driver(scene *s, const char *name, int node, int component,
                             int condition_driver)
{
    const int i = add_driver(s, name);
    if (i >= 0) {
        s->driver[i].condition_node = node;
        s->driver[i].condition_component = component;
        s->driver[i].condition_driver = condition_driver;
    }
    return i;
}

static int *component_of(scene_node *n, int component)
{
    return component < SCENE_RX ? &n->translation[component] : &n->angle[component - SCENE_RX];
}

void scene_hold(scene *s, int node, int first, int last)
{
    for (int c = first; c <= last; c++)
        *component_of(scene_node_at(s, node), c) = SCENE_HELD;
}

void scene_hold_all(scene *s, int node)
{
    scene_hold(s, node, SCENE_UX, SCENE_RZ);
}

void scene_drive(scene *s, int node, int component, int driver)
{
    *component_of(scene_node_at(s, node), component) = driver;
}

int scene_node_axes(const scene_node *n, double R[9])
{
    static const double scene_axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    memcpy(R, scene_axes, sizeof scene_axes);
    if (!(vec3_norm(n->axes[0]) > 0))
        return 0;
    rotation_triad(n->axes[0], n->axes[1], R);
    int differ = 0;
    for (int i = 0; i < 9; i++)
        differ |= R[i] != scene_axes[i];
    return differ;
}

int scene_node_coordinate(const scene_node *n, int component)
{
    const int turn = component - SCENE_RX;
    double R[9];
    if (turn < 0 || n->rotation != SCENE_ROTATION_SEQUENCE)
        return component;
    scene_node_axes(n, R);
    for (int k = 0; k < 3; k++) {
        const double along =
            R[turn] * n->axis[k][0] + R[3 + turn] * n->axis[k][1] + R[6 + turn] * n->axis[k][2];
        if (along > 0 && along >= (1 - 1e-14) * vec3_norm(n->axis[k]))
            return SCENE_RX + k;
    }
    return component;
}

void scene_fork(scene *s, int node, const double axis[3], const double web[3])
{
    scene_node *n = scene_node_at(s, node);
    n->rotation = SCENE_ROTATION_FORK;
    memcpy(n->axis[0], axis, sizeof n->axis[0]);
    memcpy(n->axis[1], web, sizeof n->axis[1]);
}

void scene_set_body(scene *s, int node, scene_body body)
{
    scene_node_at(s, node)->body = body;
}

int scene_has_body(const scene_node *n)
{
    int has = n->body.mass != 0;
    for (int i = 0; i < 6; i++)
        has |= n->body.inertia[i] != 0;
    return has;
}

static int is_massive(const scene *s, int index)
{
    section c;
    if (scene_constants(s, index, &c, NULL) != STATUS_OK || c.density > 0)
        return 1;
    for (int k = 0; k < 36; k++)
        if (c.mass[k] != 0)
            return 1;
    return 0;
}

int scene_driver_turns(const scene *s, int driver)
{
    for (int i = 0; i < s->nodes; i++)
        for (int k = 0; k < 3; k++)
            if (s->node[i].translation[k] == driver)
                return 0;
    return 1;
}

int scene_has_mass(const scene *s)
{
    for (int i = 0; i < s->nodes; i++)
        if (scene_has_body(&s->node[i]))
            return 1;
    for (int i = 0; i < s->members; i++)
        if (is_massive(s, s->member[i].section) || is_massive(s, s->member[i].section_q))
            return 1;
    return 0;
}

int scene_normal(const scene *s)
{
    return s->plane == SCENE_SPACE ? SCENE_NONE : (int)s->plane - (int)SCENE_PLANE_YZ;
}

const char *scene_plane_name(const scene *s)
{
    static const char *const name[] = {"", "yz", "xz", "xy"};
    return name[s->plane];
}

void scene_omit(scene *s, unsigned features)
{
    s->omits |= features & SCENE_OMITTABLE;
}

void scene_demand(scene *s, unsigned features)
{
    s->demands |= features;
}

void scene_meshes(scene *s, int count, const int mesh[])
{
    s->meshes = count < SCENE_MESHES ? count : SCENE_MESHES;
    memcpy(s->mesh, mesh, (size_t)s->meshes * sizeof *mesh);
}

void scene_meshes_doubled(scene *s, int first, int last)
{
    s->meshes = 0;
    for (int n = first; n <= last && s->meshes < SCENE_MESHES; n *= 2)
        s->mesh[s->meshes++] = n;
}

const char *scene_convention(const scene *s, const scene_quantity *q)
{
    const scene_quantity_kind kind = q->what.kind;
    const int matrix = kind == SCENE_COMPLIANCE_ENTRY || kind == SCENE_STIFFNESS_ENTRY;
    return matrix && q->analysis >= 0 && q->analysis < s->analyses
               ? scene_moments_name(scene_compliance_of(&s->analysis[q->analysis])->moments)
               : NULL;
}
