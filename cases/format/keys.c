#include "cases/format/format_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"

const entry_field keys_let[] = {
    {"", ENTRY_FORMS, .summary = "an expression, or a choice: {NAME: {VALUE: ..., else: ...}}"},
    {.name = NULL}};

const entry_field keys_refusal[] = {
    {"if", ENTRY_FORMS, .needed = 1, .summary = "condition, as for entries"},
    {"say", ENTRY_TEXT, .needed = 1,
     .summary = "message with the reason and the remedy; $NAME is replaced by the value of NAME"},
    {.name = NULL}};

static const entry_field nothing[] = {{.name = NULL}};

const entry_field keys_parameter[] = {
    {"value", ENTRY_FORMS, .needed = 1,
     .summary = "default value: an expression of constants, or a word"},
    {"unit", ENTRY_TEXT, .summary = "SI unit; 1: a plain number", .usual = "1"},
    {"min", ENTRY_NUMBER, .summary = "minimum", .left_out = "no limit"},
    {"max", ENTRY_NUMBER, .summary = "maximum", .left_out = "no limit"},
    {"choices", ENTRY_FORMS, .summary = "[WORD, ...]: allowed words; [0, 1]: a switch",
     .left_out = "a number"},
    {"about", ENTRY_TEXT, .summary = "description in one line", .left_out = "none"},
    {.name = NULL}};

const entry_field keys_truth[] = {
    {"quantity", ENTRY_NAME, .needed = 1, .summary = "name of a quantity"},
    {"value", ENTRY_NUMBER, .needed = 1, .summary = "value in the unit of the quantity"},
    {"kind", ENTRY_WORD, .needed = 1,
     .words = "exact|predicted|independent|agreement|consensus|published|reconstructed|experiment",
     .summary = "kind of reference value"},
    {"source", ENTRY_TEXT, .needed = 1, .summary = "source of the value"},
    {"uncertainty", ENTRY_NUMBER, .summary = "uncertainty of the value, in the same unit",
     .usual = "0"},
    {"formulation", ENTRY_TEXT, .summary = "formulation to which it applies",
     .left_out = "the continuum"},
    {"theory", ENTRY_WORD, .words = SCENE_SHEAR_THEORIES,
     .summary = "shear theory in stability problems", .left_out = "any"},
    {"parameters", ENTRY_NAMES, .below = nothing,
     .summary = "parameter values to which it applies, as NAME: VALUE", .left_out = "any values"},
    {"at", ENTRY_NUMBER, .summary = "abscissa of a point of a curve",
     .left_out = "none: a single value"},
    {"model", ENTRY_WORD, .words = "plate|solid",
     .summary = "model, other than beams, to which the value belongs; the value is shown but never "
                "affects the exit status",
     .left_out = "beams"},
    {"convention", ENTRY_TEXT, .summary = "moment convention", .left_out = "that of the analysis"},
    {.name = NULL}};

const entry_field keys_part[] = {
    {"let", ENTRY_NAMES, .below = keys_let, .summary = "values derived for the part",
     .left_out = "none"},
    {"nodes", ENTRY_ENTRIES, .below = entry_node,
     .summary = "nodes; NAME is INSTANCE.NAME in the scene", .left_out = "none"},
    {"members", ENTRY_ENTRIES, .below = entry_member,
     .summary = "members between nodes or ports of the part", .left_out = "none"},
    {"springs", ENTRY_ENTRIES, .below = entry_spring, .summary = "springs, in the axes of the part",
     .left_out = "none"},
    {"loads", ENTRY_ENTRIES, .below = entry_load, .summary = "loads, in the axes of the part",
     .left_out = "none"},
    {"places", ENTRY_FORMS, .summary = "[NAME, ...]: ports that each instance connects to nodes",
     .left_out = "none"},
    {.name = NULL}};

static const entry_field axes[] = {{"x", ENTRY_VECTOR, .needed = 1, .count = 3,
                                    .summary = "direction of the part's x axis in the scene"},
                                   {"z", ENTRY_VECTOR, .needed = 1, .count = 3,
                                    .summary = "direction of the part's z axis in the scene"},
                                   {.name = NULL}};

