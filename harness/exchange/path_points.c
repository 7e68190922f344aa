#include "harness/exchange/path_points.h"

#include <stdlib.h>

/* Sorted, each once; what is not on the way from path 0 to the last station is left out. */
static void insert(path_points *p, double value, double last)
{
    int at = p->count;
    if (value <= 0 || value > last)
        return;
    while (at > 0 && p->value[at - 1] >= value)
        at--;
    if (at < p->count && p->value[at] == value)
        return;
    for (int i = p->count; i > at; i--)
        p->value[i] = p->value[i - 1];
    p->value[at] = value;
    p->count++;
}

static int most_points(const scene *s, const scene_path *stations)
{
    int most = stations->stations + s->quantities;
    for (int i = 0; i < s->drivers; i++)
        most += s->driver[i].stations;
    for (int i = 0; i < s->loads; i++)
        most += s->load[i].stations;
    return most;
}

static int is_about(const scene *s, int analysis, const scene_quantity *q)
{
    return q->analysis == analysis || s->analysis[q->analysis].follows == analysis;
}

status path_points_of(const scene *s, int analysis, path_points *out, fault *f)
{
    const scene_path *stations = scene_path_of(&s->analysis[analysis]);
    const double last = stations->value[stations->stations - 1];
    *out = (path_points){.value = calloc((size_t)most_points(s, stations), sizeof(double))};
    if (out->value == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a path");
    for (int i = 0; i < stations->stations; i++)
        insert(out, stations->value[i], last);
    for (int i = 0; i < s->quantities; i++)
        if (is_about(s, analysis, &s->quantity[i]) && s->quantity[i].reduction == SCENE_AT)
            insert(out, s->quantity[i].at, last);
    for (int i = 0; i < s->drivers; i++)
        for (int k = 0; k < s->driver[i].stations; k++)
            insert(out, s->driver[i].path[k], last);
    for (int i = 0; i < s->loads; i++)
        for (int k = 0; k < s->load[i].stations; k++)
            insert(out, s->load[i].path[k], last);
    return STATUS_OK;
}

void path_points_free(path_points *p)
{
    free(p->value);
    p->value = NULL;
}

int path_points_asked(const scene *s, int analysis, const scene_quantity *q, double point)
{
    const scene_path *stations = scene_path_of(&s->analysis[analysis]);
    int is_station = 0;
    for (int i = 0; i < stations->stations; i++)
        is_station |= stations->value[i] == point;
    if (!is_about(s, analysis, q))
        return 0;
    switch (q->reduction) {
    case SCENE_AT:
        return q->at == point;
    case SCENE_CURVE:
        return is_station;
    default:
        return stations->value[stations->stations - 1] == point;
    }
}
