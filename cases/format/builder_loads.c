#include "cases/format/format_impl.h"

#include <string.h>

static int add(const fields *f, const scene_load *what)
{
    scene *s = f->b->scene;
    double *path, *factor;
    const int load = scene_add_load(s, what->kind, what->where, 0, 0, 0);
    *scene_load_at(s, load) = *what;
    if (fields_have(f, "path") || fields_have(f, "factor")) {
        const int stations = builder_stations(f, "factor", &path, &factor);
        if (stations > 0 && load >= 0)
            scene_set_factor(s, load, stations, path, factor);
    }
    builder_function(f, load, scene_load_piece, 0);
    return load;
}

static void mistake_at(const fields *f, const char *key, const char *words)
{
    document_mistake(f->b->mistakes, document_find(f->map, key), 0, "%s", words);
}

static int is_on_all(const fields *f)
{
    const document_node *on = document_find(f->map, "on");
    return fields_have(f, "gravity") && on != NULL && on->kind == DOCUMENT_TEXT &&
           strcmp(on->text, "all") == 0 && !fields_names(f, "on", SCENE_MEMBERS) &&
           !fields_names(f, "on", SCENE_NODES);
}

static int is_heavy(const scene *s, const scene_member *m)
{
    const int profile[2] = {m->section, m->section_q};
    section c;
    for (int k = 0; k < 2; k++)
        if (profile[k] >= 0 && scene_constants(s, profile[k], &c, NULL) == STATUS_OK &&
            c.density > 0)
            return 1;
    return 0;
}

static scene_load at_centre(const scene_load *what)
{
    scene_load out = *what;
    out.kind = SCENE_WEIGHT;
    out.range[1] = 0;
    return out;
}

static void weigh_all(const fields *f, scene_load *what)
{
    const scene *s = f->b->scene;
    const int before = s->loads, reported = f->b->mistakes->count;
    if (f->placed != NULL)
        mistake_at(
            f, "on",
            "gravity with 'on: all' acts on the whole scene, but this load is in a part; move "
            "it to the loads of the scene");
    for (what->where = 0; what->where < s->members && f->b->mistakes->count == reported;
         what->where++)
        if (is_heavy(s, &s->member[what->where]))
            add(f, what);
    *what = at_centre(what);
    what->lumped = 0;
    for (what->where = 0; what->where < s->nodes && f->b->mistakes->count == reported;
         what->where++)
        if (s->node[what->where].body.mass > 0)
            add(f, what);
    if (s->loads == before && f->b->mistakes->count == reported)
        mistake_at(f, "on", "the scene has no mass; give a density to sections or a mass to nodes");
}

static void check_weight(const fields *f, const scene_load *what)
{
    if (what->where >= 0 && scene_node_at(f->b->scene, what->where)->body.mass == 0)
        document_mistake(f->b->mistakes, document_find(f->map, "on"), 0,
                         "gravity acts on node '%.40s', which has no mass; give the node a mass, "
                         "or name a member",
                         fields_text(f, "on", ""));
}

static int whole_of(builder *b)
{
    for (int i = 0; i < b->list[SCENE_LOADS].count; i++) {
        const fields f = fields_of(b, &b->list[SCENE_LOADS].entry[i]);
        if (is_on_all(&f))
            return i;
    }
    return -1;
}

static void check_gravity(const fields *f, const scene_load *what, int whole)
{
    const char *key = fields_have(f, "at")              ? "at"
                      : what->axes == SCENE_AXES_MEMBER ? "axes"
                      : what->follower                  ? "follower"
                                                        : NULL;
    if (key != NULL)
        document_mistake(f->b->mistakes, document_find(f->map, "gravity"), 0,
                         "gravity acts at centres of mass, in a fixed direction; remove '%s'", key);
    if (whole >= 0 && !is_on_all(f))
        document_mistake(f->b->mistakes, document_find(f->map, "on"), 0,
                         "load '%.40s' (on: all) already includes this weight; remove one of "
                         "the two loads",
                         f->b->list[SCENE_LOADS].entry[whole].name);
}

/* The first keys of entry_load have the order of scene_load_kind up to gravity, followed by
 * temperature. */
enum { OF_TEMPERATURE = SCENE_GRAVITY + 1 };

static int spreads(int given)
{
    return given == SCENE_DISTRIBUTED || given == SCENE_DISTRIBUTED_MOMENT ||
           given == OF_TEMPERATURE;
}

