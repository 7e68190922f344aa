#include "cases/format/format_impl.h"

#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/shared/choice.h"

const char fields_components[] = "ux|uy|uz|rx|ry|rz";

fields fields_of(builder *b, const unrolled *entry)
{
    return (fields){b, entry->names, entry->value, entry->place, entry->placed};
}

fields fields_below(const fields *f, const char *key)
{
    const document_node *below = document_find(f->map, key);
    return (fields){f->b, f->names, below, below != NULL ? below : f->place, f->placed};
}

int fields_have(const fields *f, const char *key)
{
    return document_find(f->map, key) != NULL;
}

double fields_number(const fields *f, const char *key, double otherwise)
{
    const document_node *n = document_find(f->map, key);
    double value;
    return n != NULL && expression_number(n, f->names, f->b->mistakes, &value) ? value : otherwise;
}

int fields_whole(const fields *f, const char *key, int otherwise, int least, int most)
{
    const double value = fields_number(f, key, otherwise);
    if (value == floor(value) && value >= least && value <= most)
        return (int)value;
    document_mistake(f->b->mistakes, document_find(f->map, key), 0,
                     "%s = %g; give a whole number from %d to %d", key, value, least, most);
    return otherwise;
}

int fields_vector(const fields *f, const char *key, int count, double out[])
{
    const document_node *n = document_find(f->map, key);
    if (n == NULL)
        return 0;
    expression_vector(n, count, f->names, f->b->mistakes, out);
    return 1;
}

int fields_values(const fields *f, const char *key, double **out)
{
    const document_node *n = document_find(f->map, key);
    *out = NULL;
    const int count = n != NULL ? range_values(n, f->names, f->b->arena, f->b->mistakes, out) : 0;
    return count > 0 ? count : 0;
}

int fields_matrix(const fields *f, const char *key, double out[36])
{
    double *given;
    const int count = fields_values(f, key, &given);
    if (count == 36)
        memcpy(out, given, 36 * sizeof *out);
    for (int k = 0; k < 6 && count == 6; k++)
        out[7 * k] = given[k];
    if (fields_have(f, key) && count != 6 && count != 36)
        document_mistake(f->b->mistakes, document_find(f->map, key), 0,
                         "%s: the number of entries is %d; give the six entries of the diagonal, "
                         "or all 36",
                         key, count);
    return count == 6 || count == 36;
}

const char *fields_text(const fields *f, const char *key, const char *otherwise)
{
    const document_node *n = document_find(f->map, key);
    return n != NULL && n->kind == DOCUMENT_TEXT ? n->text : otherwise;
}

typedef struct word_list {
    char word[20][20];
} word_list;

static const char *word_at(const void *context, int i)
{
    const word_list *those = context;
    return i < 20 && those->word[i][0] != '\0' ? those->word[i] : NULL;
}

static const char *nearest_word(const char *text, const char *choices, word_list *those)
{
    for (int i = 0; i < 20; i++)
        choice_name(choices, i, those->word[i], sizeof those->word[i]);
    return choice_nearest(text, word_at, those);
}

int fields_word_of(const fields *f, const document_node *n, const char *what, const char *choices,
                   int otherwise)
{
    if (n->kind != DOCUMENT_TEXT) {
        document_mistake(f->b->mistakes, n, 0, "%s: a word is expected: %s", what, choices);
        return otherwise;
    }
    const scope *known = scope_find(f->names, n->text, strlen(n->text));
    const int index =
        choice_index(choices, known != NULL && known->word != NULL ? known->word : n->text);
    if (index >= 0)
        return index;
    char remedy[FAULT_TEXT], all[FAULT_TEXT];
    word_list those;
    snprintf(all, sizeof all, "; give one of %s", choices);
    if (known != NULL && known->word != NULL)
        document_mistake(f->b->mistakes, n, 0, "%s: %s has the value '%.40s'%s", what, n->text,
                         known->word, all);
    else
        document_mistake(f->b->mistakes, n, 0, "%s: no '%.40s' here%s", what, n->text,
                         mistakes_remedy(nearest_word(n->text, choices, &those), all, remedy));
    return otherwise;
}

