#include "harness/cli/own_tables.h"

#include "harness/cli/files.h"
#include "harness/study/own_findings.h"
#include "harness/study/own_truths.h"

static status refuse(const mistakes *m, fault *f)
{
    const int others = m->count + m->more - 1;
    fault first = {""};
    const status outcome = mistakes_status(m, &first);
    if (outcome == STATUS_OK || others <= 0)
        return outcome == STATUS_OK ? outcome : fault_set(f, outcome, "%s", first.text);
    return fault_set(f, outcome, "%.330s (and %d more)", first.text, others);
}

status own_tables_truths(const command_request *r, const case_type *const run[],
                         const case_type *only, truths *t, fault *f)
{
    mistakes m;
    for (int i = 0; i < r->own_truths_count; i++) {
        TRY(own_truths_read(r->own_truths[i], run, only, t, &m, f));
        TRY(refuse(&m, f));
    }
    return STATUS_OK;
}

status own_tables_findings(const command_request *r, const case_type *const run[], truths *t,
                           fault *f)
{
    mistakes m;
    for (int i = 0; i < r->findings_count; i++) {
        TRY(own_findings_read(r->findings[i], run, t, &m, f));
        TRY(refuse(&m, f));
    }
    return STATUS_OK;
}

status own_tables_check(const command_request *r, fault *f)
{
    for (int i = 0; i < r->own_truths_count; i++)
        TRY(files_check_input(r, r->own_truths[i], f));
    for (int i = 0; i < r->findings_count; i++)
        TRY(files_check_input(r, r->findings[i], f));
    return STATUS_OK;
}