static scene_load_kind kind_of(const fields *f, int given)
{
    const int within = fields_have(f, "where");
    return given == SCENE_FORCE      ? (within ? SCENE_MEMBER_FORCE : SCENE_FORCE)
           : given == SCENE_MOMENT   ? (within ? SCENE_MEMBER_MOMENT : SCENE_MOMENT)
           : given == OF_TEMPERATURE ? SCENE_TEMPERATURE
                                     : (scene_load_kind)given;
}

static double part_of(const fields *f, const char *key, double otherwise)
{
    const double part = fields_number(f, key, otherwise);
    if (part >= 0 && part <= 1)
        return part;
    document_mistake(f->b->mistakes, document_find(f->map, key), 0,
                     "%s = %g; give a fraction of the member's length, from 0 to 1", key, part);
    return otherwise;
}

static void check_keys(const fields *f, int given)
{
    static const char *const of_range[] = {"from", "to", "to_value"};
    if (fields_have(f, "where") && given > SCENE_MOMENT)
        mistake_at(f, "where",
                   given == SCENE_GRAVITY ? "where: this key is for a force or a moment, but "
                                            "gravity acts on the whole member; remove the key"
                                          : "where: this key is for a force or a moment; for "
                                            "this load, give 'from' and 'to' instead");
    for (int k = 0; k < 3; k++) {
        if ((spreads(given) && (k < 2 || given != OF_TEMPERATURE)) || !fields_have(f, of_range[k]))
            continue;
        document_mistake(f->b->mistakes, document_find(f->map, of_range[k]), 0,
                         "%s: this key is for a distributed load, but %s", of_range[k],
                         given == OF_TEMPERATURE
                             ? "a temperature is constant from 'from' to 'to'; remove the key"
                         : given == SCENE_GRAVITY
                             ? "gravity acts on the whole member; remove the key"
                             : "this load acts at one position; remove the key, or give 'where'");
    }
}

static void read_range(const fields *f, int given, scene_load *what)
{
    check_keys(f, given);
    if (fields_have(f, "gradient") && given != OF_TEMPERATURE)
        mistake_at(f, "gradient", "gradient: this key is for a temperature; add temperature: 0");
    if (scene_load_within(what))
        what->range[0] = what->range[1] = part_of(f, "where", 0);
    if (!spreads(given))
        return;
    what->range[0] = part_of(f, "from", 0);
    what->range[1] = part_of(f, "to", 1);
    if (what->range[0] < what->range[1])
        return;
    document_mistake(
        f->b->mistakes, document_find(f->map, fields_have(f, "to") ? "to" : "from"), 0,
        "the load acts from %g to %g of the member's length; give 'to' a larger value than 'from'",
        what->range[0], what->range[1]);
}

static int frame_motion_of(const fields *f, const scene_load *what)
{
    const int node = fields_names(f, "on", SCENE_NODES),
              member = fields_names(f, "on", SCENE_MEMBERS), within = scene_load_within(what);
    const char *on = fields_text(f, "on", "");
    if (what->lumped && (!scene_load_along(what) || within))
        mistake_at(f, "lumped",
                   "lumped: this key is for distributed loads and gravity on a member, but this "
                   "load acts at one position; remove the key");
    if (within && node && !member) {
        document_mistake(f->b->mistakes, document_find(f->map, "where"), 0,
                         "where: the value is a fraction of a member's length, but '%.40s' is a "
                         "node; name a member, or remove 'where'",
                         on);
        return SCENE_NONE;
    }
    if (what->kind <= SCENE_MOMENT && member && !node) {
        document_mistake(f->b->mistakes, document_find(f->map, "on"), 0,
                         "'%.40s' is a member; %s name a node", on,
                         fields_have(f, "tension")
                             ? "a tension acts between two nodes;"
                             : "add 'where', a fraction of its length from 0 to 1, or");
        return SCENE_NONE;
    }
    return fields_entry(f, "on", scene_load_along(what) ? SCENE_MEMBERS : SCENE_NODES);
}

static void turn_load(const fields *f, scene_load *what)
{
    if (what->axes == SCENE_AXES_MEMBER)
        return;
    placement_turn(f->placed, what->vector);
    placement_turn(f->placed, what->last);
    placement_turn(f->placed, what->at);
}