static const entry_field angles[] = {
    {"x", ENTRY_NUMBER, .group = 1, .unit = "rad", .summary = "about x", .left_out = "no turn"},
    {"y", ENTRY_NUMBER, .group = 1, .unit = "rad", .summary = "about y", .left_out = "no turn"},
    {"z", ENTRY_NUMBER, .group = 1, .unit = "rad", .summary = "about z", .left_out = "no turn"},
    {.name = NULL}};

static const entry_field outer[] = {{"", ENTRY_NAME, .summary = "node of the scene"},
                                    {.name = NULL}};

const entry_field keys_instance[] = {
    {"part", ENTRY_NAME, .needed = 1, .summary = "name of the part"},
    {"at", ENTRY_VECTOR, .needed = 1, .count = 3, .unit = "m",
     .summary = "position of the origin of the part"},
    {"axes", ENTRY_MAP, .group = 1, .below = axes, .summary = "axes of the part",
     .left_out = "those of the scene"},
    {"turn", ENTRY_MAP, .group = 1, .below = angles,
     .summary = "rotation of the part about one axis of the scene", .left_out = "none"},
    {"connect", ENTRY_NAMES, .below = outer, .summary = "PORT: NODE",
     .left_out = "none; required for each port of the part"},
    {.name = NULL}};

const entry_field keys_loop[] = {
    {"for", ENTRY_FORMS, .summary = "{NAME: a..b | a..b step c | a..b/n | [list], ...}: loops",
     .left_out = "one entry"},
    {"let", ENTRY_NAMES, .below = keys_let, .summary = "values derived for this entry",
     .left_out = "none"},
    {"if", ENTRY_FORMS,
     .summary = "{NAME: VALUE, NAME: [VALUE, ...], ...}: the entry exists only if the names have "
                "these values",
     .left_out = "the entry always exists"},
    {.name = NULL}};

#define PHYSICS "shear|trapeze|wagner_moments|wagner_torque|rotary_inertia|warping"

const entry_field keys_root[] = {
    {"beamwork", ENTRY_NUMBER, .needed = 1, .summary = "version of the format: 1"},
    {"name", ENTRY_TEXT, .summary = "name of the scene", .left_out = "name of the file"},
    {"summary", ENTRY_TEXT, .summary = "description in one line", .left_out = "none"},
    {"source", ENTRY_TEXT, .summary = "origin of the scene", .left_out = "none"},
    {"units", ENTRY_FORMS,
     .summary = "units of length, force and stress, such as mm, N, MPa; masses are in force "
                "s^2/length (here t), times in s, angles in rad",
     .left_out = "SI"},
    {"parameters", ENTRY_ENTRIES, .below = keys_parameter,
     .summary = "parameters that --set can change", .left_out = "none"},
    {"let", ENTRY_NAMES, .below = keys_let, .summary = "derived values, in order",
     .left_out = "none"},
    {"refuse", ENTRY_LIST, .below = keys_refusal,
     .summary = "parameter values to reject, with a message", .left_out = "none"},
    {"sections", ENTRY_ENTRIES, .needed = 1, .below = entry_section, .summary = "cross-sections"},
    {"nodes", ENTRY_ENTRIES, .below = entry_node, .summary = "ends, supports, bodies",
     .left_out = "those of the instances"},
    {"members", ENTRY_ENTRIES, .below = entry_member, .summary = "beams",
     .left_out = "those of the instances"},
    {"springs", ENTRY_ENTRIES, .below = entry_spring,
     .summary = "springs between nodes, or to the ground", .left_out = "none"},
    {"motions", ENTRY_ENTRIES, .below = entry_driver,
     .summary = "prescribed values along a path or as functions of time", .left_out = "none"},
    {"loads", ENTRY_ENTRIES, .below = entry_load, .summary = "forces and moments",
     .left_out = "none"},
    {"constraints", ENTRY_ENTRIES, .below = entry_constraint,
     .summary = "components of nodes that are equal or in a ratio; diaphragms", .left_out = "none"},
    {"imperfections", ENTRY_ENTRIES, .below = entry_imperfection,
     .summary = "stress-free initial deviations from the ideal shape", .left_out = "none"},
    {"combinations", ENTRY_ENTRIES, .below = entry_combination,
     .summary = "{CASE: FACTOR, ...}: load cases that act together", .left_out = "none"},
    {"analyses", ENTRY_ENTRIES, .below = entry_analysis, .summary = "analyses to run",
     .left_out = "a static analysis to the end of the paths of the motions; a linear analysis if "
                 "no motion has a path"},
    {"quantities", ENTRY_ENTRIES, .below = entry_quantity, .summary = "requested results",
     .left_out = "the usual quantities of each analysis, such as displacements of loaded or driven "
                 "nodes, or the first eigenvalue"},
    {"truths", ENTRY_LIST, .below = keys_truth, .summary = "reference values", .left_out = "none"},
    {"plane", ENTRY_WORD, .words = SCENE_PLANE_CHOICES,
     .summary = "plane to which all nodes, including those of the mesh, are confined",
     .left_out = "none"},
    {"omit", ENTRY_FORMS, .words = PHYSICS "|all|none",
     .summary = "omitted physics: a word, a list of words, or a map {WORD: yes, WORD: {NAME: "
                "VALUE}}: with a condition, WORD is omitted only if NAME has this VALUE",
     .left_out = "none: all physics that sections, loads and analyses require is included"},
    {"shear_theory", ENTRY_WORD, .words = "haringx|engesser|own",
     .summary = "shear theory in stability problems; own: the theory of each formulation",
     .usual = "haringx"},
    {"mass", ENTRY_WORD, .words = "consistent|lumped",
     .summary = "mass of members in vibration and steady rotation, and in motions that do not "
                "specify it: consistent (distributed), or lumped at the nodes",
     .usual = "consistent"},
    {"needs", ENTRY_WORDS, .words = PHYSICS "|engesser|haringx",
     .summary = "key of earlier versions: physics that is not listed is omitted, except warping; "
                "use 'omit' instead",
     .left_out = "as given by omit"},
    {"meshes", ENTRY_FORMS,
     .summary = "elements per member: [EXPR, ...], or a choice of lists: {NAME: {VALUE: [...]}}",
     .usual = "[1, 2, 4, 8]"},
    {"parts", ENTRY_ENTRIES, .below = keys_part, .summary = "sub-assemblies with their own axes",
     .left_out = "none"},
    {"instances", ENTRY_ENTRIES, .below = keys_instance,
     .summary = "parts that are placed in the scene", .left_out = "none"},
    {.name = NULL}};

