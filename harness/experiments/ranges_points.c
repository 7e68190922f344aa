#include "harness/experiments/ranges_points.h"

#include <stdio.h>
#include <string.h>

#include "harness/formulations/formulations.h"

void ranges_points_values(const parameter_ranges *r, const double at[],
                          double value[CASE_MAX_PARAMETERS])
{
    memcpy(value, r->base, sizeof r->base);
    for (int i = 0; i < r->design.axes; i++)
        value[r->axis[i].index] = at[i];
}

void ranges_points_text(const parameter_ranges *r, const double at[], char *text, int size)
{
    int used = 0;
    text[0] = '\0';
    for (int i = 0; i < r->design.axes && used < size; i++) {
        char word[ASSIGNMENT_VALUE];
        axis_text(&r->axis[i], at[i], word, sizeof word);
        used += snprintf(text + used, (size_t)(size - used), "%s%s=%s", i > 0 ? ", " : "",
                         r->axis[i].of->name, word);
    }
}
