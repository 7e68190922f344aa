/* What a built-in case leaves out: what its source does, or nothing. */
#include <stddef.h>

#include "cases/case.h"

const parameter_type case_omit[] = {
    {"omit", "", 0, 0, 0, "source|none",
     "physics left out: what the source of the case leaves out, or nothing, whatever the other "
     "parameters say; values of the source are not those of the latter"},
    {0},
};

int case_omits_nothing(const case_type *c, const double value[])
{
    const parameter_type *p;
    for (int i = 0; (p = parameter_at(c->parameters, i)) != NULL; i++)
        if (p == case_omit)
            return value[i] != 0;
    return 0;
}

status case_build(const case_type *c, const double value[], scene *s, fault *f)
{
    if (c->build_from != NULL)
        return c->build_from(c->context, value, s, f);
    TRY(c->build(value, s, f));
    if (case_omits_nothing(c, value))
        s->omits = 0;
    return STATUS_OK;
}
