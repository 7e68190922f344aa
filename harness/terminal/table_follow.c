#include "harness/terminal/table_follow.h"

void table_follow(FILE *to, const char *parameter, const follow_curves *c)
{
    int between = 0;
    fprintf(to, "%-16s", parameter);
    for (int i = 0; i < c->modes; i++)
        fprintf(to, " %8s %-2d [Hz]", "mode", i + 1);
    fputc('\n', to);
    for (int k = 0; k < c->samples; k++) {
        between += !c->sample[k].asked;
        if (!c->sample[k].asked)
            continue;
        fprintf(to, "%-16.10g", c->sample[k].value);
        for (int i = 0; i < c->modes; i++)
            fprintf(to, " %16.10g", c->sample[k].frequency[i]);
        fputc('\n', to);
    }
    for (int i = 0; i < c->events; i++) {
        const follow_event *e = &c->event[i];
        fprintf(to, "modes %d and %d %s at %.10g, %.10g Hz", e->mode[0] + 1, e->mode[1] + 1,
                e->crossing ? "cross" : "avoid each other", e->value, e->frequency);
        if (e->crossing)
            fputc('\n', to);
        else
            fprintf(to, ", %.2g %% apart\n", 100 * e->gap);
    }
    if (between > 0)
        fprintf(to, "%d values between, where shapes change fast\n", between);
}