int fields_word(const fields *f, const char *key, const char *choices, int otherwise)
{
    const document_node *n = document_find(f->map, key);
    return n != NULL ? fields_word_of(f, n, key, choices, otherwise) : otherwise;
}

unsigned fields_words(const fields *f, const char *key, const char *choices)
{
    const document_node *n = document_find(f->map, key);
    unsigned bits = 0;
    if (n != NULL && n->kind == DOCUMENT_TEXT) {
        const int index = fields_word_of(f, n, key, choices, -1);
        bits = index >= 0 ? 1u << index : 0;
    }
    if (n != NULL && n->kind == DOCUMENT_LIST)
        for (int i = 0; i < n->count; i++) {
            const int index = fields_word_of(f, n->item[i], key, choices, -1);
            bits |= index >= 0 ? 1u << index : 0;
        }
    return bits;
}

void builder_call(builder *b, scene_list list, int index, int i)
{
    scene_set_name(b->scene, list, index, b->list[list].entry[i].name);
}

typedef struct named_list {
    const builder *b;
    scene_list list;
} named_list;

static const char *entry_at(const void *context, int i)
{
    const named_list *those = context;
    return i < those->b->list[those->list].count ? those->b->list[those->list].entry[i].name : NULL;
}

/* Returns the index of the entry with the name `text`. Inside an instance, the entries of the
 * instance take precedence. */
static int find_entry(const fields *f, const char *text, scene_list list, int own)
{
    const size_t prefix = own && f->placed != NULL ? strlen(f->placed->name) : 0;
    int found = SCENE_NONE;
    for (int i = 0; i < f->b->list[list].count; i++) {
        const char *name = f->b->list[list].entry[i].name;
        if (prefix > 0 && strncmp(name, f->placed->name, prefix) == 0 && name[prefix] == '.' &&
            strcmp(name + prefix + 1, text) == 0)
            return i;
        if (found < 0 && strcmp(name, text) == 0)
            found = i;
    }
    return found;
}

/* Returns the name in a node of the tree, or the word of a parameter with this name. If it is a
 * port of the instance, sets *port to 1 and returns the node of the scene that is connected to it.
 */
static const char *name_of(const fields *f, const document_node *n, scene_list list, int *port)
{
    const scope *known = scope_find(f->names, n->text, strlen(n->text));
    const char *text = known != NULL && known->word != NULL ? known->word : n->text;
    const document_node *to = list == SCENE_NODES ? placement_port(f->placed, text) : NULL;
    *port = to != NULL;
    return to != NULL ? to->text : text;
}

int fields_names(const fields *f, const char *key, scene_list list)
{
    return fields_names_entry(f, document_find(f->map, key), list);
}

int fields_names_entry(const fields *f, const document_node *n, scene_list list)
{
    int port;
    if (n == NULL || n->kind != DOCUMENT_TEXT)
        return 0;
    const char *text = name_of(f, n, list, &port);
    return find_entry(f, text, list, !port) >= 0;
}

int fields_entry_of(const fields *f, const document_node *n, scene_list list)
{
    static const char *const what[] = {"section",   "node",        "member",     "spring",
                                       "motion",    "load",        "analysis",   "quantity",
                                       "load case", "combination", "constraint", "imperfection"};
    const named_list those = {f->b, list};
    char remedy[FAULT_TEXT];
    if (n->kind != DOCUMENT_TEXT) {
        document_mistake(f->b->mistakes, n, 0,
                         "one %s name is expected; give a name, not a list or map", what[list]);
        return SCENE_NONE;
    }
    int port;
    const char *text = name_of(f, n, list, &port);
    const int found = find_entry(f, text, list, !port);
    if (found >= 0)
        return found;
    if (!substitute_is_left(text) && !f->b->list[list].incomplete)
        document_mistake(
            f->b->mistakes, n, 0, "no %s '%.40s'%s", what[list], text,
            mistakes_remedy(choice_nearest(text, entry_at, &those),
                            list == SCENE_CASES
                                ? "; correct the name, or add 'case' to a load or motion"
                                : "; add it, or correct the name",
                            remedy));
    return SCENE_NONE;
}

