#include "cases/format/format_impl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/shared/choice.h"

static const char *text_of(const document_node *entry, const char *key, const char *otherwise)
{
    const document_node *n = document_find(entry, key);
    return n != NULL && n->kind == DOCUMENT_TEXT ? n->text : otherwise;
}

static double number_of(const document_node *entry, const char *key, double otherwise, mistakes *m)
{
    const document_node *n = document_find(entry, key);
    double value = otherwise;
    return n != NULL && expression_number(n, NULL, m, &value) ? value : otherwise;
}

static int is_switch(const document_node *choices)
{
    return choices->kind == DOCUMENT_LIST && choices->count == 2 &&
           choices->item[0]->kind == DOCUMENT_TEXT && strcmp(choices->item[0]->text, "0") == 0 &&
           choices->item[1]->kind == DOCUMENT_TEXT && strcmp(choices->item[1]->text, "1") == 0;
}

void mistake_parameter(mistakes *m, const document_node *n, const parameter_type *p, double value)
{
    const char *unit = p->unit != NULL && strcmp(p->unit, "1") != 0 ? p->unit : "";
    const int below = value < p->min;
    document_mistake(m, n, 0, "%s = %g%s%s is %s its %s %g; correct one of them", p->name, value,
                     unit[0] != '\0' ? " " : "", unit, below ? "below" : "above",
                     below ? "minimum" : "maximum", below ? p->min : p->max);
}

static void mistake_choice(mistakes *m, const document_node *value, const char *name,
                           const char *choices)
{
    document_mistake(m, value, 0,
                     "%s: the default is not one of the choices %s; correct one of them", name,
                     choices);
}

static void read_switch(parameter_type *p, const document_node *value, mistakes *m)
{
    p->unit = "1";
    p->max = 1;
    if (expression_number(value, NULL, m, &p->value) && p->value != 0 && p->value != 1)
        mistake_choice(m, value, p->name, "0|1");
}

/* Converts [a, b, c] to "a|b|c". Returns NULL after an error. */
static const char *join_choices(scene_file *file, const document_node *list, mistakes *m)
{
    char text[400] = "";
    size_t used = 0;
    int good = list->kind == DOCUMENT_LIST && list->count > 0;
    for (int i = 0; good && i < list->count; i++) {
        const document_node *one = list->item[i];
        const size_t length = one->kind == DOCUMENT_TEXT ? strlen(one->text) : 0;
        good = length > 0 && length < 40 && expression_name_length(one->text) == length &&
               used + length + 2 < sizeof text;
        if (good)
            used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", i > 0 ? "|" : "",
                                     one->text);
    }
    if (!good)
        document_mistake(m, list, 0, "choices: a list of words is expected: [fixed, free]");
    return good ? arena_copy(&file->arena, text, used) : NULL;
}

static void read_choice(parameter_type *p, const document_node *value, mistakes *m)
{
    const int index = value->kind == DOCUMENT_TEXT ? choice_index(p->choices, value->text) : -1;
    p->unit = "";
    p->value = index >= 0 ? index : 0;
    if (index < 0)
        mistake_choice(m, value, p->name, p->choices);
}

static void read_number(parameter_type *p, const document_node *entry, const unit_system *units,
                        mistakes *m)
{
    const document_node *unit = document_find(entry, "unit"), *at = document_find(entry, "value");
    p->unit = text_of(entry, "unit", "1");
    if (unit != NULL && units->given)
        units_check_own(unit, units, m);
    else if (unit != NULL && units->name_of_length == NULL && units->name_of_force == NULL)
        units_check(unit, m);
    p->min = number_of(entry, "min", -DBL_MAX, m);
    p->max = number_of(entry, "max", DBL_MAX, m);
    const int read = expression_number(at, NULL, m, &p->value);
    if (p->min > p->max)
        document_mistake(m, document_find(entry, "max"), 0,
                         "%s: max = %g is below min = %g; correct one of them", p->name, p->max,
                         p->min);
    else if (read && !(p->value >= p->min && p->value <= p->max))
        mistake_parameter(m, at, p, p->value);
    if (p->min == 0 && p->max == 1)
        p->max = nextafter(1, 2);
}