typedef struct known_keys {
    const entry_field *table, *loop;
} known_keys;

static const char *name_at(const void *context, int i)
{
    const known_keys *known = context;
    const entry_field *table = known->table;
    for (; table->name != NULL && i > 0; i--)
        table++;
    return table->name != NULL || known->loop == NULL || i > 1 ? table->name : known->loop[i].name;
}

static const entry_field *find(const entry_field *table, const char *name)
{
    for (; table != NULL && table->name != NULL; table++)
        if (strcmp(table->name, name) == 0)
            return table;
    return NULL;
}

static void check_map(const document_node *map, const known_keys *known, const document_node *name,
                      mistakes *m);

static void report_kind(const document_node *n, const document_node *name, const char *expected,
                        mistakes *m)
{
    static const char *const is[] = {"a string", "a list", "a map"};
    const int text = n->kind == DOCUMENT_TEXT, empty = text && n->text[0] == '\0';
    char *end = NULL;
    const int number = text && !empty && isfinite(strtod(n->text, &end)) && *end == '\0';
    document_mistake(m, n, 0, "%.60s is %s, but must be %s", name->text,
                     empty    ? "empty"
                     : number ? "a number"
                              : is[n->kind],
                     expected);
}

int keys_loops(const entry_field *table)
{
    return table != keys_parameter && table != keys_part && table != keys_refusal;
}

int keys_is_loop(const char *name)
{
    return find(keys_loop, name) != NULL;
}

const entry_field *keys_any(const entry_field *table)
{
    return table != NULL && table->name != NULL && table->name[0] == '\0' ? table : NULL;
}

static void check_entries(const document_node *n, const entry_field *k, const document_node *name,
                          mistakes *m)
{
    const known_keys known = {k->below, keys_loops(k->below) ? keys_loop : NULL};
    if (n->kind != (k->kind == ENTRY_LIST ? DOCUMENT_LIST : DOCUMENT_MAP)) {
        report_kind(n, name,
                    k->kind == ENTRY_LIST ? "a list of maps: - {...}" : "a map: NAME: {...}", m);
        return;
    }
    for (int i = 0; i < n->count; i++)
        check_map(n->item[i], &known, k->kind == ENTRY_LIST ? name : n->key[i], m);
}

