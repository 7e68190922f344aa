#include "cases/format/build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/builder.h"
#include "cases/format/choose.h"
#include "cases/format/expression.h"
#include "cases/format/range.h"
#include "cases/format/substitute.h"
#include "cases/scene/omission.h"
#include "cases/scene/unit.h"
#include "cases/scene/warping.h"

static const char *const list_name[SCENE_LISTS] = {"sections", "nodes", "members",  "springs",
                                                   "motions",  "loads", "analyses", "quantities"};

/* A name of an entry that others can use, once. */
static void check_name(const builder *b, scene_list list, int i)
{
    const unrolled *entry = &b->list[list].entry[i];
    const size_t length = strlen(entry->name);
    if (length == 0 || length >= SCENE_NAME)
        document_mistake(b->mistakes, entry->place, 0, "a name of %zu characters; give 1 to %d",
                         length, SCENE_NAME - 1);
    for (int k = 0; k < i; k++)
        if (strcmp(b->list[list].entry[k].name, entry->name) == 0) {
            document_mistake(b->mistakes, entry->place, 0,
                             "'%s' is there already; put the names of the loops into it: NAME_$i",
                             entry->name);
            return;
        }
}

static void list_own(builder *b, scene_list i)
{
    const int before = b->mistakes->count + b->mistakes->more;
    b->list[i].count = unroll_entries(document_find(b->root, list_name[i]), b->names, b->arena,
                                      b->mistakes, &b->list[i].entry);
    b->list[i].incomplete = b->mistakes->count + b->mistakes->more > before;
}

void build_sections(builder *b)
{
    list_own(b, SCENE_SECTIONS);
    builder_sections(b);
}

/* Entries of the scene's own lists but sections, and behind them those of its instances. */
static void list_entries(builder *b)
{
    static const scene_list placed[PLACEMENT_LISTS] = {SCENE_NODES, SCENE_MEMBERS, SCENE_SPRINGS,
                                                       SCENE_LOADS};
    unrolled *list[PLACEMENT_LISTS];
    int count[PLACEMENT_LISTS];
    for (int i = SCENE_SECTIONS + 1; i < SCENE_LISTS; i++)
        list_own(b, (scene_list)i);
    for (int k = 0; k < PLACEMENT_LISTS; k++) {
        list[k] = b->list[placed[k]].entry;
        count[k] = b->list[placed[k]].count;
    }
    const int before = b->mistakes->count + b->mistakes->more;
    placement_unroll(b->root, b->names, b->arena, b->mistakes, list, count);
    const int incomplete = b->mistakes->count + b->mistakes->more > before;
    for (int k = 0; k < PLACEMENT_LISTS; k++) {
        b->list[placed[k]].entry = list[k];
        b->list[placed[k]].count = count[k];
        b->list[placed[k]].incomplete |= incomplete;
    }
    for (int i = 0; i < SCENE_LISTS; i++)
        for (int k = 0; k < b->list[i].count; k++)
            check_name(b, (scene_list)i, k);
}

/* What earlier versions had in its place: what it does not list is left out, but for warping, which
 * every section had that has any. */
static void read_needs(const fields *f)
{
    static const char choices[] =
        "shear|trapeze|wagner_moments|wagner_torque|rotary_inertia|warping|engesser|haringx";
    enum { ENGESSER = 1 << 6, HARINGX = 1 << 7 };
    const unsigned needs = fields_words(f, "needs", choices);
    scene *s = f->b->scene;
    for (int i = 0; scene_omissions[i].word != NULL; i++)
        if (!(needs >> i & 1u) && scene_omissions[i].feature != FEATURE_WARPING)
            scene_omit(s, scene_omissions[i].feature);
    int sheared = (needs & 1u) != 0;
    for (int i = 0; i < s->sections; i++)
        sheared |= s->section[i].kind == SECTION_MATRICES;
    s->shear_theory = needs & HARINGX || !sheared ? SCENE_SHEAR_HARINGX
                      : needs & ENGESSER          ? SCENE_SHEAR_ENGESSER
                                                  : SCENE_SHEAR_OWN;
}

