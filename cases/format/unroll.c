#include "cases/format/format_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/shared/choice.h"

typedef struct unroller {
    arena *arena;
    mistakes *mistakes;
    unrolled *list;
    int count, failed;
    const document_node *key, *value;
} unroller;

static void add(unroller *u, const scope *names)
{
    const document_node *place = u->key != NULL ? u->key : u->value;
    if (u->count == UNROLL_MOST) {
        document_mistake(u->mistakes, place, 0,
                         "the loops expand to more than %d entries; reduce their ranges",
                         UNROLL_MOST);
        u->failed = 1;
        return;
    }
    const scope *inner = unroll_let(document_find(u->value, "let"), names, u->arena, u->mistakes);
    if (!choose_holds(document_find(u->value, "if"), inner, u->mistakes))
        return;
    u->list = arena_grow(u->arena, u->list, u->count, sizeof *u->list);
    const document_node *value = substitute_node(u->value, inner, u->arena, u->mistakes);
    const document_node *name =
        u->key != NULL ? substitute_node(u->key, inner, u->arena, u->mistakes) : NULL;
    if (u->list == NULL || value == NULL || (u->key != NULL && name == NULL)) {
        u->mistakes->out_of_memory |= u->arena->failed;
        u->failed = 1;
        u->count = 0;
        return;
    }
    u->list[u->count++] =
        (unrolled){name != NULL ? name->text : NULL, place, value, u->value, inner, NULL};
}

static void unroll_loops(unroller *u, const document_node *loops, int depth, const scope *names);

/* Returns 1 if a value of a loop is a word, not an expression with known names. */
static int is_word(const document_node *n, const scope *names)
{
    const size_t length = n->kind == DOCUMENT_TEXT ? expression_name_length(n->text) : 0;
    return length > 0 && n->text[length] == '\0' && scope_find(names, n->text, length) == NULL;
}

static void loop_list(unroller *u, const document_node *loops, int depth, const scope *names)
{
    const document_node *list = loops->item[depth];
    const char *name = loops->key[depth]->text;
    for (int i = 0; i < list->count && !u->failed; i++) {
        const document_node *one = list->item[i];
        double value = 0;
        if (is_word(one, names))
            unroll_loops(u, loops, depth + 1, scope_word(names, name, one->text, u->arena));
        else if (expression_number(one, names, u->mistakes, &value))
            unroll_loops(u, loops, depth + 1, scope_number(names, name, value, u->arena));
        else
            u->failed = 1;
    }
}

static void loop_range(unroller *u, const document_node *loops, int depth, const scope *names)
{
    double *value;
    const int count = range_values(loops->item[depth], names, u->arena, u->mistakes, &value);
    u->failed |= count < 0;
    for (int i = 0; i < count && !u->failed; i++)
        unroll_loops(u, loops, depth + 1,
                     scope_number(names, loops->key[depth]->text, value[i], u->arena));
}

static void unroll_loops(unroller *u, const document_node *loops, int depth, const scope *names)
{
    if (loops == NULL || depth == loops->count) {
        add(u, names);
        return;
    }
    if (!scope_accepts(names, loops->key[depth], u->mistakes))
        u->failed = 1;
    else if (loops->item[depth]->kind == DOCUMENT_LIST)
        loop_list(u, loops, depth, names);
    else
        loop_range(u, loops, depth, names);
}

int unroll_entries(const document_node *collection, const scope *names, arena *a, mistakes *m,
                   unrolled **out)
{
    unroller u = {.arena = a, .mistakes = m};
    const int entries =
        collection != NULL && collection->kind != DOCUMENT_TEXT ? collection->count : 0;
    for (int i = 0; i < entries && u.count < UNROLL_MOST && !m->out_of_memory; i++) {
        u.key = collection->kind == DOCUMENT_MAP ? collection->key[i] : NULL;
        u.value = collection->item[i];
        u.failed = 0;
        const document_node *loops = document_find(u.value, "for");
        if (loops != NULL && loops->kind != DOCUMENT_MAP)
            document_mistake(m, loops, 0, "'for' must be a map, such as for: {i: 0..5}");
        else
            unroll_loops(&u, loops, 0, names);
    }
    *out = u.list;
    return u.count;
}