void parameter_table_read(scene_file *file, mistakes *m)
{
    const document_node *all = document_find(file->root, "parameters");
    const scope *names = NULL;
    unit_system units;
    units_read(document_find(file->root, "units"), m, &units);
    if (all != NULL)
        for (int i = 0; i < all->count; i++) {
            const document_node *entry = all->item[i], *choices = document_find(entry, "choices");
            if (file->parameters == CASE_MAX_PARAMETERS) {
                document_mistake(m, all->key[i], 0,
                                 "the scene has more than %d parameters; move some to 'let'",
                                 CASE_MAX_PARAMETERS);
                break;
            }
            parameter_type *p = &file->parameter[file->parameters++];
            *p =
                (parameter_type){.name = all->key[i]->text, .summary = text_of(entry, "about", "")};
            if (scope_accepts(names, all->key[i], m))
                names = scope_number(names, p->name, 0, &file->arena);
            if (choices != NULL && !is_switch(choices))
                p->choices = join_choices(file, choices, m);
            if (p->choices != NULL)
                read_choice(p, document_find(entry, "value"), m);
            else if (choices != NULL && is_switch(choices))
                read_switch(p, document_find(entry, "value"), m);
            else if (choices == NULL)
                read_number(p, entry, &units, m);
        }
    file->type.parameters[0] = file->parameter;
}

const scope *parameter_table_names(const parameter_type *p, const double value[], arena *a)
{
    const scope *names = NULL;
    for (; p->name != NULL; p++, value++) {
        char word[48];
        if (p->choices == NULL) {
            names = scope_number(names, p->name, *value, a);
            continue;
        }
        choice_name(p->choices, (int)*value, word, sizeof word);
        const char *kept = arena_copy(a, word, strlen(word));
        if (kept != NULL)
            names = scope_choice(names, p->name, kept, p->choices, a);
    }
    return names;
}

static const char *const list_name[SCENE_LISTS] = {
    "sections", "nodes",      "members", "springs",      "motions",     "loads",
    "analyses", "quantities", "",        "combinations", "constraints", "imperfections"};

