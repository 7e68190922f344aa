/* What the result file consists of, from the tables it is written by. */
#include <stdio.h>

#include "harness/cli/cli.h"
#include "harness/cli/results.h"
#include "harness/records/json.h"
#include "harness/records/json_record.h"
#include "harness/terminal/paragraph.h"

static void show_field(const schema_field *which)
{
    const results_field f = results_field_of(which);
    printf("  %-20s %-7s %-7s %s\n", which->name, f.kind, f.unit, f.text);
}

static void show(results_record r)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int count = schema_fields(r.type, KEY_AROUND, list);
    printf("\n%s%s: %s\n", r.place, r.type->table, r.type->summary);
    for (int i = 0; i < count; i++)
        show_field(list[i]);
}

static status write_json(fault *f)
{
    json_t *records = json_array();
    for (int i = 0; results_record_at(i).type != NULL; i++)
        json_array_append_new(records, json_record_type(results_record_at(i).type));
    return json_finish(json_pack("{s:s,s:i,s:o}", "schema", SCHEMA_NAME, "schema_version",
                                 SCHEMA_VERSION, "records", records),
                       stdout, f);
}

int cli_schema(int count, char **arguments)
{
    command_request r;
    fault f = {""};
    command_parse(
        "schema", "",
        "Describes the result file of verify, bench and solve (-o FILE), and the records of "
        "JSON and CSV."
        "\vbeamwork schema --format json",
        "F", count, arguments, &r);
    if (r.case_name != NULL)
        return message_fail(STATUS_REFUSED, "schema takes no case; it describes the files of all");
    if (r.format[0] == 'j')
        return message_exit(write_json(&f), &f);
    if (r.format[0] == 'c')
        return message_fail(STATUS_REFUSED, "schema is written as text or json");
    printf("%s, version %d\n", SCHEMA_NAME, SCHEMA_VERSION);
    for (int i = 0; results_about[i] != NULL; i++)
        paragraph_write(stdout, 0, 0, results_about[i]);
    for (int i = 0; results_record_at(i).type != NULL; i++)
        show(results_record_at(i));
    return EXIT_AS_EXPECTED; /* main flushes */
}
