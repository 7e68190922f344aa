/* What belongs to no scene. */
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/library/call.h"
#include "harness/library/known.h"

const char *bw_version(void)
{
    return environment_version();
}

void bw_free_text(char *text)
{
    free(text);
}

const char *bw_status_name(bw_status s)
{
    return s >= BW_OK && s <= BW_NO_VALUE ? status_name((status)s) : "unknown";
}

bw_status bw_truths(const char *path, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, known_place(path, &c.fault));
}

static status load(const char *path, char **name, fault *f)
{
    const element_type *type;
    if (name != NULL)
        *name = NULL;
    if (path == NULL)
        return fault_set(f, STATUS_REFUSED, "bw_formulation_load: give the path of an object");
    TRY(plugin_load(path, &type, f));
    TRY(formulations_add(type, NULL, f));
    if (name != NULL && (*name = strdup(type->name)) == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a name");
    return STATUS_OK;
}

bw_status bw_formulation_load(const char *path, char **name, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, load(path, name, &c.fault));
}
