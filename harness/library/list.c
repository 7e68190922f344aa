#include <string.h>

#include "harness/experiments/experiments.h"
#include "harness/library/call.h"
#include "harness/library/known.h"
#include "harness/library/text.h"

static status list_write_list(FILE *to, const list_subject *what, const truths *ledger, fault *f)
{
    double value[CASE_MAX_PARAMETERS] = {0};
    if (what->type != NULL) {
        parameters_default(what->type, value);
        return list_json_case(to, what->type, value, f);
    }
    if (what->chosen.type != NULL)
        return list_json_formulation(to, &what->chosen, ledger->rule, ledger->rules, f);
    return list_json_all(to, what->cases, what->formulations, f);
}

static status list_of(const char *name, char **json, fault *f)
{
    list_subject what;
    truths ledger = {0};
    document_text t;
    if (json == NULL)
        return fault_set(f, STATUS_REFUSED, "bw_list: give a place for the text");
    *json = NULL;
    TRY(list_subject_find(name, &what, f));
    TRY(text_begin(&t, f));
    known_read(NULL, &ledger, NULL); /* it may be missing */
    const status outcome = text_end(&t, list_write_list(t.to, &what, &ledger, f), json, f);
    truths_free(&ledger);
    return outcome;
}

bw_status bw_list(const char *what, char **json, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, list_of(what, json, &c.fault));
}
