#include "cases/format/placement.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases/format/expression.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/shared/choice.h"

const char *const placement_list[PLACEMENT_LISTS] = {"nodes", "members", "springs", "loads"};

static void rotate(const double R[9], double v[3])
{
    const double before[3] = {v[0], v[1], v[2]};
    mat3_mul_vec(R, before, v);
}

void placement_turn(const placement *p, double v[3])
{
    if (p != NULL && p->turned)
        rotate(p->R, v);
}

void placement_move(const placement *p, double at[3])
{
    if (p == NULL)
        return;
    placement_turn(p, at);
    for (int i = 0; i < 3; i++)
        at[i] += p->origin[i];
}

const document_node *placement_port(const placement *p, const char *name)
{
    return p != NULL ? document_find(p->connect, name) : NULL;
}

/* axes: {x: [3], z: [3]}, of any length, at right angles. */
static void read_axes(const document_node *axes, const scope *names, mistakes *m, placement *p)
{
    double x[3], z[3], y[3];
    const int read = expression_vector(document_find(axes, "x"), 3, names, m, x) &
                     expression_vector(document_find(axes, "z"), 3, names, m, z);
    vec3_cross(z, x, y);
    if (!read)
        return;
    if (!(fabs(vec3_dot(x, z)) <= 1e-9 * vec3_norm(x) * vec3_norm(z)) ||
        rotation_triad(x, y, p->R) != 0)
        document_mistake(m, axes, 0, "x and z are not at right angles; give two that are");
    p->turned = 1;
}

/* turn: {z: angle}, about one axis of the scene. */
static void read_turn(const document_node *turn, const scope *names, mistakes *m, placement *p)
{
    static const char axis[] = "x|y|z";
    double phi[3] = {0}, angle, q[4];
    if (turn->count != 1) {
        document_mistake(m, turn, 0, "turn: one angle is expected, as {z: pi/2}; give 'axes' else");
        return;
    }
    if (expression_number(turn->item[0], names, m, &angle))
        phi[choice_index(axis, turn->key[0]->text)] = angle;
    rotation_exp(phi, q);
    rotation_matrix(q, p->R);
    p->turned = 1;
}

/* Every place of the part is connected, and nothing else is. */
static void check_ports(const document_node *part, const unrolled *instance, const placement *p,
                        mistakes *m)
{
    const document_node *places = document_find(part, "places");
    const int ports = places != NULL && places->kind == DOCUMENT_LIST ? places->count : 0;
    int connected = 0;
    for (int i = 0; i < ports; i++) {
        const document_node *one = places->item[i];
        if (one->kind != DOCUMENT_TEXT)
            document_mistake(m, one, 0, "places: a list of names is expected");
        else if (placement_port(p, one->text) == NULL)
            document_mistake(m, instance->place, 0,
                             "%.40s: '%.40s' is not connected; add connect: {%.40s: NODE}",
                             instance->name, one->text, one->text);
        else
            connected++;
    }
    if (places != NULL && places->kind != DOCUMENT_LIST)
        document_mistake(m, places, 0, "places: a list of names is expected");
    else if (p->connect != NULL && p->connect->count > connected)
        document_mistake(m, p->connect, 0, "the part has %d places, not %d; connect those", ports,
                         p->connect->count);
}

static const placement *read_placement(const document_node *part, const unrolled *instance,
                                       arena *a, mistakes *m)
{
    placement *p = arena_take(a, sizeof *p);
    if (p == NULL)
        return NULL;
    const document_node *axes = document_find(instance->value, "axes"),
                        *turn = document_find(instance->value, "turn");
    p->name = instance->name;
    p->connect = document_find(instance->value, "connect");
    expression_vector(document_find(instance->value, "at"), 3, instance->names, m, p->origin);
    if (axes != NULL)
        read_axes(axes, instance->names, m, p);
    if (turn != NULL)
        read_turn(turn, instance->names, m, p);
    check_ports(part, instance, p, m);
    return p;
}

/* "INSTANCE.ENTRY"; NULL when memory ran out. */
static const char *full_name(const placement *p, const char *name, arena *a)
{
    char text[200];
    const int length = snprintf(text, sizeof text, "%.90s.%.90s", p->name, name);
    return arena_copy(a, text, (size_t)length);
}

static void add_entries(const document_node *part, const placement *p, const scope *names, arena *a,
                        mistakes *m, unrolled *list[], int count[])
{
    for (int k = 0; k < PLACEMENT_LISTS; k++) {
        unrolled *own;
        const int entries =
            unroll_entries(document_find(part, placement_list[k]), names, a, m, &own);
        for (int i = 0; i < entries; i++) {
            if (count[k] >= UNROLL_MOST) {
                document_mistake(m, own[i].place, 0,
                                 "more than %d entries when instances are written out",
                                 UNROLL_MOST);
                return;
            }
            own[i].name = full_name(p, own[i].name, a);
            own[i].placed = p;
            list[k] = arena_grow(a, list[k], count[k], sizeof *list[k]);
            if (list[k] == NULL || own[i].name == NULL) {
                count[k] = 0; /* memory ran out, which the arena knows */
                return;
            }
            list[k][count[k]++] = own[i];
        }
    }
}

static const char *part_at(const void *context, int i)
{
    const document_node *parts = context;
    return parts != NULL && i < parts->count ? parts->key[i]->text : NULL;
}

void placement_unroll(const document_node *root, const scope *names, arena *a, mistakes *m,
                      unrolled *list[], int count[])
{
    const document_node *parts = document_find(root, "parts");
    unrolled *instance;
    const int instances = unroll_entries(document_find(root, "instances"), names, a, m, &instance);
    for (int i = 0; i < instances && !a->failed; i++) {
        const document_node *name = document_find(instance[i].value, "part");
        const document_node *part = document_find(parts, name->text);
        char remedy[FAULT_TEXT];
        if (part == NULL) {
            document_mistake(m, name, 0, "no part '%.40s'%s", name->text,
                             mistakes_remedy(choice_nearest(name->text, part_at, parts),
                                             "; add it under 'parts'", remedy));
            continue;
        }
        const placement *p = read_placement(part, &instance[i], a, m);
        if (p != NULL)
            add_entries(part, p, unroll_let(document_find(part, "let"), names, a, m), a, m, list,
                        count);
    }
}
