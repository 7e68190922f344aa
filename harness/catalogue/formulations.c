#include "harness/catalogue/formulations.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/catalogue/number.h"
#include "harness/catalogue/parameters.h"
#include "harness/catalogue/registry.h"

static const char *const newton_names[SOLVE_NEWTONS] = {"mixed", "displacement", "dense"};
const char formulation_newtons[] = "mixed|displacement|dense";

static const char *formulation_name(const void *context, int i)
{
    (void)context;
    return registry_formulations[i] != NULL ? registry_formulations[i]->name : NULL;
}

static const char *case_name(const void *context, int i)
{
    (void)context;
    return registry_cases[i] != NULL ? registry_cases[i]->name : NULL;
}

static status unknown(fault *f, const char *what, const char *name, const char *near)
{
    return fault_set(f, STATUS_REFUSED, "unknown %s '%s'%s%s%s; 'beamwork list' shows them all",
                     what, name, near != NULL ? ", did you mean '" : "", near != NULL ? near : "",
                     near != NULL ? "'?" : "");
}

const case_type *case_find(const char *name, fault *f)
{
    for (int i = 0; registry_cases[i] != NULL; i++)
        if (strcmp(registry_cases[i]->name, name) == 0)
            return registry_cases[i];
    unknown(f, "case", name, nearest_name(name, case_name, NULL));
    return NULL;
}

const element_type *formulation_find(const char *key)
{
    const size_t length = strcspn(key, ":");
    for (int i = 0; registry_formulations[i] != NULL; i++)
        if (strlen(registry_formulations[i]->name) == length &&
            strncmp(registry_formulations[i]->name, key, length) == 0)
            return registry_formulations[i];
    return NULL;
}

static void write_key(formulation *out)
{
    const element_option *o = out->type->options;
    int used = snprintf(out->key, sizeof out->key, "%s", out->type->name), given = 0;
    for (int i = 0; o != NULL && o[i].name != NULL && used < FORMULATION_KEY; i++) {
        char text[32];
        if (out->option[i] == o[i].value)
            continue;
        if (o[i].choices != NULL)
            choice_name(o[i].choices, (int)out->option[i], text, sizeof text);
        else
            snprintf(text, sizeof text, "%g", out->option[i]);
        used += snprintf(out->key + used, (size_t)(FORMULATION_KEY - used), "%s%s=%s",
                         given++ > 0 ? "," : ":", o[i].name, text);
    }
    if (out->newton != SOLVE_MIXED && used < FORMULATION_KEY)
        snprintf(out->key + used, (size_t)(FORMULATION_KEY - used), "%snewton=%s",
                 given > 0 ? "," : ":", newton_names[out->newton]);
}

void formulation_default(const element_type *type, formulation *out)
{
    memset(out, 0, sizeof *out);
    out->type = type;
    for (int i = 0; type->options != NULL && type->options[i].name != NULL; i++)
        out->option[i] = type->options[i].value;
    write_key(out);
}

int formulation_choice(const element_type *type, int index, int choice, formulation *out)
{
    const element_option *o = &type->options[index];
    if (o->choices == NULL || choice > (int)o->max || choice == (int)o->value)
        return 0;
    formulation_default(type, out);
    out->option[index] = choice;
    write_key(out);
    return 1;
}

unsigned formulation_bears_on(const formulation *chosen)
{
    const element_option *o = chosen->type->options;
    unsigned features = 0;
    for (int i = 0; o != NULL && o[i].name != NULL; i++)
        if (chosen->option[i] != o[i].value)
            features |= o[i].judged;
    return features;
}

static const char *option_name(const void *context, int i)
{
    const element_option *o = context;
    int count = 0;
    while (o != NULL && o[count].name != NULL)
        count++;
    return i < count ? o[i].name : i == count ? "newton" : NULL;
}

static status set_option(formulation *out, const char *name, const char *value, fault *f)
{
    if (strcmp(name, "newton") == 0) {
        const int index = choice_index(formulation_newtons, value);
        out->newton = index >= 0 ? (solve_newton)index : SOLVE_MIXED;
        return index >= 0 ? STATUS_OK
                          : fault_set(f, STATUS_REFUSED,
                                      "option newton: unknown choice '%s'; give one of %s", value,
                                      formulation_newtons);
    }
    const element_option *o = out->type->options;
    int i = 0;
    while (o != NULL && o[i].name != NULL && strcmp(o[i].name, name) != 0)
        i++;
    if (o == NULL || o[i].name == NULL) {
        const char *near = nearest_name(name, option_name, o);
        return fault_set(
            f, STATUS_REFUSED,
            "formulation %s has no option '%s'%s%s%s; 'beamwork list formulations' shows them",
            out->type->name, name, near != NULL ? ", did you mean '" : "", near != NULL ? near : "",
            near != NULL ? "'?" : "");
    }
    if (o[i].choices != NULL) {
        const int index = choice_index(o[i].choices, value);
        if (index < 0)
            return fault_set(f, STATUS_REFUSED,
                             "option %s of %s: unknown choice '%s'; give one of %s", name,
                             out->type->name, value, o[i].choices);
        out->option[i] = index;
        return STATUS_OK;
    }
    const char *end;
    double number;
    if (!number_read(value, &end, &number) || *end != '\0' ||
        !(number >= o[i].min && number <= o[i].max) || number != floor(number))
        return fault_set(f, STATUS_REFUSED,
                         "option %s of %s: '%s'; give a whole number from %g to %g", name,
                         out->type->name, value, o[i].min, o[i].max);
    out->option[i] = number;
    return STATUS_OK;
}

status formulation_parse(const char *text, formulation *out, fault *f)
{
    char copy[FORMULATION_KEY];
    if (strlen(text) >= sizeof copy)
        return fault_set(f, STATUS_REFUSED, "formulation '%.40s...': too long", text);
    snprintf(copy, sizeof copy, "%s", text);
    char *colon = strchr(copy, ':'), *rest = NULL;
    const char *given[ELEMENT_MAX_OPTIONS + 1];
    int count = 0;
    if (colon != NULL)
        *colon = '\0';
    const element_type *type = formulation_find(copy);
    if (type == NULL)
        return unknown(f, "formulation", copy, nearest_name(copy, formulation_name, NULL));
    formulation_default(type, out);
    rest = colon != NULL ? colon + 1 : NULL;
    for (char *one = strsep(&rest, ","); one != NULL; one = strsep(&rest, ",")) {
        char *equals = strchr(one, '=');
        if (equals == NULL)
            return fault_set(f, STATUS_REFUSED,
                             "option '%s' of %s: write it as key=value, joined by single commas",
                             one, copy);
        *equals = '\0';
        for (int i = 0; i < count; i++)
            if (strcmp(given[i], one) == 0)
                return fault_set(f, STATUS_REFUSED,
                                 "option %s of %s is given twice; give it one value", one, copy);
        if (count <= ELEMENT_MAX_OPTIONS)
            given[count++] = one;
        const status outcome = set_option(out, one, equals + 1, f);
        if (outcome != STATUS_OK)
            return outcome;
    }
    write_key(out);
    return STATUS_OK;
}