static const scope *add_let(const document_node *key, const document_node *value_node,
                            const scope *names, arena *a, mistakes *m)
{
    double value;
    const document_node *n = choose_value(value_node, names, m);
    if (n != NULL && n != value_node && is_word(n, names))
        return scope_word(names, key->text, n->text, a);
    if (n == NULL || !expression_number(n, names, m, &value))
        value = NAN;
    return scope_number(names, key->text, value, a);
}

const scope *unroll_let(const document_node *let, const scope *names, arena *a, mistakes *m)
{
    if (let != NULL && let->kind != DOCUMENT_MAP)
        document_mistake(m, let, 0, "'let' must be a map, such as let: {name: expression}");
    if (let == NULL || let->kind != DOCUMENT_MAP)
        return names;
    for (int i = 0; i < let->count; i++) {
        const int accepted = scope_accepts(names, let->key[i], m);
        const scope *with = add_let(let->key[i], let->item[i], names, a, m);
        names = accepted ? with : names;
    }
    return names;
}

static const scope *find(const document_node *key, const scope *names, mistakes *m)
{
    const scope *known = scope_find(names, key->text, strlen(key->text));
    char remedy[FAULT_TEXT];
    if (known == NULL)
        document_mistake(m, key, 0, "unknown name '%.40s'%s", key->text,
                         mistakes_remedy(scope_nearest(names, key->text),
                                         "; give a name from 'parameters', 'let' or 'for'",
                                         remedy));
    return known;
}

/* Returns 1 if the node equals the value of the name, 0 if not, or -1 after an error. */
static int has_value(const scope *known, const document_node *n, const scope *names, mistakes *m)
{
    double value;
    if (known->word == NULL)
        return expression_number(n, names, m, &value) ? value == known->number : -1;
    const int is_text = n->kind == DOCUMENT_TEXT;
    if (is_text && (known->choices == NULL || choice_index(known->choices, n->text) >= 0))
        return strcmp(known->word, n->text) == 0;
    document_mistake(m, n, 0, "%s cannot be %s%.40s%s; give %s%s", known->name, is_text ? "'" : "",
                     is_text ? n->text : "a list or map", is_text ? "'" : "",
                     known->choices != NULL ? "one of " : "a word",
                     known->choices != NULL ? known->choices : "");
    return -1;
}

static int has_one_of(const scope *known, const document_node *n, const scope *names, mistakes *m)
{
    int has = n->kind == DOCUMENT_LIST ? 0 : has_value(known, n, names, m);
    for (int i = 0; n->kind == DOCUMENT_LIST && i < n->count; i++) {
        const int one = has_value(known, n->item[i], names, m);
        has = one < 0 ? one : has | one;
    }
    return has > 0;
}

int choose_holds(const document_node *conditions, const scope *names, mistakes *m)
{
    if (conditions != NULL && conditions->kind != DOCUMENT_MAP)
        document_mistake(m, conditions, 0,
                         "'if' must be a map: if: {NAME: VALUE, NAME: [VALUE, ...]}");
    int holds = conditions == NULL || conditions->kind == DOCUMENT_MAP;
    for (int i = 0; holds && conditions != NULL && i < conditions->count; i++) {
        const scope *known = find(conditions->key[i], names, m);
        holds = known != NULL && has_one_of(known, conditions->item[i], names, m);
    }
    return holds;
}

/* Returns the entry of the matching key or of `else`, or NULL if there is no such entry or after an
 * error. */
