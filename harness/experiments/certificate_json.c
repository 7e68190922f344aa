#include "harness/experiments/certificate_json.h"

#include <jansson.h>
#include <math.h>

#include "harness/formulations/adapters.h"
#include "harness/formulations/environment.h"
#include "harness/records/json.h"
#include "harness/records/json_record.h"

static json_t *number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *claim_of(const claim *one)
{
    static const char *const outcome[CLAIM_OUTCOMES] = {"holds", "broken", "not claimed"};
    return json_pack("{s:s,s:s,s:i,s:o,s:o,s:s}", "claim", one->name, "outcome",
                     outcome[one->outcome], "compared", one->compared, "worst", number(one->worst),
                     "allowed", number(one->allowed), "sentence", one->sentence);
}

static json_t *measure_of(const measure *one)
{
    return json_pack("{s:s,s:o,s:o,s:o,s:i,s:i,s:b,s:b,s:s}", "name", one->name, "at",
                     json_record_numbers(one->points, one->at), "error",
                     json_record_numbers(one->points, one->error), "order", number(one->order),
                     "least", one->least, "highest", one->highest, "locks", one->locks,
                     "wrong_limit", one->astray, "words", one->words);
}

static json_t *part_of(const certificate *c, int part)
{
    json_t *list = json_array(), *numbers = json_array();
    const certificate_part *own = &c->part[part];
    for (int i = 0; i < own->claims.count; i++)
        json_array_append_new(list, claim_of(&own->claims.claim[i]));
    for (int i = 0; i < own->measures.count; i++)
        json_array_append_new(numbers, measure_of(&own->measures.measure[i]));
    return json_pack("{s:s,s:s,s:o,s:o}", "family", certificate_part_name(part), "what",
                     certificate_part_words(part), "claims", list, "measured", numbers);
}

static json_t *one_of(const certificate *c)
{
    json_t *parts = json_array();
    for (int i = 0; i < CERTIFICATE_PARTS; i++)
        json_array_append_new(parts, part_of(c, i));
    return json_pack("{s:s,s:s,s:s,s:s,s:b,s:i,s:o}", "formulation", c->chosen.key, "summary",
                     c->chosen.type->summary, "source", c->chosen.type->source, "leaves",
                     adapters_words(c->chosen.type), "kept", certificate_holds(c), "compared",
                     certificate_compared(c), "parts", parts);
}

status certificate_json(FILE *to, const certificate *all, int count, fault *f)
{
    const environment e = environment_now(1);
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(list, one_of(&all[i]));
    json_t *root = json_pack("{s:i,s:s,s:s,s:s,s:o}", "schema_version", 1, "program_version",
                             e.version, "commit", e.commit, "clock", e.clock, "certificates", list);
    return json_finish(root, to, f);
}
