#include "harness/formulations/formulations_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct word_bit {
    const char *word;
    unsigned bit;
} word_bit;

static const word_bit limits[] = {{"doubly symmetric", LIMIT_DOUBLY_SYMMETRIC},
                                  {"order dependent", LIMIT_ORDER_DEPENDENT},
                                  {"quarter turn", LIMIT_QUARTER_TURN},
                                  {"half turn", LIMIT_HALF_TURN},
                                  {"eighth twist", LIMIT_EIGHTH_TWIST},
                                  {"warping rigid", LIMIT_WARPING_RIGID},
                                  {"flat arc", LIMIT_FLAT_ARC},
                                  {"not objective", LIMIT_NOT_OBJECTIVE},
                                  {"path dependent", LIMIT_PATH_DEPENDENT},
                                  {NULL, 0}};
static const word_bit theories[] = {
    {"engesser", SHEAR_ENGESSER}, {"haringx", SHEAR_HARINGX}, {NULL, 0}};

static const struct gives {
    const char *words;
    int whole;
    unsigned leaves;
} gives[] = {{"e", 0, LEAVES_J | LEAVES_H},
             {"e,J", 0, LEAVES_H},
             {"e,J,H", 0, 0},
             {"energy", 1, LEAVES_FORCE | LEAVES_TANGENT},
             {"force", 1, LEAVES_TANGENT},
             {"tangent", 1, 0}};

static const char *const keys[] = {"beamwork", "name",           "summary", "source",  "family",
                                   "offers",   "gives",          "strains", "nodes",   "order",
                                   "limits",   "shear_theories", "options", "inertia", "history",
                                   "places",   "damping",        "line",    "scalars"};

/* Memory to which the type points: it outlives the JSON. */
typedef struct handshake_memory {
    parameter_type option[ELEMENT_MAX_OPTIONS + 1];
    char *end; /* end of the texts copied so far */
    char text[];
} handshake_memory;

typedef struct handshake_reading {
    const char *program_name;
    json_t *said;
    handshake_memory *memory;
    fault *f;
} handshake_reading;
static status handshake_options(const handshake_reading *, const parameter_type **out);

static handshake_memory *memory_alloc(size_t length)
{
    handshake_memory *memory = calloc(1, sizeof *memory + length + 4 * (size_t)ELEMENT_MAX_OPTIONS);
    if (memory != NULL)
        memory->end = memory->text;
    return memory;
}

static const char *copy(handshake_memory *memory, const char *text)
{
    char *start = memory->end;
    memory->end = stpcpy(start, text) + 1;
    return start;
}

static status refuse(const handshake_reading *r, const char *key, const char *what)
{
    return fault_set(r->f, STATUS_REFUSED,
                     "%.100s: the key '%.40s' of its first line is missing or not valid; %.120s",
                     r->program_name, key, what);
}

static status text_of(const handshake_reading *r, const char *key, const char **out)
{
    const char *text = json_string_value(json_object_get(r->said, key));
    if (text == NULL || text[0] == '\0')
        return refuse(r, key, "give one line of text");
    for (const char *c = text; *c != '\0'; c++)
        if ((unsigned char)*c < ' ')
            return refuse(r, key,
                          "give one line of text, without tabs or other control characters");
    *out = copy(r->memory, text);
    return STATUS_OK;
}

static status name_of(const handshake_reading *r, const char **out)
{
    TRY(text_of(r, "name", out));
    const size_t length = strlen(*out);
    if (length > 60 || strspn(*out, "abcdefghijklmnopqrstuvwxyz0123456789_") != length)
        return refuse(r, "name",
                      "give a word of at most 60 lowercase letters, digits and underscores");
    return STATUS_OK;
}

static unsigned bit_of(const word_bit list[], const char *word)
{
    for (; list != NULL && list->word != NULL; list++)
        if (strcmp(list->word, word) == 0)
            return list->bit;
    return list == NULL ? feature_named(word) : 0;
}

static status no_such_word(const handshake_reading *r, const char *key, const word_bit known[],
                           const char *word)
{
    char words[260] = "";
    size_t at = 0;
    if (known == NULL)
        feature_words(~0u, words, sizeof words);
    for (; known != NULL && known->word != NULL && at < sizeof words; known++)
        at += (size_t)snprintf(words + at, sizeof words - at, "%s%s", at > 0 ? ", " : "",
                               known->word);
    return fault_set(
        r->f, STATUS_REFUSED,
        "%.60s: the key '%s' of its first line contains the unknown word '%.40s'; give %s",
        r->program_name, key, word != NULL ? word : "(not text)", words);
}

