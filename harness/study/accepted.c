#include "harness/study/accepted.h"

#include <stdlib.h>

#include "harness/formulations/formulations.h"
#include "harness/study/columns.h"

static status accept_all(table_columns *c)
{
    c->rows = c->group >= 0 ? columns_length(c->group, "formulation") : -1;
    if (c->rows < 0)
        return columns_broken(c, "formulation");
    char **name = calloc((size_t)c->rows + 1, sizeof *name);
    if (name == NULL)
        return fault_set(c->f, STATUS_FAULT, "out of memory for accepted formulations");
    const status outcome = columns_strings(c, "formulation", name);
    for (int i = 0; i < c->rows; i++) {
        if (outcome == STATUS_OK)
            formulations_accept(name[i]);
        free(name[i]);
    }
    free(name);
    return outcome;
}

status accepted_read(const char *path, hid_t file, fault *f)
{
    table_columns c = {.path = path, .name = "accepted", .f = f};
    c.group = H5Lexists(file, c.name, H5P_DEFAULT) > 0 ? H5Gopen2(file, c.name, H5P_DEFAULT) : -1;
    const status outcome = accept_all(&c);
    if (c.group >= 0)
        H5Gclose(c.group);
    return outcome;
}