static void check_words(const document_node *n, const document_node *name, mistakes *m)
{
    if (n->kind == DOCUMENT_MAP)
        report_kind(n, name, "a word or a list of words", m);
    if (n->kind == DOCUMENT_LIST)
        for (int i = 0; i < n->count; i++)
            if (n->item[i]->kind != DOCUMENT_TEXT)
                report_kind(n->item[i], name, "a word", m);
}

static void check_value(const document_node *n, const entry_field *k, const document_node *name,
                        mistakes *m)
{
    const known_keys below = {entry_below(k), NULL};
    switch (k->kind) {
    case ENTRY_TEXT:
    case ENTRY_NAME:
    case ENTRY_WORD:
    case ENTRY_FLAG:
    case ENTRY_NUMBER:
    case ENTRY_WHOLE:
        if (n->kind != DOCUMENT_TEXT)
            report_kind(n, name,
                        k->kind == ENTRY_NUMBER || k->kind == ENTRY_WHOLE ? "a number" : "a string",
                        m);
        break;
    case ENTRY_WORDS:
        check_words(n, name, m);
        break;
    case ENTRY_VECTOR:
    case ENTRY_DIRECTION:
    case ENTRY_POSITION:
        if (n->kind != DOCUMENT_LIST || n->count != k->count)
            document_mistake(m, n, 0, "%.60s: a list of %d numbers is expected: [a, b, ...]",
                             name->text, k->count);
        break;
    case ENTRY_NUMBERS:
        if (n->kind != DOCUMENT_LIST && !range_is(n))
            report_kind(n, name, "a list of numbers or a range a..b", m);
        break;
    case ENTRY_MAP:
        check_map(n, &below, name, m);
        break;
    case ENTRY_ENTRIES:
    case ENTRY_LIST:
        check_entries(n, k, name, m);
        break;
    case ENTRY_NAMES:
        if (n->kind != DOCUMENT_MAP)
            report_kind(n, name, "a map: NAME: value", m);
        if (n->kind == DOCUMENT_MAP && k->below->name != NULL)
            for (int i = 0; i < n->count; i++)
                check_value(n->item[i], k->below, n->key[i], m);
        break;
    case ENTRY_LATER:
        document_mistake(m, name, 0, "'%s' is %s", name->text,
                         k->summary != NULL ? k->summary : "not supported yet; remove it");
        break;
    case ENTRY_FORMS:
        break;
    }
}

/* Returns the remedy for a key in the wrong place or for a key of another program, or NULL. */
static const char *elsewhere(const entry_field *table, const char *name)
{
    static const char *const poisson[] = {"poisson", "poissons_ratio", "poisson_ratio", "nu"};
    for (size_t i = 0; table == entry_section && i < sizeof poisson / sizeof poisson[0]; i++)
        if (strcmp(name, poisson[i]) == 0)
            return "; give shear_modulus: E/(2*(1 + nu))";
    static const char *const acting[] = {"combination", "case", "envelope"};
    for (size_t i = 0; i < sizeof acting / sizeof acting[0]; i++)
        if (strcmp(name, acting[i]) == 0 && (table == entry_analysis || table == entry_quantity))
            return table == entry_analysis
                       ? "; write it within the kind of analysis: {static: {combination: NAME}}"
                       : "; write it next to 'analysis': {analysis: NAME, "
                         "combination: NAME}";
    return NULL;
}

/* Writes the remedy for an unknown key: that of `elsewhere`, otherwise the nearest known key,
 * otherwise the command that lists all keys. */
static const char *remedy_of(const known_keys *known, const char *name, char text[FAULT_TEXT])
{
    const char *other = elsewhere(known->table, name);
    const char *near = other == NULL ? choice_nearest(name, name_at, known) : NULL;
    return mistakes_remedy(
        near, other != NULL ? other : "; 'beamwork scene --schema' lists all keys", text);
}

/* Returns 1 if the map contains a key of the kind ENTRY_LATER, or an unknown key that is probably a
 * misspelt form of the missing key. */