/* Combines the bits of a list of words. known NULL: the words of feature.h. */
static status words_of(const handshake_reading *r, const char *key, const word_bit known[],
                       unsigned *out)
{
    const json_t *list = json_object_get(r->said, key);
    *out = 0;
    if (list != NULL && !json_is_array(list))
        return refuse(r, key, "give a list of words");
    for (size_t i = 0; i < json_array_size(list); i++) {
        const char *word = json_string_value(json_array_get(list, i));
        const unsigned bit = word != NULL ? bit_of(known, word) : 0;
        if (bit == 0)
            return no_such_word(r, key, known, word);
        *out |= bit;
    }
    return STATUS_OK;
}

/* Reads a whole number from `least` to `most`. The result is `absent` if the member is missing;
 * absent < 0: the member must be given. */
static status number_of(const handshake_reading *r, const char *key, int least, int most,
                        int absent, int *out)
{
    const json_t *value = json_object_get(r->said, key);
    const json_int_t number = json_integer_value(value);
    char what[80];
    snprintf(what, sizeof what, "give a whole number from %d to %d", least, most);
    if ((value == NULL && absent < 0) ||
        (value != NULL && (!json_is_integer(value) || number < least || number > most)))
        return refuse(r, key, what);
    *out = value != NULL ? (int)number : absent;
    return STATUS_OK;
}

static status places_of(const handshake_reading *r, int nodes, double place[])
{
    const json_t *list = json_object_get(r->said, "places");
    if (list == NULL)
        return STATUS_OK;
    int numbers = (int)json_array_size(list) == nodes;
    for (int k = 0; k < nodes; k++) {
        const json_t *number = json_array_get(list, (size_t)k); /* NULL if the list is too short */
        numbers &= json_is_number(number);
        place[k] = json_number_value(number);
    }
    if (!numbers)
        return refuse(r, "places", "give one number for each node, such as [0, 0.5, 1]");
    if (!(place[nodes - 1] > 0))
        return refuse(r, "places", "give numbers that increase from 0 to 1");
    return STATUS_OK;
}

static status orders_of(const handshake_reading *r, element_order out[])
{
    static const char *const analysis[ELEMENT_ANALYSES] = {"statics", "vibration", "buckling"};
    const json_t *order = json_object_get(r->said, "order");
    size_t known = 0;
    if (order != NULL && !json_is_object(order))
        return refuse(r, "order", "give an object such as {\"statics\": [2, 4]}");
    for (int i = 0; i < ELEMENT_ANALYSES; i++) {
        const json_t *both = json_object_get(order, analysis[i]);
        known += both != NULL;
        if (both == NULL)
            continue;
        const json_int_t least = json_integer_value(json_array_get(both, 0)),
                         highest = json_integer_value(json_array_get(both, 1));
        if (json_array_size(both) != 2 || least < 1 || highest < least || highest > 100)
            return refuse(r, "order", "give two whole numbers such as [2, 4] for each analysis");
        out[i] = (element_order){(int)least, (int)highest};
    }
    if (order != NULL && json_object_size(order) != known)
        return refuse(r, "order", "give only the keys statics, vibration and buckling");
    return STATUS_OK;
}

static status gives_of(const handshake_reading *r, handshake *out)
{
    const char *words = json_string_value(json_object_get(r->said, "gives"));
    for (size_t i = 0; words != NULL && i < sizeof gives / sizeof gives[0]; i++)
        if (strcmp(gives[i].words, words) == 0) {
            out->whole = gives[i].whole;
            out->type.leaves = gives[i].leaves;
            return STATUS_OK;
        }
    return refuse(r, "gives", "give one of e; e,J; e,J,H; energy; force; tangent");
}

static status inertia_of(const handshake_reading *r, handshake *out)
{
    const json_t *given = json_object_get(r->said, "inertia");
    const char *word = json_string_value(given);
    if (given == NULL)
        return STATUS_OK;
    if (word == NULL || (strcmp(word, "vibration") != 0 && strcmp(word, "motion") != 0))
        return refuse(r, "inertia", "give vibration or motion, or remove it");
    if (!(out->type.offers & FEATURE_MASS))
        return refuse(r, "inertia",
                      "add mass to 'offers', because the key requires it, or remove the key");
    out->inertia = 1;
    out->type.spreads = strcmp(word, "motion") == 0;
    if (out->type.spreads && out->constants.nodes != 2)
        return refuse(r, "inertia",
                      "give vibration, because motion is only for elements with two nodes");
    return STATUS_OK;
}

