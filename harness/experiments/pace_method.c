#include "harness/experiments/pace_method.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/shared/number.h"

const char pace_method_all[] = "alpha,alpha:rho=0.5,hht,trapezoidal,conserving,radau";

enum { SCHEME_WORDS = 6, ORDER_OF_EXPLICIT = 8 };

/* Its word, and what may be said of it. */
static const struct {
    const char *word, *value;
    double usual, most;
    scene_scheme scheme;
    int order, estimate;
} schemes[SCHEME_WORDS] = {
    {"alpha", "rho", 0.9, 1, SCENE_ALPHA, 2, 1},
    {"hht", "alpha", 0.05, 1 / 3.0, SCENE_ALPHA, 2, 1},
    {"trapezoidal", NULL, 0, 0, SCENE_ALPHA, 2, 1},
    {"conserving", NULL, 0, 0, SCENE_CONSERVING, 2, 0},
    {"radau", NULL, 0, 0, SCENE_RADAU, PACE_REFERENCE_ORDER, 1},
    {"explicit", NULL, 0, 0, SCENE_EXPLICIT, ORDER_OF_EXPLICIT, 1},
};

static status refuse(const char *name, fault *f)
{
    return fault_set(f, STATUS_REFUSED, "--integrator '%.31s': give one of " PACE_METHODS, name);
}

/* "KEY=NUMBER" of a scheme; *value is its usual one where nothing is said. */
static int read_value(const char *text, const char *key, double most, double *value)
{
    const size_t length = key != NULL ? strlen(key) : 0;
    const char *end;
    if (text[0] == '\0')
        return 1;
    if (key == NULL || strncmp(text, key, length) != 0 || text[length] != '=')
        return 0;
    return number_read(text + length + 1, &end, value) && *end == '\0' && *value >= 0 &&
           *value <= most;
}

status pace_method_read(const char *text, int length, pace_method *out, fault *f)
{
    memset(out, 0, sizeof *out);
    snprintf(out->name, sizeof out->name, "%.*s", length, text);
    const size_t word = strcspn(out->name, ":");
    int i = 0;
    while (i < SCHEME_WORDS &&
           (strlen(schemes[i].word) != word || strncmp(schemes[i].word, out->name, word) != 0))
        i++;
    if (i == SCHEME_WORDS || length >= PACE_METHOD_NAME)
        return refuse(out->name, f);
    double value = schemes[i].usual;
    const char *rest = out->name + word + (out->name[word] == ':');
    if (!read_value(rest, schemes[i].value, schemes[i].most, &value))
        return refuse(out->name, f);
    out->scheme = schemes[i].scheme;
    out->order = schemes[i].order;
    out->estimate = schemes[i].estimate;
    if (out->scheme == SCENE_ALPHA && i == 0)
        out->alpha = scene_alpha_of_radius(value);
    else if (out->scheme == SCENE_ALPHA)
        out->alpha = (scene_alpha){0, value};
    return STATUS_OK;
}

status pace_method_read_list(const char *text, int most, pace_method list[], int *count, fault *f)
{
    for (const char *at = text;; at++) {
        const int length = (int)strcspn(at, ",");
        if (*count == most)
            return fault_set(f, STATUS_REFUSED, "--integrator: more than %d; give fewer", most);
        TRY(pace_method_read(at, length, &list[*count], f));
        for (int i = 0; i < *count; i++)
            if (strcmp(list[i].name, list[*count].name) == 0)
                return fault_set(f, STATUS_REFUSED, "--integrator: %s is given twice; give it once",
                                 list[i].name);
        ++*count;
        at += length;
        if (*at == '\0')
            return STATUS_OK;
    }
}