void builder_loads(builder *b)
{
    const int whole = whole_of(b);
    for (int i = 0; i < b->list[SCENE_LOADS].count; i++) {
        const fields f = fields_of(b, &b->list[SCENE_LOADS].entry[i]);
        int given = SCENE_FORCE;
        while (given < OF_TEMPERATURE && !fields_have(&f, entry_load[given].name))
            given++;
        if (fields_have(&f, "tension"))
            given = SCENE_FORCE;
        scene_load what = scene_load_of(kind_of(&f, given), SCENE_NONE, 0, 0, 0);
        fields_read(&f, entry_load, &what);
        if (given != OF_TEMPERATURE)
            fields_vector(&f, entry_load[given].name, 3, what.vector);
        what.varies = fields_vector(&f, "to_value", 3, what.last);
        turn_load(&f, &what);
        if (fields_have(&f, "feedback") && f.placed != NULL && f.placed->turned)
            mistake_at(&f, "feedback",
                       "feedback: components are measured along the axes of the scene, but this "
                       "part is rotated; move the load to the scene");
        read_range(&f, given, &what);
        if (what.kind == SCENE_GRAVITY)
            check_gravity(&f, &what, whole);
        if (is_on_all(&f)) {
            const int first = b->scene->loads;
            weigh_all(&f, &what);
            for (int k = first; k < b->scene->loads; k++)
                builder_call(b, SCENE_LOADS, k, i);
            continue;
        }
        if (what.kind == SCENE_GRAVITY && !fields_names(&f, "on", SCENE_MEMBERS) &&
            fields_names(&f, "on", SCENE_NODES))
            what = at_centre(&what);
        what.where = frame_motion_of(&f, &what);
        if (what.kind == SCENE_WEIGHT)
            check_weight(&f, &what);
        builder_call(b, SCENE_LOADS, add(&f, &what), i);
    }
}

/* Rotates the stiffness from the axes of the instance to those of the scene: K <- T K T^T with T =
 * diag(R, R). */
static void turn_stiffness(const placement *placed, double K[36])
{
    double turned[36];
    int symmetric = 1;
    if (placed == NULL || !placed->turned)
        return;
    for (int i = 0; i < 36; i++)
        symmetric &= K[i] == K[i / 6 + 6 * (i % 6)];
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < 36; i += 3)
            placement_turn(placed, &K[i]);
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < 6; j++)
                turned[6 * i + j] = K[6 * j + i];
        memcpy(K, turned, sizeof turned);
    }
    for (int i = 0; i < 36 && symmetric; i++) /* makes K exactly symmetric */
        K[i] = (turned[i] + turned[i / 6 + 6 * (i % 6)]) / 2;
}

/* Reads a 6 x 6 matrix of a spring in the axes of the scene. Returns 0 if the key is missing. */
static int spring_matrix(const fields *f, const char *key, double out[36])
{
    if (fields_matrix(f, key, out))
        turn_stiffness(f->placed, out);
    return fields_have(f, key);
}

void builder_springs(builder *b)
{
    for (int i = 0; i < b->list[SCENE_SPRINGS].count; i++) {
        const fields f = fields_of(b, &b->list[SCENE_SPRINGS].entry[i]);
        double stiffness[36] = {0}, damping[36] = {0};
        const int stiff = spring_matrix(&f, "stiffness", stiffness),
                  damps = spring_matrix(&f, "damping", damping);
        const document_node *tables = document_find(f.map, "tables");
        if (!stiff && !damps && (tables == NULL || tables->count == 0))
            document_mistake(
                b->mistakes, f.map, 0,
                "spring '%.40s' has no stiffness, damping or tables; give at least one of them",
                b->list[SCENE_SPRINGS].entry[i].name);
        if (tables != NULL && f.placed != NULL && f.placed->turned)
            document_mistake(b->mistakes, tables, 0,
                             "tables: the components are along the axes of the scene, but the part "
                             "is rotated; move the spring to the scene, or do not rotate the part");
        const int index = scene_add_spring(b->scene, SCENE_NONE, SCENE_NONE, stiffness);
        builder_call(b, SCENE_SPRINGS, index, i);
        if (index < 0)
            continue;
        scene_damp_spring(b->scene, index, damping);
        fields_read(&f, entry_spring, &b->scene->spring[index]);
    }
}

