#include <stdio.h>

#include "harness/cli/manual.h"
#include "harness/cli/results.h"
#include "harness/cli/roff.h"

static void write_record(FILE *to, results_record r)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int count = schema_fields(r.type, KEY_AROUND, list);
    char place[200];
    snprintf(place, sizeof place, "%s%s", r.place, r.type->table);
    fprintf(to, ".Ss");
    roff_argument(to, place);
    fputc('\n', to);
    roff_text(to, r.type->summary);
    fprintf(to, ".Pp\n.Bl -tag -width 24n -compact\n");
    for (int i = 0; i < count; i++) {
        const results_field f = results_field_of(list[i]);
        char kind[100];
        snprintf(kind, sizeof kind, "%s%s%s", f.kind, f.unit[0] != '\0' ? " " : "", f.unit);
        fprintf(to, ".It Va");
        roff_argument(to, list[i]->name);
        fprintf(to, " No");
        roff_argument(to, kind);
        fputc('\n', to);
        roff_text(to, f.text);
    }
    fprintf(to, ".El\n");
}

void manual_write_results(FILE *to)
{
    static const roff_reference see[] = {
        {"beamwork", 1}, {"beamwork-schema", 1}, {"beamwork-verify", 1}};
    char head[60];
    snprintf(head, sizeof head, "Version %d.", SCHEMA_VERSION);
    roff_page(to, "beamwork-results", 5, "files of results that beamwork writes");
    fprintf(to, ".Sh DESCRIPTION\n");
    roff_text(to, head);
    for (int i = 0; results_about[i] != NULL; i++) {
        roff_text(to, results_about[i]);
        fprintf(to, results_about[i + 1] != NULL ? ".Pp\n" : "");
    }
    for (int i = 0; results_record_at(i).type != NULL; i++)
        write_record(to, results_record_at(i));
    fprintf(to, ".Sh EXAMPLES\nFrom Python:\n.Bd -literal\nimport h5py\n"
                "rows = h5py.File(\\(dqresults.h5\\(dq)[\\(dqcases/elastica/quantities\\(dq][()]\n"
                ".Ed\n");
    roff_see(to, see, (int)(sizeof see / sizeof see[0]));
}