static const document_node *entry_of(const scope *known, const document_node *map,
                                     const scope *names, mistakes *m)
{
    const document_node *found = document_find(map, "else");
    for (int i = 0; i < map->count; i++) {
        if (strcmp(map->key[i]->text, "else") == 0)
            continue;
        const int has = has_value(known, map->key[i], names, m);
        if (has != 0)
            found = has > 0 ? map->item[i] : NULL;
    }
    return found;
}

const document_node *choose_value(const document_node *n, const scope *names, mistakes *m)
{
    if (n->kind != DOCUMENT_MAP)
        return n;
    if (n->count != 1 || n->item[0]->kind != DOCUMENT_MAP) {
        document_mistake(m, n, 0,
                         "a choice must depend on one name: {NAME: {VALUE: ..., else: ...}}");
        return NULL;
    }
    const int before = m->count;
    const scope *known = find(n->key[0], names, m);
    const document_node *found = known != NULL ? entry_of(known, n->item[0], names, m) : NULL;
    if (found == NULL && m->count == before)
        document_mistake(m, n->key[0], 0,
                         "the choice has no entry for the current value of %s; add one, or "
                         "'else: ...'",
                         n->key[0]->text);
    return found != NULL ? choose_value(found, names, m) : NULL;
}

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

void mistake_axes(mistakes *m, const document_node *axes)
{
    document_mistake(m, axes, 0,
                     "axes: the two directions are not perpendicular, or one of them is zero; give "
                     "two perpendicular directions");
}

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
        mistake_axes(m, axes);
    p->turned = 1;
}

static void read_turn(const document_node *turn, const scope *names, mistakes *m, placement *p)
{
    static const char axis[] = "x|y|z";
    double phi[3] = {0}, angle, q[4];
    if (turn->count != 1) {
        document_mistake(
            m, turn, 0,
            "turn: one angle is expected, such as {z: pi/2}; for other rotations give 'axes'");
        return;
    }
    if (expression_number(turn->item[0], names, m, &angle))
        phi[choice_index(axis, turn->key[0]->text)] = angle;
    rotation_exp(phi, q);
    rotation_matrix(q, p->R);
    p->turned = 1;
}

static int is_port(const document_node *places, const char *name)
{
    for (int i = 0; places != NULL && i < places->count; i++)
        if (places->item[i]->kind == DOCUMENT_TEXT && strcmp(places->item[i]->text, name) == 0)
            return 1;
    return 0;
}

static void check_ports(const document_node *part, const unrolled *instance, const placement *p,
                        mistakes *m)
{
    const document_node *places = document_find(part, "places");
    const int ports = places != NULL && places->kind == DOCUMENT_LIST ? places->count : 0;
    const document_node *wrong = places != NULL && places->kind != DOCUMENT_LIST ? places : NULL;
    for (int i = 0; i < ports; i++) {
        const document_node *one = places->item[i];
        if (one->kind != DOCUMENT_TEXT)
            wrong = one;
        else if (placement_port(p, one->text) == NULL)
            document_mistake(m, instance->place, 0,
                             "port '%.40s' of instance '%.40s' is not connected; add connect: "
                             "{%.40s: NODE}",
                             one->text, instance->name, one->text);
    }
    if (wrong != NULL)
        document_mistake(m, wrong, 0, "places: a list of names is expected");
    for (int i = 0; p->connect != NULL && wrong == NULL && i < p->connect->count; i++)
        if (!is_port(places, p->connect->key[i]->text))
            document_mistake(m, p->connect, 0,
                             "connect: the part has no port '%.40s'; connect only the ports in its "
                             "'places'",
                             p->connect->key[i]->text);
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
                document_mistake(
                    m, own[i].place, 0,
                    "the instances expand to more than %d entries; reduce their number",
                    UNROLL_MOST);
                return;
            }
            own[i].name = full_name(p, own[i].name, a);
            own[i].placed = p;
            list[k] = arena_grow(a, list[k], count[k], sizeof *list[k]);
            if (list[k] == NULL || own[i].name == NULL) {
                count[k] = 0;
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