/* Of a word of 'omit': yes, or the values that names have where it is left out. */
static int is_omitted(const fields *f, const document_node *n)
{
    if (n->kind == DOCUMENT_MAP)
        return choose_holds(n, f->names, f->b->mistakes);
    if (n->kind == DOCUMENT_TEXT && strcmp(n->text, "yes") == 0)
        return 1;
    document_mistake(f->b->mistakes, n, 0,
                     "give yes, or the values that names have where it is off: {NAME: VALUE}");
    return 0;
}

/* A list of words, or a map of them. */
static unsigned read_omit(const fields *f, const char *choices)
{
    const document_node *n = document_find(f->map, "omit");
    unsigned bits = 0;
    if (n == NULL || n->kind != DOCUMENT_MAP)
        return fields_words(f, "omit", choices);
    for (int i = 0; i < n->count; i++) {
        const int index = fields_word_of(f, n->key[i], "omit", choices, -1);
        if (is_omitted(f, n->item[i]) && index >= 0)
            bits |= 1u << index;
    }
    return bits;
}

static void read_physics(builder *b)
{
    static const char choices[] =
        "shear|trapeze|wagner_moments|wagner_torque|rotary_inertia|warping|all|none";
    enum { ALL = 1 << 6 };
    const fields f = {b, b->names, b->root, b->root, NULL};
    if (!fields_have(&f, "needs")) {
        const unsigned omits = read_omit(&f, choices);
        for (int i = 0; scene_omissions[i].word != NULL; i++)
            if (omits >> i & 1u || omits & ALL)
                scene_omit(b->scene, scene_omissions[i].feature);
        b->scene->shear_theory =
            (scene_shear)fields_word(&f, "shear_theory", "haringx|engesser|own", 0);
        return;
    }
    for (int i = 0; i < b->root->count; i++)
        if (strcmp(b->root->key[i]->text, "omit") == 0 ||
            strcmp(b->root->key[i]->text, "shear_theory") == 0)
            document_mistake(b->mistakes, b->root->key[i], 0,
                             "%s: 'needs' of earlier versions stands beside it; take 'needs' out",
                             b->root->key[i]->text);
    read_needs(&f);
}

static void read_plane(builder *b)
{
    const fields f = {b, b->names, b->root, b->root, NULL};
    b->scene->lumped = fields_word(&f, "mass", "consistent|lumped", 0);
    b->scene->plane = (scene_plane)(fields_word(&f, "plane", SCENE_PLANE_CHOICES, -1) + 1);
}

static void read_meshes(builder *b)
{
    static const int usual[] = {1, 2, 4, 8};
    double *value;
    int mesh[SCENE_MESHES];
    const document_node *said = document_find(b->root, "meshes"),
                        *n = said != NULL ? choose_value(said, b->names, b->mistakes) : NULL;
    const int count = n != NULL ? range_values(n, b->names, b->arena, b->mistakes, &value) : 0;
    if (count <= 0) {
        scene_meshes(b->scene, 4, usual);
        return;
    }
    if (count > SCENE_MESHES)
        document_mistake(b->mistakes, n, 0, "%d meshes; give at most %d", count, SCENE_MESHES);
    for (int i = 0; i < count && i < SCENE_MESHES; i++) {
        mesh[i] = value[i] >= 1 && value[i] <= 1e7 ? (int)value[i] : 1;
        if (mesh[i] != value[i])
            document_mistake(b->mistakes, n, 0, "a mesh of %g elements; give whole numbers from 1",
                             value[i]);
    }
    scene_meshes(b->scene, count < SCENE_MESHES ? count : SCENE_MESHES, mesh);
}

