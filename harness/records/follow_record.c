#include "harness/records/follow_record.h"

#include "harness/records/json.h"

void follow_record_csv(FILE *to, const char *parameter, const follow_curves *c)
{
    fprintf(to, "%s,asked,mode,frequency,match\n", parameter);
    for (int k = 0; k < c->samples; k++)
        for (int i = 0; i < c->modes; i++)
            fprintf(to, "%.17g,%d,%d,%.17g,%.17g\n", c->sample[k].value, c->sample[k].asked, i + 1,
                    c->sample[k].frequency[i], c->sample[k].match[i]);
}

static json_t *curve_of(const follow_curves *c, int mode)
{
    json_t *frequency = json_array(), *match = json_array();
    for (int k = 0; k < c->samples; k++) {
        json_array_append_new(frequency, json_real(c->sample[k].frequency[mode]));
        json_array_append_new(match, json_real(c->sample[k].match[mode]));
    }
    return json_pack("{s:i,s:o,s:o}", "mode", mode + 1, "frequency", frequency, "match", match);
}

static json_t *event_of(const follow_event *e)
{
    return json_pack("{s:s,s:[i,i],s:f,s:f,s:f}", "kind", e->crossing ? "crossing" : "veering",
                     "modes", e->mode[0] + 1, e->mode[1] + 1, "value", e->value, "frequency",
                     e->frequency, "gap", e->gap);
}

status follow_record_json(FILE *to, const char *parameter, const follow_curves *c, fault *f)
{
    json_t *value = json_array(), *asked = json_array(), *curves = json_array(),
           *events = json_array();
    for (int k = 0; k < c->samples; k++) {
        json_array_append_new(value, json_real(c->sample[k].value));
        json_array_append_new(asked, json_boolean(c->sample[k].asked));
    }
    for (int i = 0; i < c->modes; i++)
        json_array_append_new(curves, curve_of(c, i));
    for (int i = 0; i < c->events; i++)
        json_array_append_new(events, event_of(&c->event[i]));
    return json_finish(json_pack("{s:s,s:o,s:o,s:o,s:o}", "parameter", parameter, "values", value,
                                 "asked", asked, "curves", curves, "events", events),
                       to, f);
}