static void read_nodes(const fields *f, const char *key, int least, int index)
{
    const document_node *n = document_find(f->map, key);
    if (n->kind != DOCUMENT_LIST || n->count < least) {
        document_mistake(f->b->mistakes, n, 0, "%s: give a list of at least %s", key,
                         least > 1 ? "two nodes" : "one node");
        return;
    }
    for (int i = 0; i < n->count; i++)
        scene_constrain(f->b->scene, index, fields_entry_of(f, n->item[i], SCENE_NODES));
}

enum { FORMS = 3, OF_FORM = 4 };

/* Returns the form of a constraint: 0 for equal components, 1 for a ratio, 2 for a diaphragm, and
 * -1 if the keys are not those of one form. */
static int form_of(const fields *f)
{
    static const char *const form[FORMS][OF_FORM] = {{"equal", "components", NULL, NULL},
                                                     {"node", "component", "ratio", "of"},
                                                     {"diaphragm", "master", "normal", NULL}};
    for (int i = 0; i < FORMS; i++) {
        int wrong = 0;
        for (int k = 0; k < FORMS * OF_FORM; k++) {
            const char *key = form[k / OF_FORM][k % OF_FORM];
            wrong |= key != NULL && fields_have(f, key) != (k / OF_FORM == i);
        }
        if (!wrong)
            return i;
    }
    return -1;
}

void builder_constraints(builder *b)
{
    for (int i = 0; i < b->list[SCENE_CONSTRAINTS].count; i++) {
        const fields f = fields_of(b, &b->list[SCENE_CONSTRAINTS].entry[i]);
        const int form = form_of(&f), two = form == 1;
        if (form < 0) {
            document_mistake(b->mistakes, f.map, 0,
                             "the keys of '%.40s' do not define a constraint; give {equal: [NODE, "
                             "NODE], components: [ux]}, {node: NODE, component: ux, ratio: -2, of: "
                             "NODE}, or {diaphragm: [NODE], master: NODE, normal: z}",
                             b->list[SCENE_CONSTRAINTS].entry[i].name);
            continue;
        }
        if (form == 2) {
            const int across =
                scene_add_diaphragm(b->scene, fields_entry(&f, "master", SCENE_NODES),
                                    fields_word(&f, "normal", "x|y|z", 2));
            builder_call(b, SCENE_CONSTRAINTS, across, i);
            read_nodes(&f, "diaphragm", 1, across);
            continue;
        }
        const int index = scene_add_constraint(
            b->scene, fields_words(&f, two ? "component" : "components", fields_components),
            two ? fields_number(&f, "ratio", 1) : 1);
        builder_call(b, SCENE_CONSTRAINTS, index, i);
        if (!two) {
            read_nodes(&f, "equal", 2, index);
            continue;
        }
        scene_constrain(b->scene, index, fields_entry(&f, "of", SCENE_NODES));
        scene_constrain(b->scene, index, fields_entry(&f, "node", SCENE_NODES));
    }
}

void builder_imperfections(builder *b)
{
    for (int i = 0; i < b->list[SCENE_IMPERFECTIONS].count; i++) {
        const fields f = fields_of(b, &b->list[SCENE_IMPERFECTIONS].entry[i]);
        const document_node *shifts = document_find(f.map, "shifts");
        const int by_mode = fields_have(&f, "mode_of");
        if (by_mode == (shifts != NULL) || by_mode != fields_have(&f, "amplitude") ||
            (by_mode ? fields_have(&f, "factor")
                     : fields_have(&f, "which") || fields_have(&f, "direction")) ||
            (shifts != NULL && (shifts->kind != DOCUMENT_MAP || shifts->count == 0))) {
            document_mistake(
                b->mistakes, f.map, 0,
                "the keys of '%.40s' do not define an imperfection; give {mode_of: ANALYSIS, "
                "which: 0, amplitude: 2e-3}, or {shifts: {NODE: [dx, dy, dz]}, factor: 1}",
                b->list[SCENE_IMPERFECTIONS].entry[i].name);
            continue;
        }
        const int index = scene_add_imperfection(b->scene);
        builder_call(b, SCENE_IMPERFECTIONS, index, i);
        if (index < 0)
            continue;
        scene_imperfection *p = &b->scene->imperfection[index];
        fields_read(&f, entry_imperfection, p);
        if (fields_have(&f, "direction") && p->direction[0] == 0 && p->direction[1] == 0 &&
            p->direction[2] == 0)
            document_mistake(b->mistakes, document_find(f.map, "direction"), 0,
                             "direction = [0, 0, 0]; give a nonzero vector, or remove the key");
        for (int k = 0; shifts != NULL && k < shifts->count; k++) {
            double shift[3] = {0};
            const int node = fields_entry_of(&f, shifts->key[k], SCENE_NODES);
            if (expression_vector(shifts->item[k], 3, f.names, b->mistakes, shift) && node >= 0)
                scene_shift_node(b->scene, index, node, shift);
        }
    }
}

