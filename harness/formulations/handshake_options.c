#include "harness/formulations/handshake_options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const options_keys[] = {"name", "summary", "default", "choices",
                                           "min",  "max",     "unit"};

static status options_refuse(const char *who, const char *name, const char *what, fault *f)
{
    return fault_set(f, STATUS_REFUSED, "%.100s: option '%.40s' of its first line: %.120s", who,
                     name, what);
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

static const char *copy_or(const json_t *text, const char *absent)
{
    return strdup(json_is_string(text) ? json_string_value(text) : absent);
}

/* Words of a choice, "a|b"; NULL: they are none, or memory. */
static const char *join(const json_t *list)
{
    size_t length = 1;
    for (size_t i = 0; i < json_array_size(list); i++) {
        if (!is_word(json_string_value(json_array_get(list, i))))
            return NULL;
        length += json_string_length(json_array_get(list, i)) + 1;
    }
    char *out = json_array_size(list) > 0 ? calloc(length, 1) : NULL, *to = out;
    for (size_t i = 0; out != NULL && i < json_array_size(list); i++) {
        const json_t *word = json_array_get(list, i);
        if (i > 0)
            *to++ = '|';
        memcpy(to, json_string_value(word), json_string_length(word));
        to += json_string_length(word);
    }
    return out;
}

static status read_choice(const char *who, const json_t *one, parameter_type *out, fault *f)
{
    const json_t *list = json_object_get(one, "choices");
    const char *chosen = json_string_value(json_object_get(one, "default"));
    int found = 0;
    out->choices = join(list);
    out->unit = copy_or(NULL, "");
    for (size_t i = 0; chosen != NULL && i < json_array_size(list) && !found; i++) {
        const char *word = json_string_value(json_array_get(list, i));
        found = word != NULL && strcmp(word, chosen) == 0;
        out->value = (double)i;
    }
    return out->choices != NULL && out->unit != NULL && found
               ? STATUS_OK
               : options_refuse(who, out->name, "'choices' are words and 'default' is one of them",
                                f);
}

static status read_number(const char *who, const json_t *one, parameter_type *out, fault *f)
{
    const json_t *value = json_object_get(one, "default"), *min = json_object_get(one, "min"),
                 *max = json_object_get(one, "max");
    out->unit = copy_or(json_object_get(one, "unit"), "1");
    out->value = json_number_value(value);
    out->min = json_number_value(min);
    out->max = json_number_value(max);
    const int sound = json_is_number(value) && json_is_number(min) && json_is_number(max) &&
                      out->min <= out->value && out->value <= out->max && out->unit != NULL;
    return sound ? STATUS_OK
                 : options_refuse(who, out->name,
                                  "give numbers 'min' <= 'default' <= 'max', or 'choices'", f);
}

static status read_one(const char *who, const json_t *one, parameter_type *out, fault *f)
{
    if (!is_word(json_string_value(json_object_get(one, "name"))))
        return options_refuse(who, "", "its 'name' is a word of small letters, digits and _", f);
    out->name = copy_or(json_object_get(one, "name"), "");
    out->summary = copy_or(json_object_get(one, "summary"), "");
    if (out->name == NULL || out->summary == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory");
    if (has_other_keys(one))
        return options_refuse(who, out->name,
                              "its keys are name, default, min, max, unit, choices, summary", f);
    return json_object_get(one, "choices") != NULL ? read_choice(who, one, out, f)
                                                   : read_number(who, one, out, f);
}

status handshake_options(const char *who, const json_t *list, const parameter_type **out, fault *f)
{
    const size_t count = json_array_size(list);
    *out = NULL;
    if ((list != NULL && !json_is_array(list)) || count > ELEMENT_MAX_OPTIONS)
        return options_refuse(who, "", "'options' is a list of at most 6", f);
    if (count == 0)
        return STATUS_OK;
    parameter_type *table = calloc(count + 1, sizeof *table);
    if (table == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory");
    *out = table;
    for (size_t i = 0; i < count; i++)
        TRY(read_one(who, json_array_get(list, i), &table[i], f));
    return STATUS_OK;
}

void handshake_options_free(const parameter_type *table)
{
    for (const parameter_type *p = table; p != NULL && p->name != NULL; p++) {
        free((void *)p->name);
        free((void *)p->summary);
        free((void *)p->unit);
        free((void *)p->choices);
    }
    free((void *)table);
}
