/* Springs of a scene and what loads it. */
#include <string.h>

#include "harness/scene_file/builder.h"

static const char *const key_of[] = {"force", "moment", "distributed", "distributed_moment",
                                     "gravity"};

/* In the axes of a member, which turn with an instance by themselves. */
static int along_member(const fields *f, const char *key, double out[3])
{
    return fields_vector(f, key, 3, out);
}

/* Adds one load of the scene, as the entry describes it; its index. */
static int add(const fields *f, const scene_load *what)
{
    scene *s = f->b->scene;
    double *path, *factor;
    const double *v = what->vector;
    const int load = scene_add_load(s, what->kind, what->where, v[0], v[1], v[2]);
    scene_load *l = scene_load_at(s, load);
    memcpy(l->at, what->at, sizeof l->at);
    l->axes = what->axes;
    l->follower = what->follower;
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

/* Is its `on` the word, and the name of nothing? */
static int is_on_all(const fields *f)
{
    const document_node *on = document_find(f->map, "on");
    return fields_have(f, "gravity") && on != NULL && on->kind == DOCUMENT_TEXT &&
           strcmp(on->text, "all") == 0 && !fields_names(f, "on", LIST_MEMBERS) &&
           !fields_names(f, "on", LIST_NODES);
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

/* Gravity on each member that has a density and each body that has a mass; a mistake is told
 * once. */
static void weigh_all(const fields *f, scene_load *what)
{
    const scene *s = f->b->scene;
    const int before = s->loads, told = f->b->mistakes->count;
    if (f->placed != NULL)
        mistake_at(f, "on",
                   "gravity on all is of the whole scene and not of a part; put it among "
                   "the loads of the scene");
    for (what->where = 0; what->where < s->members && f->b->mistakes->count == told; what->where++)
        if (is_heavy(s, &s->member[what->where]))
            add(f, what);
    what->kind = SCENE_WEIGHT;
    for (what->where = 0; what->where < s->nodes && f->b->mistakes->count == told; what->where++)
        if (s->node[what->where].body.mass > 0)
            add(f, what);
    if (s->loads == before && f->b->mistakes->count == told)
        mistake_at(f, "on",
                   "nothing of the scene has a mass; give sections a density or nodes a "
                   "mass");
}

/* Of a body. */
static void check_weight(const fields *f, const scene_load *what)
{
    if (what->where >= 0 && scene_node_at(f->b->scene, what->where)->body.mass == 0)
        mistake_at(f, "on",
                   "gravity on a node that has no mass; give it mass: [kg], or name a member");
}

/* The entry whose gravity is on all; -1: none. */
static int whole_of(builder *b)
{
    for (int i = 0; i < b->list[LIST_LOADS].count; i++) {
        const fields f = fields_of(b, &b->list[LIST_LOADS].entry[i]);
        if (is_on_all(&f))
            return i;
    }
    return -1;
}

static void check_gravity(const fields *f, const scene_load *what, int whole)
{
    if (fields_have(f, "at") || what->axes == SCENE_AXES_MEMBER || what->follower)
        mistake_at(f, "gravity",
                   "weight acts at centres of mass along fixed axes; leave out 'at', 'axes' and "
                   "'follower'");
    if (whole >= 0 && !is_on_all(f))
        document_mistake(f->b->mistakes, document_find(f->map, "on"), 0,
                         "its weight is in '%.40s' already, which is on all; leave one out",
                         f->b->list[LIST_LOADS].entry[whole].name);
}

void builder_loads(builder *b)
{
    const int whole = whole_of(b);
    for (int i = 0; i < b->list[LIST_LOADS].count; i++) {
        const fields f = fields_of(b, &b->list[LIST_LOADS].entry[i]);
        scene_load what = {.kind = SCENE_FORCE};
        while (what.kind < SCENE_GRAVITY && !fields_have(&f, key_of[what.kind]))
            what.kind++;
        what.axes =
            fields_word(&f, "axes", "fixed|member", 0) == 1 ? SCENE_AXES_MEMBER : SCENE_AXES_FIXED;
        what.follower = fields_word(&f, "follower", "false|true|no|yes", 0) % 2;
        int (*const vector_of)(const fields *, const char *, double[3]) =
            what.axes == SCENE_AXES_MEMBER ? along_member : fields_direction;
        vector_of(&f, key_of[what.kind], what.vector);
        vector_of(&f, "at", what.at);
        if (what.kind == SCENE_GRAVITY)
            check_gravity(&f, &what, whole);
        if (is_on_all(&f)) {
            const int first = b->scene->loads;
            weigh_all(&f, &what);
            for (int k = first; k < b->scene->loads; k++)
                builder_call(b, SCENE_LOADS, k, LIST_LOADS, i);
            continue;
        }
        if (what.kind == SCENE_GRAVITY && !fields_names(&f, "on", LIST_MEMBERS) &&
            fields_names(&f, "on", LIST_NODES))
            what.kind = SCENE_WEIGHT;
        what.where = fields_entry(&f, "on", scene_load_along(&what) ? LIST_MEMBERS : LIST_NODES);
        if (what.kind == SCENE_WEIGHT)
            check_weight(&f, &what);
        builder_call(b, SCENE_LOADS, add(&f, &what), LIST_LOADS, i);
    }
}

/* In a part that is turned the stiffness is in its axes: K <- T K T^T, T = diag(R, R). */
static void turn_stiffness(const placement *placed, double K[36])
{
    double turned[36];
    if (placed == NULL || !placed->turned)
        return;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < 36; i += 3)
            placement_turn(placed, &K[i]);
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < 6; j++)
                turned[6 * i + j] = K[6 * j + i];
        memcpy(K, turned, sizeof turned);
    }
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            K[6 * i + j] = (turned[6 * i + j] + turned[6 * j + i]) / 2;
}

void builder_springs(builder *b)
{
    for (int i = 0; i < b->list[LIST_SPRINGS].count; i++) {
        const fields f = fields_of(b, &b->list[LIST_SPRINGS].entry[i]);
        const int p = fields_entry(&f, "from", LIST_NODES), q = fields_entry(&f, "to", LIST_NODES);
        double *given, stiffness[36] = {0};
        const int count = fields_values(&f, "stiffness", &given);
        if (count == 36)
            memcpy(stiffness, given, sizeof stiffness);
        if (count == 6)
            for (int k = 0; k < 6; k++)
                stiffness[7 * k] = given[k];
        if (count != 6 && count != 36)
            document_mistake(b->mistakes, document_find(f.map, "stiffness"), 0,
                             "stiffness: %d numbers; give six, or the 36 of a matrix", count);
        else
            turn_stiffness(f.placed, stiffness);
        builder_call(b, SCENE_SPRINGS, scene_add_spring(b->scene, p, q, stiffness), LIST_SPRINGS,
                     i);
    }
}