static void add_case(builder *b, const unrolled *entry)
{
    const fields f = fields_of(b, entry);
    const document_node *n = document_find(f.map, "case");
    unrolled **list = &b->list[SCENE_CASES].entry;
    int *count = &b->list[SCENE_CASES].count;
    if (n == NULL || n->kind != DOCUMENT_TEXT || fields_names(&f, "case", SCENE_CASES))
        return;
    *list = arena_grow(b->arena, *list, *count, sizeof **list);
    if (*list == NULL) {
        *count = 0;
        return;
    }
    (*list)[(*count)++] = (unrolled){fields_called(&f, n), n, n, n, b->names, NULL};
}

void builder_cases(builder *b)
{
    static const scene_list from[] = {SCENE_LOADS, SCENE_DRIVERS};
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < b->list[from[k]].count; i++)
            add_case(b, &b->list[from[k]].entry[i]);
    for (int i = 0; i < b->list[SCENE_CASES].count; i++)
        scene_add_case(b->scene, b->list[SCENE_CASES].entry[i].name);
}

static int names_case(const document_node *entries, const char *name)
{
    for (int i = 0; entries != NULL && entries->kind == DOCUMENT_MAP && i < entries->count; i++) {
        const document_node *n = document_find(entries->item[i], "case");
        if (n != NULL && n->kind == DOCUMENT_TEXT && strcmp(n->text, name) == 0)
            return 1;
    }
    return 0;
}

static int is_conditional(const builder *b, const char *name)
{
    const document_node *parts = document_find(b->root, "parts");
    int left = names_case(document_find(b->root, "loads"), name) ||
               names_case(document_find(b->root, "motions"), name);
    for (int i = 0; parts != NULL && i < parts->count && !left; i++)
        left = names_case(document_find(parts->item[i], "loads"), name);
    return left;
}

void builder_combinations(builder *b)
{
    for (int i = 0; i < b->list[SCENE_COMBINATIONS].count; i++) {
        const unrolled *entry = &b->list[SCENE_COMBINATIONS].entry[i];
        const fields f = fields_of(b, entry);
        const int index = scene_add_combination(b->scene, entry->name);
        for (int k = 0; k < f.map->count; k++) {
            const document_node *key = f.map->key[k];
            double factor;
            if (keys_is_loop(key->text) ||
                (!fields_names_entry(&f, key, SCENE_CASES) && is_conditional(b, key->text)) ||
                !expression_number(f.map->item[k], f.names, b->mistakes, &factor))
                continue;
            const int load_case = fields_entry_of(&f, key, SCENE_CASES);
            if (load_case >= 0)
                scene_add_term(b->scene, index, load_case, factor);
        }
    }
}

static int is_read(const scene *s, int load_case)
{
    for (int i = 0; i < s->combinations; i++)
        for (int k = 0; k < s->combination[i].terms; k++)
            if (s->combination[i].term[k].load_case == load_case)
                return 1;
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].acting.load_case == load_case)
            return 1;
    for (int i = 0; i < s->quantities; i++)
        if (s->quantity[i].acting.load_case == load_case ||
            (s->quantity[i].envelope != SCENE_ENVELOPE_NONE && s->combinations == 0))
            return 1;
    return 0;
}

void builder_read_cases(builder *b)
{
    const scene *s = b->scene;
    for (int i = 0; i < s->cases && s->quantities > 0; i++)
        if (!is_read(s, i))
            document_mistake(
                b->mistakes, b->list[SCENE_CASES].entry[i].place, 0,
                "load case '%.40s' is not used by any combination, analysis or quantity; correct "
                "its name, or give the case a factor in a combination (0 to ignore the case)",
                s->load_case[i].name);
}