static status flag_of(const handshake_reading *r, const char *key, int *out)
{
    const json_t *given = json_object_get(r->said, key);
    *out = json_is_true(given);
    return given == NULL || json_is_boolean(given) ? STATUS_OK
                                                   : refuse(r, key, "give true or false");
}

static status damping_of(const handshake_reading *r, int *out)
{
    const json_t *given = json_object_get(r->said, "damping");
    const char *word = json_string_value(given);
    const int alone = word != NULL && strcmp(word, "only V") == 0;
    *out = alone ? DAMPING_ONLY : json_is_true(given) ? DAMPING_AFTER_C : DAMPING_NONE;
    return alone || given == NULL || json_is_boolean(given)
               ? STATUS_OK
               : refuse(r, "damping", "give true or false, or 'only V' for V without C");
}

static status terms_of(const handshake_reading *r, handshake *out)
{
    TRY(damping_of(r, &out->damping));
    TRY(flag_of(r, "line", &out->line));
    if (out->damping && out->whole)
        return refuse(r, "damping",
                      "give strains (e, or e,J, or e,J,H as 'gives'), because the key requires "
                      "them, or remove it");
    return STATUS_OK;
}

static status only_known_keys(const handshake_reading *r)
{
    const char *key;
    json_t *value;
    json_object_foreach(r->said, key, value)
    {
        int known = 0;
        for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
            known |= strcmp(keys[i], key) == 0;
        if (!known)
            return refuse(r, key, "remove it, because the protocol has no such key");
    }
    return STATUS_OK;
}

static status protocol_of(const handshake_reading *r)
{
    const json_t *number = json_object_get(r->said, "beamwork");
    if (json_is_integer(number) && json_integer_value(number) == PROCESS_PROTOCOL)
        return STATUS_OK;
    return fault_set(r->f, STATUS_REFUSED,
                     "%.100s: the command uses protocol %lld, but this program uses protocol %d; "
                     "the first line must contain \"beamwork\": %d",
                     r->program_name, (long long)json_integer_value(number), PROCESS_PROTOCOL,
                     PROCESS_PROTOCOL);
}

static status read_all(const handshake_reading *r, handshake *out)
{
    element_type *t = &out->type;
    TRY(protocol_of(r));
    TRY(only_known_keys(r));
    TRY(name_of(r, &t->name));
    TRY(text_of(r, "summary", &t->summary));
    TRY(text_of(r, "source", &t->source));
    TRY(text_of(r, "family", &t->family));
    TRY(gives_of(r, out));
    if (json_object_get(r->said, "offers") == NULL)
        return refuse(
            r, "offers",
            "give a list of the supported physics, such as [\"shear\", \"geometric\"], or "
            "[] if there is none");
    TRY(words_of(r, "offers", NULL, &t->offers));
    TRY(words_of(r, "limits", limits, &t->limits));
    TRY(words_of(r, "shear_theories", theories, &t->shear_theories));
    t->offers |= t->shear_theories & SHEAR_ENGESSER ? FEATURE_ENGESSER : 0;
    t->offers |= t->shear_theories & SHEAR_HARINGX ? FEATURE_HARINGX : 0;
    TRY(number_of(r, "nodes", 2, ELEMENT_MAX_NODES, 2, &out->constants.nodes));
    TRY(places_of(r, out->constants.nodes, out->constants.place));
    if (!out->whole)
        TRY(number_of(r, "strains", 1, ELEMENT_MAX_STRAINS, -1, &out->constants.strains));
    else if (json_object_get(r->said, "strains") != NULL)
        return refuse(
            r, "strains",
            "remove it, because formulations that provide whole elements have no strains");
    TRY(number_of(r, "history", 1, ELEMENT_MAX_HISTORY, 0, &out->constants.history));
    TRY(number_of(r, "scalars", 1, ELEMENT_MAX_SCALARS, 0, &out->constants.scalars));
    TRY(orders_of(r, out->constants.order));
    TRY(inertia_of(r, out));
    TRY(terms_of(r, out));
    return handshake_options(r, &t->options[0]);
}

status handshake_read(const char *program_name, const char *line, size_t length, handshake *out,
                      fault *f)
{
    json_error_t why;
    const handshake_reading r = {program_name,
                                 json_loadb(line, length, JSON_REJECT_DUPLICATES, &why),
                                 memory_alloc(length), f};
    *out = (handshake){.type = {.abi = ELEMENT_ABI, .size = sizeof(element_type)}};
    const status outcome =
        r.memory == NULL ? fault_set(f, STATUS_FAULT, "out of memory")
        : !json_is_object(r.said)
            ? fault_set(f, STATUS_REFUSED,
                        "%.100s: its output began with '%.60s' instead of a line of JSON "
                        "(harness/formulations/protocol.md); print other text to standard error",
                        program_name, line)
            : read_all(&r, out);
    json_decref(r.said);
    if (outcome == STATUS_OK)
        out->memory = r.memory;
    else
        free(r.memory);
    return outcome;
}

