#include "harness/experiments/pace_list.h"

#include <math.h>
#include <string.h>

#include "elements/shared/number.h"

pace_list pace_list_divided(double first, double ratio, int count)
{
    pace_list out = {.count = count};
    for (int i = 0; i < count; i++)
        out.value[i] = i == 0 ? first : out.value[i - 1] / ratio;
    return out;
}

static status list_refuse(const char *option, const char *text, fault *f)
{
    return fault_set(f, STATUS_REFUSED,
                     "--%s '%.60s': give at most %d positive numbers, such as 0.1,0.05, or "
                     "0.1..0.0125",
                     option, text, PACE_LIST_MOST);
}

/* Where a number ends; NULL: there is none that is positive. */
static const char *positive(const char *at, double *out)
{
    const char *end;
    if (!number_read(at, &end, out) || *out <= 0)
        return NULL;
    return *end == '.' && end[-1] == '.' ? end - 1 : end; /* 1..2: the first point is no decimal */
}

static status read_range(const char *option, const char *text, double from, double to, double ratio,
                         pace_list *out, fault *f)
{
    const int count = to <= from ? 1 + (int)lround(log(from / to) / log(ratio)) : 0;
    if (count < 1 || count > PACE_LIST_MOST)
        return list_refuse(option, text, f);
    *out = pace_list_divided(from, ratio, count);
    return STATUS_OK;
}

status pace_list_read(const char *option, const char *text, double ratio, pace_list *out, fault *f)
{
    const char *at = text;
    double to;
    out->count = 0;
    do {
        at = out->count < PACE_LIST_MOST ? positive(at, &out->value[out->count]) : NULL;
        if (at != NULL && out->count == 0 && strncmp(at, "..", 2) == 0) {
            at = positive(at + 2, &to);
            return at != NULL && *at == '\0'
                       ? read_range(option, text, out->value[0], to, ratio, out, f)
                       : list_refuse(option, text, f);
        }
        if (at == NULL || (*at != ',' && *at != '\0'))
            return list_refuse(option, text, f);
        out->count++;
    } while (*at++ == ',');
    return STATUS_OK;
}
