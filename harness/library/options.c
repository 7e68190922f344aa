#include "harness/library/options.h"

#include <fcntl.h>
#include <string.h>

#include "elements/shared/choice.h"

static const char *name_at(const void *context, int i)
{
    return ((const call_option *)context)[i].name;
}

static status unknown(const char *key, const call_option table[], fault *f)
{
    const char *near = choice_nearest(key, name_at, table);
    return fault_set(f, STATUS_REFUSED,
                     "unknown option '%.60s'%s%s%s; beamwork.h lists those of each function", key,
                     near != NULL ? ", did you mean '" : "", near != NULL ? near : "",
                     near != NULL ? "'?" : "");
}

static int is_within(const call_option *o, json_int_t value)
{
    return value >= o->least && value <= o->most;
}

static status take(const call_option *o, json_t *value, fault *f)
{
    const double number = json_number_value(value);
    switch (o->kind) {
    case OPTION_SWITCH:
        if (!json_is_boolean(value))
            return fault_set(f, STATUS_REFUSED, "option '%s': give true or false", o->name);
        *(int *)o->to = json_is_true(value);
        return STATUS_OK;
    case OPTION_WHOLE:
        if (!json_is_integer(value) || !is_within(o, json_integer_value(value)))
            return fault_set(f, STATUS_REFUSED, "option '%s': give a whole number from %d to %d",
                             o->name, o->least, o->most);
        *(int *)o->to = (int)json_integer_value(value);
        return STATUS_OK;
    case OPTION_FILE:
        if (!json_is_integer(value) || !is_within(o, json_integer_value(value)) ||
            fcntl((int)json_integer_value(value), F_GETFD) < 0)
            return fault_set(f, STATUS_REFUSED, "option '%s': give the descriptor of an open file",
                             o->name);
        *(int *)o->to = (int)json_integer_value(value);
        return STATUS_OK;
    case OPTION_SHARE:
        if (!json_is_number(value) || !(number > 0 && number < 1))
            return fault_set(f, STATUS_REFUSED, "option '%s': give a number between 0 and 1",
                             o->name);
        *(double *)o->to = number;
        return STATUS_OK;
    case OPTION_WORDS:
        break;
    }
    if (!json_is_string(value))
        return fault_set(f, STATUS_REFUSED, "option '%s': give a text", o->name);
    *(const char **)o->to = json_string_value(value);
    return STATUS_OK;
}

status options_read(const char *json, const call_option table[], json_t **kept, fault *f)
{
    json_error_t error;
    const char *key;
    json_t *value;
    *kept = NULL;
    if (json == NULL)
        return STATUS_OK;
    *kept = json_loads(json, JSON_REJECT_DUPLICATES, &error);
    if (*kept == NULL)
        return fault_set(f, STATUS_REFUSED, "options: line %d, column %d: %.150s", error.line,
                         error.column, error.text);
    if (!json_is_object(*kept))
        return fault_set(f, STATUS_REFUSED, "options: give an object, such as {\"threads\": 2}");
    json_object_foreach(*kept, key, value)
    {
        const call_option *o = table;
        while (o->name != NULL && strcmp(o->name, key) != 0)
            o++;
        TRY(o->name != NULL ? take(o, value, f) : unknown(key, table, f));
    }
    return STATUS_OK;
}
