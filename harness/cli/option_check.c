#include "harness/cli/option_check.h"

#include <string.h>

#include "elements/shared/choice.h"
#include "harness/cli/option_table.h"

static const char *chosen_name(const void *context, int i)
{
    return ((const struct argp_option *)context)[i].name;
}

/* The verb has no such option; another verb may. */
static status refuse_name(const char *verb, const struct argp_option chosen[], const char *name,
                          int length, fault *f)
{
    char word[64];
    const verb_option *other = option_table;
    snprintf(word, sizeof word, "%.*s", length, name);
    while (other->name != NULL && strcmp(other->name, word) != 0)
        other++;
    if (other->name != NULL)
        return fault_set(f, STATUS_REFUSED, "%s takes no --%s; 'beamwork %s -h' lists its options",
                         verb, word, verb);
    const char *near = choice_nearest(word, chosen_name, chosen);
    return fault_set(f, STATUS_REFUSED,
                     "unknown option --%s%s%s%s; 'beamwork %s -h' lists the options", word,
                     near != NULL ? ", did you mean --" : "", near != NULL ? near : "",
                     near != NULL ? "?" : "", verb);
}

/* As getopt_long: a whole name, or the beginning of one only. */
static status find_long(const char *verb, const struct argp_option chosen[], const char *name,
                        int length, const struct argp_option **out, fault *f)
{
    int begun = 0;
    *out = NULL;
    for (const struct argp_option *o = chosen; o->name != NULL; o++) {
        if (strncmp(o->name, name, (size_t)length) != 0)
            continue;
        *out = o;
        if (o->name[length] == '\0')
            return STATUS_OK;
        begun++;
    }
    if (begun > 1)
        return fault_set(f, STATUS_REFUSED,
                         "--%.*s begins several options; 'beamwork %s -h' lists them", length, name,
                         verb);
    return begun == 1 ? STATUS_OK : refuse_name(verb, chosen, name, length, f);
}

/* *more: 1 where the next argument is its value. */
static status check_value(const struct argp_option *o, int given, int last, int *more, fault *f)
{
    if (given && o->arg == NULL)
        return fault_set(f, STATUS_REFUSED, "--%s takes no value", o->name);
    *more = !given && o->arg != NULL && !(o->flags & OPTION_ARG_OPTIONAL);
    if (*more && last)
        return fault_set(f, STATUS_REFUSED, "--%s needs a value: %s", o->name, o->arg);
    return STATUS_OK;
}

static status check_long(const char *verb, const struct argp_option chosen[], const char *word,
                         int last, int *more, fault *f)
{
    const struct argp_option *o;
    const int length = (int)strcspn(word, "=");
    TRY(find_long(verb, chosen, word, length, &o, f));
    return check_value(o, word[length] == '=', last, more, f);
}

/* -xyz: several without values, or one and its value. */
static status check_short(const char *verb, const struct argp_option chosen[], const char *letters,
                          int last, int *more, fault *f)
{
    for (; *letters != '\0'; letters++) {
        const struct argp_option *o = chosen;
        while (o->name != NULL && o->key != *letters)
            o++;
        if (*letters == '?' && o->name == NULL)
            return STATUS_OK;
        if (o->name == NULL)
            return fault_set(f, STATUS_REFUSED,
                             "unknown option -%c; 'beamwork %s -h' lists the options", *letters,
                             verb);
        if (o->arg != NULL)
            return check_value(o, letters[1] != '\0', last, more, f);
    }
    return STATUS_OK;
}

status option_check(const char *verb, const struct argp_option chosen[], int count,
                    char *const argument[], fault *f)
{
    for (int i = 1; i < count && strcmp(argument[i], "--") != 0; i++) {
        int more = 0;
        const char *word = argument[i];
        if (word[0] == '-' && word[1] == '-')
            TRY(check_long(verb, chosen, word + 2, i + 1 == count, &more, f));
        else if (word[0] == '-' && word[1] != '\0')
            TRY(check_short(verb, chosen, word + 1, i + 1 == count, &more, f));
        i += more;
    }
    return STATUS_OK;
}
