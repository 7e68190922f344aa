#include "harness/cli/named.h"

#include <stdio.h>
#include <string.h>

#include "harness/cli/message.h"
#include "harness/formulations/formulation_list.h"
#include "harness/formulations/formulations.h"
#include "harness/formulations/plugin.h"
#include "harness/formulations/process.h"
#include "harness/study/data_place.h"

void named_add(command_request *r, const char *text)
{
    fault f;
    if (formulation_list_add(text, COMMAND_MAX_FORMULATIONS, r->formulation, &r->formulations,
                             &f) != STATUS_OK)
        message_refuse(f.text);
}

void named_element(command_request *r, const char *path)
{
    char text[80];
    if (r->elements == FORMULATIONS_MOST_LOADED) {
        snprintf(text, sizeof text, "too many --element; give at most %d",
                 FORMULATIONS_MOST_LOADED);
        message_refuse(text);
    }
    r->element[r->elements++] = path;
}

void named_load(command_request *r)
{
    process_limit(r->time_limit);
    if (r->elements > 0)
        data_place_modules();
    for (int i = 0; i < r->elements; i++) {
        const element_type *type;
        fault f;
        if (plugin_load(r->element[i], &type, &f) != STATUS_OK ||
            formulations_add(type, r->element[i], &f) != STATUS_OK)
            message_refuse(f.text);
    }
    for (int i = 0; i < r->named_formulations; i++)
        named_add(r, r->named_formulation[i]);
}

void named_formulation(command_request *r, const char *text)
{
    if (r->named_formulations == COMMAND_MAX_FORMULATIONS)
        message_refuse("too many formulations; give fewer -f, or 'all'");
    r->named_formulation[r->named_formulations++] = text;
}

int named_alone(const command_request *r)
{
    for (int i = 0; i < r->named_formulations; i++)
        if (strcmp(r->named_formulation[i], "all") == 0)
            return 0;
    return r->named_formulations > 0;
}