static int is_meant(const document_node *map, const known_keys *known, const char *name)
{
    for (int i = 0; i < map->count; i++) {
        const char *text = map->key[i]->text;
        const entry_field *k = find(known->table, text);
        if (k != NULL && k->kind == ENTRY_LATER)
            return 1;
        const char *near = k == NULL && elsewhere(known->table, text) == NULL
                               ? choice_nearest(text, name_at, known)
                               : NULL;
        if (near != NULL && strcmp(near, name) == 0)
            return 1;
    }
    return 0;
}

static void group_words(const entry_field *table, int group, char text[FAULT_TEXT])
{
    size_t used = 0;
    text[0] = '\0';
    for (; table->name != NULL; table++)
        if (table->group == group && table->kind != ENTRY_LATER && used + 40 < FAULT_TEXT) {
            const size_t length = strlen(table->name);
            memcpy(text + used, ", ", 2);
            memcpy(text + used + (used > 0 ? 2 : 0), table->name, length + 1);
            used += length + (used > 0 ? 2 : 0);
        }
}

static void check_missing(const document_node *map, const known_keys *known,
                          const document_node *name, mistakes *m)
{
    for (const entry_field *k = known->table; k->name != NULL; k++) {
        const document_node *first = NULL;
        int there = 0, meant = 0;
        for (const entry_field *other = known->table; other->name != NULL; other++) {
            if (other != k && (k->group == 0 || other->group != k->group))
                continue;
            for (int i = 0; i < map->count; i++)
                if (strcmp(map->key[i]->text, other->name) == 0) {
                    first = map->key[i];
                    there++;
                }
            meant |= is_meant(map, known, other->name);
        }
        char group[FAULT_TEXT];
        group_words(known->table, k->group, group);
        if (there > 1 && k->group > 0)
            document_mistake(m, first, 0, "%.40s: only one of %.200s is allowed; remove the others",
                             name->text, group);
        if (there > 0 || meant || !k->needed)
            continue;
        if (k->group > 0)
            document_mistake(m, name, 0, "%.40s: one of %.200s is missing; add one", name->text,
                             group);
        else
            document_mistake(m, name, 0, "%.40s: '%s' is missing (%s)", name->text, k->name,
                             entry_summary(k));
    }
}

static void report_map(const document_node *n, const known_keys *known, const document_node *name,
                       mistakes *m)
{
    enum { MOST_KEYS = 4 };
    char keys[160] = "key: value, ...";
    size_t used = 0;
    int count = 0;
    for (const entry_field *k = known->table; k != NULL && k->name != NULL; k++)
        if (k->name[0] != '\0' && k->kind != ENTRY_LATER && ++count <= MOST_KEYS && used < 120)
            used += (size_t)snprintf(keys + used, sizeof keys - used, "%s%.24s: ...",
                                     count > 1 ? ", " : "", k->name);
    char expected[200];
    snprintf(expected, sizeof expected, "a map: {%s%s}", keys, count > MOST_KEYS ? ", ..." : "");
    report_kind(n, name, expected, m);
}

static void check_map(const document_node *map, const known_keys *known, const document_node *name,
                      mistakes *m)
{
    if (map->kind != DOCUMENT_MAP) {
        report_map(map, known, name, m);
        return;
    }
    for (int i = 0; i < map->count; i++) {
        const char *text = map->key[i]->text;
        const entry_field *k = find(known->table, text);
        if (k == NULL && known->loop != NULL)
            k = find(known->loop, text);
        if (k == NULL)
            k = keys_any(known->table);
        char remedy[FAULT_TEXT];
        if (k != NULL)
            check_value(map->item[i], k, map->key[i], m);
        else
            document_mistake(m, map->key[i], 0, "%.40s has no key '%.40s'%s", name->text, text,
                             remedy_of(known, text, remedy));
    }
    check_missing(map, known, name, m);
}

int keys_check(const document_node *root, mistakes *m)
{
    static const document_node place = {
        .kind = DOCUMENT_TEXT, .line = 1, .column = 1, .text = "the scene"};
    const known_keys known = {keys_root, NULL};
    const int before = m->count;
    check_map(root, &known, &place, m);
    return m->count == before;
}