const char *fields_called(const fields *f, const document_node *n)
{
    int port;
    return name_of(f, n, SCENE_CASES, &port);
}

int fields_entry(const fields *f, const char *key, scene_list list)
{
    const document_node *n = document_find(f->map, key);
    return n != NULL ? fields_entry_of(f, n, list) : SCENE_NONE;
}

static void read_numbers(const fields *f, const entry_field *k, scene_path *to)
{
    double *value;
    to->stations = fields_values(f, k->name, &value);
    to->value = scene_copy(f->b->scene, to->stations, value);
}

static double read_number(const fields *f, const entry_field *k)
{
    const double value = fields_number(f, k->name, entry_usual(k));
    char range[FAULT_TEXT];
    const int whole = k->kind != ENTRY_WHOLE || value == floor(value);
    if (!fields_have(f, k->name) || (whole && entry_in_range(k, value)))
        return value;
    document_mistake(f->b->mistakes, document_find(f->map, k->name), 0, "%s = %g; give %s", k->name,
                     value, entry_range(k, range));
    return entry_usual(k);
}

static void read_vector(const fields *f, const entry_field *k, double out[])
{
    if (!fields_vector(f, k->name, k->count, out))
        return;
    if (k->kind == ENTRY_DIRECTION)
        placement_turn(f->placed, out);
    if (k->kind == ENTRY_POSITION)
        placement_move(f->placed, out);
}

static int read_word(const fields *f, const entry_field *k)
{
    const int index = fields_word(f, k->name, k->words, -1);
    if (k->kind == ENTRY_FLAG)
        return index > 0 ? index % 2 : 0;
    return index < 0 ? entry_word(k, k->usual) : entry_value(k, index);
}

static void read_map(const fields *f, const entry_field *k, void *entry)
{
    const fields below = fields_below(f, k->name);
    if (below.map == NULL)
        return;
    if (k->type != NULL)
        quantity_type_begin(k->type, entry);
    else if (k->size > 0)
        memcpy((char *)entry + k->at, &k->first, sizeof k->first);
    fields_read(&below, entry_below(k), entry);
}

static void read_field(const fields *f, const entry_field *k, void *entry)
{
    void *to = (char *)entry + k->at;
    switch (k->kind) {
    case ENTRY_NUMBER:
        *(double *)to = read_number(f, k);
        if (k->zero != 0 && fields_have(f, k->name) && *(double *)to == 0)
            *(unsigned *)((char *)entry + k->zeros) |= k->zero;
        break;
    case ENTRY_WHOLE:
        *(int *)to = (int)read_number(f, k);
        break;
    case ENTRY_VECTOR:
    case ENTRY_DIRECTION:
    case ENTRY_POSITION:
        read_vector(f, k, to);
        break;
    case ENTRY_NUMBERS:
        read_numbers(f, k, to);
        break;
    case ENTRY_NAME:
        *(int *)to = fields_entry(f, k->name, k->of);
        break;
    case ENTRY_WORD:
    case ENTRY_FLAG:
        if (k->size == sizeof(int))
            *(int *)to = read_word(f, k);
        else if (fields_have(f, k->name))
            *(double *)to = read_word(f, k);
        break;
    case ENTRY_WORDS:
        *(unsigned *)to = fields_words(f, k->name, k->words);
        break;
    default:
        break;
    }
}

void fields_read(const fields *f, const entry_field *table, void *entry)
{
    for (const entry_field *k = table; k->name != NULL; k++)
        if (k->kind == ENTRY_MAP)
            read_map(f, k, entry);
        else if (k->size > 0)
            read_field(f, k, entry);
}