static void check_name(const builder *b, scene_list list, int i)
{
    const unrolled *entry = &b->list[list].entry[i];
    const size_t length = strlen(entry->name);
    if (length == 0 || length >= SCENE_NAME)
        document_mistake(b->mistakes, entry->place, 0,
                         "the name '%.40s' has %zu characters; use 1 to %d", entry->name, length,
                         SCENE_NAME - 1);
    for (int k = 0; k < i; k++)
        if (strcmp(b->list[list].entry[k].name, entry->name) == 0) {
            document_mistake(
                b->mistakes, entry->place, 0,
                "the name '%s' is used twice; include the loop variable in it: NAME_$i",
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
    builder_cases(b);
    for (int i = 0; i < SCENE_LISTS; i++)
        for (int k = 0; k < b->list[i].count; k++)
            check_name(b, (scene_list)i, k);
}

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

/* Returns 1 if a word of `omit` applies: its value is yes, or a condition {NAME: VALUE} that is
 * satisfied. */
static int is_omitted(const fields *f, const document_node *n)
{
    if (n->kind == DOCUMENT_MAP)
        return choose_holds(n, f->names, f->b->mistakes);
    if (n->kind == DOCUMENT_TEXT && strcmp(n->text, "yes") == 0)
        return 1;
    document_mistake(
        f->b->mistakes, n, 0,
        "omit: give yes, or the values for which this physics is omitted: {NAME: VALUE}");
    return 0;
}

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
            document_mistake(
                b->mistakes, b->root->key[i], 0,
                "%s: this key and 'needs' of earlier versions exclude each other; remove "
                "'needs'",
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
    int usual[] = {1, 2, 4, 8}, least = 1;
    for (int i = 0; i < b->scene->members; i++) {
        const scene_member *m = &b->scene->member[i];
        if ((m->bow[0] != 0 || m->bow[1] != 0) && 2 * m->half_waves > least)
            least = 2 * m->half_waves;
    }
    for (int i = 0; i < 4; i++)
        usual[i] *= least;
    double *value;
    int mesh[SCENE_MESHES];
    const document_node *meshes_node = document_find(b->root, "meshes"),
                        *n = meshes_node != NULL ? choose_value(meshes_node, b->names, b->mistakes)
                                                 : NULL;
    const int count = n != NULL ? range_values(n, b->names, b->arena, b->mistakes, &value) : 0;
    if (count <= 0) {
        scene_meshes(b->scene, 4, usual);
        return;
    }
    if (count > SCENE_MESHES)
        document_mistake(b->mistakes, n, 0, "meshes: the list has %d values; give at most %d",
                         count, SCENE_MESHES);
    for (int i = 0; i < count && i < SCENE_MESHES; i++) {
        mesh[i] = value[i] >= 1 && value[i] <= 1e7 ? (int)value[i] : 1;
        if (mesh[i] != value[i])
            document_mistake(
                b->mistakes, n, 0,
                "meshes: %g elements per member; give whole numbers from 1 to 10000000", value[i]);
    }
    scene_meshes(b->scene, count < SCENE_MESHES ? count : SCENE_MESHES, mesh);
}

static void report_refusal(const builder *b, const char *text)
{
    static const char *const word[SCENE_LISTS] = {
        "section ",  "node ",     "member ", "spring ",      "motion ",     "load ",
        "analysis ", "quantity ", "case ",   "combination ", "constraint ", "imperfection "};
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

static int refuses(const builder *b)
{
    const document_node *all = document_find(b->root, "refuse");
    const int before = b->mistakes->count;
    for (int i = 0; all != NULL && i < all->count; i++) {
        const document_node *text_node = document_find(all->item[i], "say");
        if (!choose_holds(document_find(all->item[i], "if"), b->names, b->mistakes))
            continue;
        const char *text = substitute_for_message(text_node, b->names, b->arena, b->mistakes);
        document_mistake(b->mistakes, text_node, 0, "%s", text != NULL ? text : "");
    }
    return b->mistakes->count > before;
}

/* Converts the scene from the units of the file to SI. Quantities are reported in the units of the
 * file. */
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
        report_refusal(b, f.text);
}

static void hold_warping(builder *b)
{
    scene_warping_by_supports(b->scene);
}

/* Builds the lists. Returns the number of quantities in the file. */
static int build_lists(builder *b)
{
    static void (*const own[])(
        builder *) = {builder_nodes,     builder_members,       builder_axes,
                      builder_springs,   builder_constraints,   hold_warping,
                      builder_motions,   builder_loads,         builder_combinations,
                      builder_analyses,  builder_imperfections, builder_quantities,
                      builder_read_cases},
                (*const whole[])(builder *) = {builder_defaults, read_plane, read_physics,
                                               read_meshes};
    for (size_t i = 0; i < sizeof own / sizeof own[0] && !b->scene->out_of_memory; i++)
        own[i](b);
    const int quantities = b->scene->quantities;
    for (size_t i = 0; i < sizeof whole / sizeof whole[0] && !b->scene->out_of_memory; i++)
        whole[i](b);
    return quantities;
}

void build_scene(const document_node *root, const scope *names, arena *a, mistakes *m, scene *out)
{
    builder b = {.default_warping = SCENE_WARP_BY_SUPPORT,
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
    scene_join_instants(out);
    m->out_of_memory |= out->out_of_memory;
    if (m->count == 0 && !m->out_of_memory && scene_validate(out, &f) != STATUS_OK)
        report_refusal(&b, f.text);
}

static const document_node *unpack(const scene_packed *p, arena *a)
{
    const size_t nodes = (size_t)p->nodes;
    document_node *out = arena_take(a, nodes * sizeof *out);
    document_node **at = arena_take(a, nodes * sizeof *at);
    for (int i = 0; out != NULL && at != NULL && i < p->nodes; i++) {
        const document_packed *n = &p->node[i];
        const document_kind kind = (document_kind)n->kind;
        at[i] = &out[i];
        out[i] = (document_node){kind, n->line, n->column, n->inset, NULL, n->count, NULL, NULL};
        if (kind == DOCUMENT_TEXT)
            out[i].text = p->texts + n->first;
        else
            out[i].item = at + n->first + (kind == DOCUMENT_MAP ? n->count : 0);
        if (kind == DOCUMENT_MAP)
            out[i].key = at + n->first;
    }
    return at != NULL ? out : NULL;
}

status scene_packed_build(const void *context, const double value[], scene *s, fault *f)
{
    const scene_packed *p = context;
    arena a = {0};
    mistakes m = {.file = p->file};
    const document_node *root = unpack(p, &a);
    if (root != NULL)
        build_scene(root, parameter_table_names(p->parameters, value, &a), &a, &m, s);
    m.out_of_memory |= a.failed;
    arena_free(&a);
    return m.count > 0 && !m.out_of_memory ? fault_set(f, STATUS_REFUSED, "%s", m.list[0].text)
                                           : mistakes_status(&m, f);
}