/* Where the entry stands that a refusal speaks of ("node tip: ..."), and what it says of it. */
static void tell_refusal(const builder *b, const char *text)
{
    static const char *const word[SCENE_LISTS] = {"section ", "node ", "member ",   "spring ",
                                                  "driver ",  "load ", "analysis ", "quantity "};
    for (int k = 0; k < SCENE_LISTS; k++) {
        const size_t length = strlen(word[k]);
        if (strncmp(text, word[k], length) != 0)
            continue;
        for (int i = 0; i < b->list[k].count; i++) {
            const unrolled *entry = &b->list[k].entry[i];
            const size_t name = strlen(entry->name);
            if (strncmp(text + length, entry->name, name) != 0 ||
                strncmp(text + length + name, ": ", 2) != 0)
                continue;
            document_mistake(b->mistakes, entry->place, 0, "%s", text + length);
            return;
        }
    }
    document_mistake(b->mistakes, b->root, 0, "%s", text);
}

/* 1: values of parameters are refused. */
static int refuses(const builder *b)
{
    const document_node *all = document_find(b->root, "refuse");
    const int before = b->mistakes->count;
    for (int i = 0; all != NULL && i < all->count; i++) {
        const document_node *say = document_find(all->item[i], "say");
        if (!choose_holds(document_find(all->item[i], "if"), b->names, b->mistakes))
            continue;
        const char *text = substitute_said(say, b->names, b->arena, b->mistakes);
        document_mistake(b->mistakes, say, 0, "%s", text != NULL ? text : "");
    }
    return b->mistakes->count > before;
}

/* From the units of the file, in which quantities are reported. own: the rest are not of the file.
 */
static void to_si(const builder *b, int own)
{
    fault f = {""};
    scene *s = b->scene;
    for (int i = own; i < s->quantities; i++) {
        char unit[SCENE_UNIT];
        units_translate(&b->units, s->quantity[i].unit, sizeof unit, unit);
        memcpy(s->quantity[i].unit, unit, sizeof unit);
    }
    scene_change_force(s, b->units.force);
    if (scene_change_unit(s, b->units.length, &f) != STATUS_OK)
        tell_refusal(b, f.text);
}

static void hold_warping(builder *b)
{
    scene_warping_by_supports(b->scene);
}

/* Each refers to those before it: nothing more is read where memory has ended. How many quantities
 * the file has itself. */
static int build_lists(builder *b)
{
    static void (*const own[])(builder *) = {builder_nodes,    builder_members,   builder_springs,
                                             hold_warping,     builder_motions,   builder_loads,
                                             builder_analyses, builder_quantities},
                                       (*const whole[])(builder *) = {builder_defaults, read_plane,
                                                                      read_physics, read_meshes};
    for (size_t i = 0; i < sizeof own / sizeof own[0] && !b->scene->out_of_memory; i++)
        own[i](b);
    const int quantities = b->scene->quantities;
    for (size_t i = 0; i < sizeof whole / sizeof whole[0] && !b->scene->out_of_memory; i++)
        whole[i](b);
    return quantities;
}

void build_scene(const document_node *root, const scope *names, build_ends ends, arena *a,
                 mistakes *m, scene *out)
{
    builder b = {.unsaid_warping = ends == BUILD_FREE ? SCENE_WARP_FREE : SCENE_WARP_BY_SUPPORT,
                 .arena = a,
                 .mistakes = m,
                 .scene = out,
                 .root = root};
    fault f = {""};
    units_read(document_find(root, "units"), m, &b.units);
    b.names = unroll_let(document_find(root, "let"), names, a, m);
    if (refuses(&b))
        return;
    build_sections(&b);
    list_entries(&b);
    if (a->failed) {
        m->out_of_memory = 1;
        return;
    }
    if (b.list[SCENE_MEMBERS].count == 0 && !b.list[SCENE_MEMBERS].incomplete)
        document_mistake(m, root, 0,
                         "the scene has no members; add members: {NAME: {from, to, section, y}}");
    const int own = build_lists(&b);
    m->out_of_memory |= a->failed || out->out_of_memory;
    if (b.units.given && m->count == 0 && !m->out_of_memory)
        to_si(&b, own);
    if (m->count == 0 && !m->out_of_memory && scene_validate(out, &f) != STATUS_OK)
        tell_refusal(&b, f.text);
}