static const char *const options_keys[] = {"name", "summary", "default", "choices",
                                           "min",  "max",     "unit"};

static status options_refuse(const handshake_reading *r, const char *name, const char *what)
{
    return fault_set(r->f, STATUS_REFUSED,
                     "%.100s: option '%.40s' of its first line is not valid; %.120s",
                     r->program_name, name, what);
}

static int is_word(const char *text)
{
    return text != NULL && text[0] != '\0' && strlen(text) < 40 &&
           text[strspn(text, "abcdefghijklmnopqrstuvwxyz0123456789_")] == '\0';
}

static int has_other_keys(const json_t *one)
{
    size_t known = 0;
    for (size_t i = 0; i < sizeof options_keys / sizeof options_keys[0]; i++)
        known += json_object_get(one, options_keys[i]) != NULL;
    return known != json_object_size(one);
}

static const char *copy_or(handshake_memory *memory, const json_t *text, const char *absent)
{
    return copy(memory, json_is_string(text) ? json_string_value(text) : absent);
}

/* Joins the words of a choice to "a|b"; NULL: the member is not a list of words, or the list is
 * empty. */
static const char *join(handshake_memory *memory, const json_t *list)
{
    char *start = memory->end;
    if (json_array_size(list) == 0)
        return NULL;
    for (size_t i = 0; i < json_array_size(list); i++) {
        const char *word = json_string_value(json_array_get(list, i));
        if (!is_word(word))
            return NULL;
        if (i > 0)
            memory->end[-1] = '|';
        copy(memory, word);
    }
    return start;
}

static status read_choice(const handshake_reading *r, const json_t *one, parameter_type *out)
{
    const json_t *list = json_object_get(one, "choices");
    const char *chosen = json_string_value(json_object_get(one, "default"));
    int found = 0;
    out->choices = join(r->memory, list);
    out->unit = "";
    for (size_t i = 0; chosen != NULL && i < json_array_size(list) && !found; i++) {
        const char *word = json_string_value(json_array_get(list, i));
        found = word != NULL && strcmp(word, chosen) == 0;
        out->value = (double)i;
    }
    return out->choices != NULL && found
               ? STATUS_OK
               : options_refuse(r, out->name,
                                "give words in 'choices', and one of them in 'default'");
}

static status read_number(const handshake_reading *r, const json_t *one, parameter_type *out)
{
    const json_t *value = json_object_get(one, "default"), *min = json_object_get(one, "min"),
                 *max = json_object_get(one, "max");
    out->unit = copy_or(r->memory, json_object_get(one, "unit"), "1");
    out->value = json_number_value(value);
    out->min = json_number_value(min);
    out->max = json_number_value(max);
    const int is_valid = json_is_number(value) && json_is_number(min) && json_is_number(max) &&
                         out->min <= out->value && out->value <= out->max;
    return is_valid ? STATUS_OK
                    : options_refuse(r, out->name,
                                     "give numbers 'min' <= 'default' <= 'max', or 'choices'");
}

static status read_one(const handshake_reading *r, const json_t *one, parameter_type *out)
{
    if (!is_word(json_string_value(json_object_get(one, "name"))))
        return refuse(r, "options",
                      "give each option a name of lowercase letters, digits and underscores");
    out->name = copy_or(r->memory, json_object_get(one, "name"), "");
    out->summary = copy_or(r->memory, json_object_get(one, "summary"), "");
    if (has_other_keys(one))
        return options_refuse(
            r, out->name, "give only the keys name, default, min, max, unit, choices and summary");
    return json_object_get(one, "choices") != NULL ? read_choice(r, one, out)
                                                   : read_number(r, one, out);
}

static status handshake_options(const handshake_reading *r, const parameter_type **out)
{
    const json_t *list = json_object_get(r->said, "options");
    const size_t count = json_array_size(list);
    *out = NULL;
    if ((list != NULL && !json_is_array(list)) || count > ELEMENT_MAX_OPTIONS)
        return refuse(r, "options", "give a list of at most 6 options");
    if (count == 0)
        return STATUS_OK;
    *out = r->memory->option;
    for (size_t i = 0; i < count; i++)
        TRY(read_one(r, json_array_get(list, i), &r->memory->option[i]));
    return STATUS_OK;
}
